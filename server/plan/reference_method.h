#pragma once

#include "server/methods/method.h"
#include "server/plan/reference.h"

namespace metamer {

/// The reference as any renderer can draw by it: a whole picture of it is what a finished one is
/// verified against. In f64 where it resolves; its direct tables are the same cells in f32, whose
/// sums are within 1e-5.
class ReferenceMethod : public Method {
 public:
  /// `scene` must outlive it.
  ReferenceMethod(const RenderScene& scene, const Observer& observer);
  ~ReferenceMethod() override;

  std::unique_ptr<Scratch> make_scratch() const override;
  std::array<float, 3> resolve(const Gather& gather, float scale, Scratch& scratch) const override;
  DirectTables direct_tables() const override;
  double preparation_cost() const override;
  double resolve_cost(const Gather& gather) const override;

 private:
  struct Own;

  const RenderScene& scene_;
  Observer observer_;
  std::size_t bands_, rows_;
};

}  // namespace metamer
