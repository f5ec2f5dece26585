#pragma once

#include <memory>
#include <span>
#include <string>

#include "common/color/rgb_space.h"

/// ICC profiles (ICC.1), by LittleCMS.
namespace metamer {

/// A profile (version 4.3) that says what numbers in this space mean: a display profile of matrix
/// and curves, adapted to the profile's D50 by Bradford's matrix. Its bytes depend on nothing else.
std::string icc_profile(const RgbSpace& space, bool linear);

/// What a profile says of the numbers of a picture.
class IccReader {
 public:
  /// `grey`: one number a pixel, else R, G, B. Error: no profile, one of other numbers, or one
  /// that does not lead to X Y Z.
  static Result<IccReader> open(const std::string& profile, bool grey);

  /// The profile's description, in letters of ASCII; may be empty.
  const std::string& name() const { return name_; }

  /// X Y Z as a screen of D65 shows it, relative to the medium's white (Y = 1), as relative
  /// colorimetry has it, adapted from the profile's D50 by Bradford's matrix. `values` are in 0..1,
  /// 1 or 3 a pixel; `xyz` has 3.
  void to_xyz(std::span<const float> values, std::span<float> xyz) const;

 private:
  IccReader(std::shared_ptr<void> transform, std::string name, bool grey)
      : transform_(std::move(transform)), name_(std::move(name)), grey_(grey) {}

  std::shared_ptr<void> transform_;  ///< With the context that it belongs to.
  std::string name_;
  bool grey_;
};

}  // namespace metamer
