#pragma once

#include "common/mesh/gltf/document.h"

namespace metamer::gltf {

/// Elements of numbers in a buffer (glTF 2.0, 3.6.2), with the sparse ones laid over them; all that
/// its numbers say is within its bytes.
class Accessor {
 public:
  enum class Type : std::uint16_t { i8 = 5120, u8, i16, u16, u32 = 5125, f32 };

  /// Of the document's list. `types`: those that its use may have, as "VEC3". Nothing: there is
  /// none, or a fault.
  static std::optional<Accessor> open(Document& document, const Value& index,
                                      std::initializer_list<std::string_view> types);

  std::size_t size() const { return count_; }
  std::size_t components() const { return components_; }
  Type type() const { return type_; }
  bool normalized() const { return normalized_; }

  /// Component `c` of element `i`; as f64 with what `normalized` says (3.11).
  double number(std::size_t i, std::size_t c) const;
  std::uint32_t whole(std::size_t i) const;  ///< Of unsigned scalars.
  /// The bytes of an element of f32, where none is sparse: for long lists. Null: not so.
  const char* f32(std::size_t i) const {
    return type_ == Type::f32 && sparse_.empty() && data_ != nullptr ? data_ + i * stride_
                                                                     : nullptr;
  }

 private:
  /// An element's bytes; null: all 0.
  const char* element(std::size_t i) const;
  bool open_dense(Document& document, const Value& accessor);
  bool open_sparse(Document& document, const Value& sparse);

  std::size_t count_ = 0, components_ = 1, stride_ = 0;
  Type type_ = Type::f32;
  bool normalized_ = false;
  const char* data_ = nullptr;
  struct Sparse {
    std::uint64_t index;
    const char* value;
  };
  std::vector<Sparse> sparse_;  ///< In the order of their indices.
};

}  // namespace metamer::gltf
