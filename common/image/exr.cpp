#include "common/image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
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

/// Interleaved values whose first pixel is at (x, y) of the file.
Imf::FrameBuffer frame_buffer(const std::vector<std::string>& channels, float* values, int width,
                              int rows, int x, int y) {
  const std::size_t pixel = channels.size() * sizeof(float);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < channels.size(); ++c)
    buffer.insert(channels[c],
                  Imf::Slice::Make(Imf::FLOAT, values + c, Imath::V2i(x, y), width, rows, pixel));
  return buffer;
}

/// R, G, B and A first.
std::vector<std::string> channel_names(const Imf::ChannelList& list) {
  std::vector<std::string> names;
  for (auto channel = list.begin(); channel != list.end(); ++channel)
    names.emplace_back(channel.name());
  std::stable_sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    const std::string first = "RGBA";
    const auto rank = [&](const std::string& name) {
      return name.size() == 1 ? std::min(first.find(name), first.size()) : first.size();
    };
    return rank(a) < rank(b);
  });
  return names;
}

ImageHeader to_image_header(const Imf::Header& header) {
  const Imath::Box2i& window = header.dataWindow();
  ImageHeader result;
  result.width = window.max.x - window.min.x + 1;
  result.height = window.max.y - window.min.y + 1;
  result.channels = channel_names(header.channels());
  if (Imf::hasChromaticities(header)) {
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    for (const Imath::V2f& xy : {c.red, c.green, c.blue, c.white}) {
      result.chromaticities.push_back(xy.x);
      result.chromaticities.push_back(xy.y);
    }
  }
  if (const auto* units = header.findTypedAttribute<Imf::StringAttribute>("emissiveUnits"))
    result.emissive_units = units->value();
  return result;
}

/// Opens the file, checks what its header says, and lets `read` take it from there.
template <class Read>
auto with_file(const std::filesystem::path& file, const Read& read)
    -> Result<decltype(read(std::declval<Imf::InputFile&>(), ImageHeader()))> {
  try {
    // Buffers of a few rows are taken on opening: before anything is checked here.
    constexpr int longest_side = 1 << 22;
    Imf::Header::setMaxImageSize(longest_side, longest_side);
    Imf::InputFile input(file.c_str(), 0);
    ImageHeader header = to_image_header(input.header());
    if (header.channels.empty()) return file_problem(file, "the picture has no pixels");
    const auto& channels = input.header().channels();
    for (auto c = channels.begin(); c != channels.end(); ++c)
      if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
        return file_problem(file, "can't read the picture: channel " + quoted(c.name()) +
                                      " has fewer samples than there are pixels");
    if (const auto wrong = check_size(file, header.width, header.height, header.channels.size());
        !wrong)
      return tl::unexpected<Problem>(wrong.error());
    return read(input, std::move(header));
  } catch (const std::exception& error) {
    return file_problem(file, "can't read the picture: " + first_line(error.what()));
  }
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
            frame_buffer(description.channels, values.data(), description.width, end - y, 0, y));
        output.writePixels(end - y);
      }
    }
    return std::move(stream.bytes);
  } catch (const std::exception& error) {
    return problem("can't encode the picture: " + first_line(error.what()));
  }
}

Result<ImageHeader> read_exr_header(const std::filesystem::path& file) {
  return with_file(file, [](Imf::InputFile&, ImageHeader header) { return header; });
}

Result<Image> read_exr(const std::filesystem::path& file) {
  return with_file(file, [](Imf::InputFile& input, ImageHeader header) {
    Image image = make_image(header.width, header.height, std::move(header.channels));
    const Imath::Box2i& window = input.header().dataWindow();
    input.setFrameBuffer(frame_buffer(image.channels, image.pixels.data(), image.width,
                                      image.height, window.min.x, window.min.y));
    input.readPixels(window.min.y, window.max.y);
    return image;
  });
}

}  // namespace metamer
