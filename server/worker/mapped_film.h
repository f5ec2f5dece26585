#pragma once

#include <sys/mman.h>
#include <sys/stat.h>

#include <cstddef>

#include "metamer/v1/plan.pb.h"

namespace metamer::worker {

/// The film's memory, mapped for as long as this lives.
class MappedFilm {
 public:
  MappedFilm(int descriptor, const v1::Plan& plan)
      : size_(std::size_t{plan.width()} * plan.height() * 3 * sizeof(float)) {
    struct stat status;
    if (fstat(descriptor, &status) != 0 || static_cast<std::size_t>(status.st_size) < size_) return;
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  ~MappedFilm() {
    if (*this) munmap(memory_, size_);
  }
  MappedFilm(const MappedFilm&) = delete;
  MappedFilm& operator=(const MappedFilm&) = delete;
  explicit operator bool() const { return memory_ != MAP_FAILED; }
  float* xyz() const { return static_cast<float*>(memory_); }

 private:
  std::size_t size_;
  void* memory_ = MAP_FAILED;
};

}  // namespace metamer::worker
