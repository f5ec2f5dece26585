#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <half.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace metamer {

/// An EXR's part as a test writes it: each channel has one value, everywhere in the data window.
struct TestPart {
  std::string name = {};
  std::vector<std::pair<std::string, float>> channels = {};
  Imf::PixelType type = Imf::FLOAT;
  Imath::Box2i display{{0, 0}, {1, 1}};
  Imath::Box2i data = display;
  bool tiled = false;
  std::vector<float> chromaticities = {};  ///< x y of red, green, blue, white.
  std::string view = {};
  int sampling = 1;  ///< Of the last channel.
};

inline Imf::Header test_header(const TestPart& part) {
  Imf::Header header(part.display, part.data);
  if (!part.name.empty()) header.setName(part.name);
  if (!part.view.empty()) header.setView(part.view);
  header.setType(part.tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (part.tiled) header.setTileDescription(Imf::TileDescription(3, 2));
  for (const auto& [name, value] : part.channels) {
    const int sampling = name == part.channels.back().first ? part.sampling : 1;
    header.channels().insert(name, Imf::Channel(part.type, sampling, sampling));
  }
  if (const auto& c = part.chromaticities; !c.empty())
    Imf::addChromaticities(header, {{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]}});
  return header;
}

/// The values' bits, four bytes each.
using TestPlanes = std::vector<std::vector<std::uint32_t>>;

inline Imf::FrameBuffer test_buffer(const TestPart& part, TestPlanes& planes) {
  const Imath::V2i size = part.data.size() + Imath::V2i{1, 1};
  planes.clear();
  Imf::FrameBuffer buffer;
  for (const auto& [name, value] : part.channels) {
    std::uint32_t bits = 0;
    if (part.type == Imf::FLOAT) bits = std::bit_cast<std::uint32_t>(value);
    if (part.type == Imf::HALF) bits = half(value).bits();
    if (part.type == Imf::UINT) bits = static_cast<std::uint32_t>(value);
    planes.emplace_back(static_cast<std::size_t>(size.x * size.y), bits);
    const int sampling = name == part.channels.back().first ? part.sampling : 1;
    buffer.insert(name, Imf::Slice::Make(part.type, planes.back().data(), part.data, 4, 0, sampling,
                                         sampling));
  }
  return buffer;
}

/// One part without a name, or several with names.
inline void write_parts(const std::filesystem::path& file, const std::vector<TestPart>& parts) {
  TestPlanes values;
  if (parts.size() == 1 && parts[0].name.empty() && !parts[0].tiled) {
    Imf::OutputFile output(file.c_str(), test_header(parts[0]));
    output.setFrameBuffer(test_buffer(parts[0], values));
    output.writePixels(parts[0].data.max.y - parts[0].data.min.y + 1);
    return;
  }
  std::vector<Imf::Header> headers;
  for (const TestPart& part : parts) headers.push_back(test_header(part));
  Imf::MultiPartOutputFile output(file.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    const TestPart& part = parts[static_cast<std::size_t>(i)];
    if (part.tiled) {
      Imf::TiledOutputPart pixels(output, i);
      pixels.setFrameBuffer(test_buffer(part, values));
      pixels.writeTiles(0, pixels.numXTiles() - 1, 0, pixels.numYTiles() - 1);
    } else {
      Imf::OutputPart pixels(output, i);
      pixels.setFrameBuffer(test_buffer(part, values));
      pixels.writePixels(part.data.max.y - part.data.min.y + 1);
    }
  }
}

}  // namespace metamer
