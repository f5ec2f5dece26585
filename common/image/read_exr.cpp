#include "common/image/read_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <boost/interprocess/streams/bufferstream.hpp>
#include <cstring>
#include <exception>
#include <fstream>
#include <stdexcept>

#include "common/image/exr_header.h"
#include "common/image/picture_file.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;

PixelWindow to_window(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x, box.max.y};
}

ExrPart to_part(const Imf::Header& header) {
  ExrPart part;
  if (header.hasName()) part.name = header.name();
  if (header.hasView()) part.view = header.view();
  if (header.hasType()) part.type = header.type();
  part.display = to_window(header.displayWindow());
  part.data = to_window(header.dataWindow());
  const Imf::ChannelList& channels = header.channels();
  for (auto c = channels.begin(); c != channels.end(); ++c)
    part.channels.push_back(
        {.name = c.name(),
         .whole_numbers = c.channel().type == Imf::UINT,
         .subsampled = c.channel().xSampling != 1 || c.channel().ySampling != 1});
  if (Imf::hasChromaticities(header)) {
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    for (const Imath::V2f& xy : {c.red, c.green, c.blue, c.white}) {
      part.chromaticities.push_back(xy.x);
      part.chromaticities.push_back(xy.y);
    }
  }
  if (const auto* units = header.findTypedAttribute<Imf::StringAttribute>("emissiveUnits"))
    part.emissive_units = units->value();
  return part;
}

/// Bytes in memory as OpenEXR reads a file.
class ByteStream : public Imf::IStream {
 public:
  ByteStream(std::string_view bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (count < 0 || at_ > bytes_.size() || static_cast<std::size_t>(count) > bytes_.size() - at_)
      throw std::runtime_error("it ends too early");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

Result<void> check_header(const PictureSource& source) {
  if (source.bytes) {
    boost::interprocess::ibufferstream in(source.bytes->data(), source.bytes->size());
    return check_exr_header(in, source.name);
  }
  std::ifstream in(source.name, std::ios::binary);
  return check_exr_header(in, source.name);
}

/// Opens the file and lets `read` take it from there; what OpenEXR throws becomes a value.
template <class Read>
auto with_exr(const PictureSource& source, const Read& read)
    -> decltype(read(std::declval<Imf::MultiPartInputFile&>())) {
  if (auto good = check_header(source); !good) return tl::unexpected<Problem>(good.error());
  try {
    // What a header may ask for before anything is checked here: a table of its rows or tiles.
    constexpr int longest_side = 1 << 22;
    Imf::Header::setMaxImageSize(longest_side, longest_side);
    Imf::Header::setMaxTileSize(longest_side, longest_side);
    if (!source.bytes) {
      Imf::MultiPartInputFile input(source.name.c_str(), 0);
      return read(input);
    }
    ByteStream stream(*source.bytes, source.name.string());
    Imf::MultiPartInputFile input(stream, 0);
    return read(input);
  } catch (const std::exception& error) {
    return file_problem(source.name, "can't read the picture: " + first_line(error.what()));
  }
}

/// Why these channels can't be read; the size decides how much memory is taken.
Result<void> check_part(const fs::path& file, const ExrPart& part, const PixelWindow& wanted,
                        const std::vector<std::string>& channels) {
  if (part.deep())
    return file_problem(file, "can't read the picture: it is deep (" + part.type + ")");
  for (const ExrChannel& channel : part.channels)
    if (channel.subsampled &&
        std::find(channels.begin(), channels.end(), channel.name) != channels.end())
      return file_problem(file, "can't read the picture: channel " + quoted(channel.name) +
                                    " has fewer samples than there are pixels");
  for (const PixelWindow& window : {wanted, part.data})
    if (auto good = check_size(file, window.width(), window.height(), channels.size()); !good)
      return good;
  const PixelWindow &a = part.display, &b = part.data;
  if (b.x0 > a.x1 || b.x1 < a.x0 || b.y0 > a.y1 || b.y1 < a.y0)
    return file_problem(file,
                        "the picture has no pixels: its data window lies outside of its "
                        "display window");
  return {};
}

/// Interleaved values of rows from y of a data window.
Imf::FrameBuffer rows_to_read(const std::vector<std::string>& channels, float* values,
                              const PixelWindow& data, int rows, int y) {
  const std::size_t pixel = channels.size() * sizeof(float);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < channels.size(); ++c)
    buffer.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, values + c, Imath::V2i(data.x0, y),
                                                data.width(), rows, pixel));
  return buffer;
}

Image read_pixels(Imf::MultiPartInputFile& file, int number, const PixelWindow& display,
                  const PixelWindow& data, const std::vector<std::string>& channels) {
  Image image = make_image(display.width(), display.height(), channels);
  Imf::InputPart input(file, number);
  const int x0 = std::max(display.x0, data.x0), x1 = std::min(display.x1, data.x1);
  const int end = std::min(display.y1, data.y1) + 1;
  if (x0 > x1) return image;
  constexpr int rows_at_a_time = 64;  // no second picture is held
  const std::size_t row = static_cast<std::size_t>(data.width()) * channels.size();
  std::vector<float> values(row *
                            static_cast<std::size_t>(std::min(rows_at_a_time, data.height())));
  for (int y = std::max(display.y0, data.y0), next = y; y < end; y = next) {
    next = std::min(y + rows_at_a_time, end);
    input.setFrameBuffer(rows_to_read(channels, values.data(), data, next - y, y));
    input.readPixels(y, next - 1);
    for (int line = y; line < next; ++line) {
      const float* from = values.data() + static_cast<std::size_t>(line - y) * row +
                          static_cast<std::size_t>(x0 - data.x0) * channels.size();
      std::copy_n(from, static_cast<std::size_t>(x1 - x0 + 1) * channels.size(),
                  image.at(x0 - display.x0, line - display.y0));
    }
  }
  return image;
}

}  // namespace

Result<std::vector<ExrPart>> read_exr_parts(const PictureSource& source) {
  return with_exr(source, [](const Imf::MultiPartInputFile& input) -> Result<std::vector<ExrPart>> {
    std::vector<ExrPart> parts;
    for (int i = 0; i < input.parts(); ++i) parts.push_back(to_part(input.header(i)));
    return parts;
  });
}

Result<Image> read_exr(const PictureSource& source, const std::vector<ExrPart>& parts,
                       std::size_t part, const std::vector<std::string>& channels,
                       const std::optional<PixelWindow>& only) {
  const PixelWindow& display = parts[part].display;
  const PixelWindow wanted = !only ? display
                                   : PixelWindow{display.x0 + only->x0, display.y0 + only->y0,
                                                 display.x0 + only->x1, display.y0 + only->y1};
  if (const auto good = check_part(source.name, parts[part], wanted, channels); !good)
    return tl::unexpected<Problem>(good.error());
  return with_exr(source, [&](Imf::MultiPartInputFile& input) -> Result<Image> {
    const int number = static_cast<int>(part);
    if (input.parts() != static_cast<int>(parts.size()) ||
        to_window(input.header(number).dataWindow()) != parts[part].data)
      return file_problem(source.name, "the file has changed");
    return read_pixels(input, number, wanted, parts[part].data, channels);
  });
}

}  // namespace metamer
