#pragma once

#include <memory>
#include <span>

#include "server/film/film.h"
#include "server/film/sample_pattern.h"
#include "server/methods/method.h"
#include "server/worker/job.h"

namespace metamer {

/// Draws a view's frames, on the CPU or the GPU. Knows the geometry; what else it draws by may
/// change. Belongs to the lane's thread.
class ViewPicture {
 public:
  virtual ~ViewPicture() = default;

  /// Of a scene in camera space, which must outlive it. `key` as geometry_key has it. Errors: what
  /// the GPU does not hold.
  static Result<std::unique_ptr<ViewPicture>> make(const RenderScene& scene, const std::string& key,
                                                   const WorkerOptions& options);

  /// Lights, materials, plan or method have changed; both must outlive the next change. Errors:
  /// what the GPU does not hold or compile.
  virtual Result<void> change(const v1::Plan& plan, const Method& method) = 0;

  /// X Y Z of all pixels of the film from the scene's camera, the mean of these samples; of some of
  /// them only when `cancelled` becomes true.
  virtual Result<void> draw(const Film& film, std::span<const SamplePoint> samples,
                            const std::atomic<bool>& cancelled, Work& work) = 0;
};

}  // namespace metamer
