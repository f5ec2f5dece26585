#pragma once

#include <cstddef>
#include <span>

#include "common/problem.h"

namespace metamer::gl {

/// Memory of the GPU. Needs a current Context, also to be destroyed.
class Buffer {
 public:
  Buffer() = default;
  /// So many bytes, zero. Errors: more than a shader storage block of this device holds, or than
  /// there is memory for; `what` names it: "the vertices' positions".
  static Result<Buffer> zeros(const char* what, std::size_t bytes);
  template <class T>
  static Result<Buffer> of(const char* what, std::span<const T> values) {
    return copy(what, values.data(), values.size_bytes());
  }

  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;
  ~Buffer();

  void bind_storage(unsigned binding) const;
  unsigned name() const { return name_; }
  void read(std::span<float> to) const;
  void clear() const;

 private:
  static Result<Buffer> copy(const char* what, const void* data, std::size_t bytes);

  unsigned name_ = 0;
};

}  // namespace metamer::gl
