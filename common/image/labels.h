#pragma once

#include <string>
#include <vector>

#include "common/image/image.h"

namespace metamer {

/// A line of text in a picture.
struct Label {
  enum class Place { left, center, right };

  int x = 0,
      y = 0;  ///< Where its base line begins, has its middle or ends; pixels from the upper left.
  std::string words = {};
  int width = 0;  ///< What is wider ends in "..."; 0: as wide as it is.
  Place place = Place::left;
  float grey = 1;  ///< Its Y; D65's white at 1.
};

/// Draws labels into a picture (X Y Z) in DejaVu Sans. What is not ASCII is drawn as "?". Error:
/// the font is not there.
Result<void> draw_labels(Image& image, const std::vector<Label>& labels);

inline constexpr int label_height = 13;  ///< Pixels, of a capital with what is below the base line.

}  // namespace metamer
