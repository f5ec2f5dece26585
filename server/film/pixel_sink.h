#pragma once

#include <memory>

#include "server/film/film.h"
#include "server/methods/method.h"

namespace metamer {

/// Takes what each pixel of a picture received. Belongs to one thread.
class PixelSink {
 public:
  virtual ~PixelSink() = default;
  /// `gather` holds sums over the samples of the pixel; it is the tracer's, and gone afterwards.
  virtual void take(std::uint32_t x, std::uint32_t y, const Gather& gather) = 0;
};

/// Turns it into colour by a method, for the film. Both must outlive it.
class FilmSink : public PixelSink {
 public:
  FilmSink(const Method& method, const Film& film, std::uint32_t spp)
      : method_(method),
        film_(film),
        scale_(1 / static_cast<float>(spp)),
        scratch_(method.make_scratch()) {}

  void take(std::uint32_t x, std::uint32_t y, const Gather& gather) override {
    film_.set(x, y, method_.resolve(gather, scale_, *scratch_));
  }

 private:
  const Method& method_;
  const Film& film_;
  float scale_;
  std::unique_ptr<Method::Scratch> scratch_;
};

}  // namespace metamer
