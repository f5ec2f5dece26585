#include "common/image/write_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <exception>

#include "common/image/picture_file.h"

namespace metamer {
namespace {

/// Rows that are converted at a time, so that no second picture is held.
constexpr int rows_at_a_time = 64;

/// A file in memory.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char from[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes.resize(std::max(bytes.size(), position_ + size));
    std::copy_n(from, size, bytes.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::vector<unsigned char> bytes;

 private:
  std::size_t position_ = 0;
};

Imf::Header header_of(const ExrDescription& description) {
  Imf::Header header(description.width, description.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& name : description.channels)
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  if (const auto& c = description.chromaticities)
    Imf::addChromaticities(
        header, {{(*c)[0], (*c)[1]}, {(*c)[2], (*c)[3]}, {(*c)[4], (*c)[5]}, {(*c)[6], (*c)[7]}});
  for (const auto& [name, number] : description.numbers)
    header.insert(name, Imf::FloatAttribute(number));
  for (const auto& [name, text] : description.texts)
    header.insert(name, Imf::StringAttribute(text));
  return header;
}

/// Interleaved values of rows from y.
Imf::FrameBuffer rows_to_write(const std::vector<std::string>& channels, float* values, int width,
                               int rows, int y) {
  const std::size_t pixel = channels.size() * sizeof(float);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < channels.size(); ++c)
    buffer.insert(channels[c],
                  Imf::Slice::Make(Imf::FLOAT, values + c, Imath::V2i(0, y), width, rows, pixel));
  return buffer;
}

}  // namespace

Result<std::vector<unsigned char>> encode_exr(const ExrDescription& description,
                                              const FillRows& fill) {
  try {
    MemoryStream stream;
    {
      Imf::OutputFile output(stream, header_of(description), 0);
      const auto row = static_cast<std::size_t>(description.width) * description.channels.size();
      std::vector<float> values(rows_at_a_time * row);
      for (int y = 0; y < description.height; y += rows_at_a_time) {
        const int end = std::min(description.height, y + rows_at_a_time);
        fill(y, end, values.data());
        output.setFrameBuffer(
            rows_to_write(description.channels, values.data(), description.width, end - y, y));
        output.writePixels(end - y);
      }
    }
    return std::move(stream.bytes);
  } catch (const std::exception& error) {
    return problem("can't encode the picture: " + first_line(error.what()));
  }
}

}  // namespace metamer
