#pragma once

#include <chrono>
#include <memory>
#include <span>

#include "server/film/film.h"
#include "server/film/sample_pattern.h"
#include "server/methods/method.h"
#include "server/worker/job.h"

namespace metamer::worker {

/// Draws a view's frames, on the CPU or the GPU. Knows the geometry; what else it draws by may
/// change. Belongs to the lane's thread.
class ViewPicture {
 public:
  virtual ~ViewPicture() = default;

  /// Lights, materials, plan or method have changed; both must outlive the next change. Errors:
  /// what the GPU does not hold or compile.
  virtual Result<void> change(const v1::Plan& plan, const Method& method) = 0;

  using Clock = std::chrono::steady_clock;
  /// X Y Z of the film's pixels from the scene's camera, the mean of these samples, part by part
  /// until it is time for others. `next` is where to go on: 0 for a new picture. True: all is
  /// drawn.
  virtual Result<bool> draw(const Film& film, std::span<const SamplePoint> samples,
                            Clock::time_point until, std::uint32_t& next, Work& work) = 0;
};

/// Of a scene in camera space, which must outlive it.
std::unique_ptr<ViewPicture> cpu_picture(const RenderScene& scene, cpu::EmbreeScene geometry);
/// The same; `key` as geometry_key has it. Errors: what the GPU does not hold.
Result<std::unique_ptr<ViewPicture>> gl_picture(const RenderScene& scene, const std::string& key,
                                                gl::Device& device);

}  // namespace metamer::worker
