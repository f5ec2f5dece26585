#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/image/read_png.h"
#include "common/problem.h"

namespace metamer {

/// A picture that a scene lays on a surface, on its way from bytes to numbers; errors are located.
class PictureFile {
 public:
  /// `field` is that of the message which has `file`. Both must outlive it.
  PictureFile(const std::string& file, const std::string& field) : file_(file), field_(field) {}

  bool is_png() const;

  /// Which of a file's channels are meant, in their order; each once, and known to the file.
  using Choose = std::function<Result<std::vector<std::string>>(const std::vector<std::string>&)>;
  struct Pixels {
    Image image;
    std::vector<std::size_t> places;  ///< In a pixel, of the channels that were chosen.
    int bits = 32;                    ///< Of a stored sample: of a PNG 8 or 16.
  };
  /// Of an EXR no channels are read that nobody asks for. Errors: a file that is no picture, those
  /// of `choose`.
  Result<Pixels> read(const std::string& bytes, PngSamples samples, const Choose& choose) const;

  /// A name that the scene gives a channel, as one of `known`; `below`: of the field.
  Result<void> check_channel(const std::string& channel, const std::vector<std::string>& known,
                             const std::string& below) const;
  /// "the file has 3 channels (R G B), 1 is needed: name those that are meant"
  tl::unexpected<Problem> wrong_channels(const std::vector<std::string>& known,
                                         std::size_t wanted) const;
  /// limits::max_texture_weights, with so many weights a pixel.
  Result<void> check_size(int width, int height, std::uint32_t weights) const;

  tl::unexpected<Problem> at(const std::string& below, Problem what) const;
  tl::unexpected<Problem> at(const std::string& below, std::string message) const;
  tl::unexpected<Problem> at_pixel(const Image& image, std::size_t pixel,
                                   const std::string& what) const;

 private:
  const std::string& file_;
  const std::string& field_;
};

}  // namespace metamer
