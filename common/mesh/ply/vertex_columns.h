#pragma once

#include <string_view>
#include <vector>

#include "common/mesh/ply/header.h"

namespace metamer::ply {

/// Which numbers of a row go where: x y z, nx ny nz, u v.
class VertexColumns {
 public:
  explicit VertexColumns(const Element& element) : slots_(element.properties.size(), -1) {
    position_ = add(element, {"x", "y", "z"}, 0);
    normal_ = add(element, {"nx", "ny", "nz"}, 3);
    for (const auto& names : uv_names)
      if (!uv_ && add(element, names, 6)) uv_ = true;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const Scalar type = element.properties[i].type;
      const bool fits = size_of(type) < 4 || type == Scalar::f32;
      if (slots_[i] >= 0 && slots_[i] < 3 && !fits) wide_ = true;
    }
  }
  bool position() const { return position_; }
  bool normal() const { return normal_; }
  bool uv() const { return uv_; }
  /// Whether positions have more digits than f32.
  bool wide() const { return wide_; }
  /// Where a property goes in a row; below 0: nowhere.
  int slot(std::size_t property) const { return slots_[property]; }

 private:
  using Names = std::vector<std::string_view>;
  inline static const Names uv_names[] = {
      {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};

  /// Gives slots to properties of these names, if all are there.
  bool add(const Element& element, const Names& names, int first) {
    std::vector<std::size_t> found;
    for (const std::string_view name : names)
      if (const auto property = element.find({name});
          property && !element.properties[*property].count)
        found.push_back(*property);
    if (found.size() != names.size()) return false;
    for (std::size_t i = 0; i < found.size(); ++i) slots_[found[i]] = first + static_cast<int>(i);
    return true;
  }

  std::vector<int> slots_;
  bool position_ = false, normal_ = false, uv_ = false, wide_ = false;
};

}  // namespace metamer::ply
