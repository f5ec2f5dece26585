#include "server/gl/multi_pass.h"

#include <epoxy/gl.h>

namespace metamer::gl {

Result<MultiPass> MultiPass::create(const DirectTables& tables, std::uint32_t lights) {
  MultiPass result;
  result.groups_ = tables.size;
  result.lights_ = lights;
  auto values = Buffer::of<float>("the lights' values", tables.lights);
  auto observer = Buffer::of<float>("the observer's values", tables.observer);
  for (auto* buffer : {&values, &observer})
    if (!*buffer) return tl::unexpected(buffer->error());
  result.light_values_ = std::move(*values);
  result.observer_ = std::move(*observer);
  return result;
}

Result<void> MultiPass::run(const Programs& programs, const Geometry& geometry,
                            const Buffer& places, const RegionView& view, SamplePoint place,
                            const Control& control) {
  const Rect& region = view.region;
  if (!target_.is(region.width, region.height)) {
    auto target = Target::make(Target::Content::values, region.width, region.height);
    if (!target) return tl::unexpected(target.error());
    target_ = std::move(*target);
  }
  light_values_.bind_storage(12);
  observer_.bind_storage(8);
  glBindTextureUnit(1, target_.texture());
  for (const Program* program : {&programs.pass_triangles, &programs.pass_spheres})
    view.set(*program, place);
  view.set(programs.combine, place);
  programs.combine.set("value_size", groups_);
  for (std::uint32_t group = 0; group < groups_; ++group)
    for (std::uint32_t light = 0; light < lights_ && !control.cancelled; ++light) {
      for (const Program* program :
           {&programs.pass_triangles, &programs.pass_spheres, &programs.combine})
        program->set("group", group);
      for (const Program* program : {&programs.pass_triangles, &programs.pass_spheres})
        program->set("light", light);
      target_.begin();
      places.bind_storage(3);  // until spheres are drawn
      geometry.draw(programs.pass_triangles, programs.pass_spheres);
      programs.combine.use();
      dispatch_over(region);
      ++control.work;
    }
  return {};
}

}  // namespace metamer::gl
