#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "metamer/v1/plan.pb.h"
#include "metamer/v1/scene.pb.h"
#include "server/film/film.h"
#include "server/methods/method.h"
#include "server/scene/render_scene.h"

namespace metamer::test {

/// The scene that a text in protobuf text format describes; the text must be right.
v1::Scene parse_scene(const std::string& text);

/// Files by their names.
using Files = std::map<std::string, std::string>;

/// Compiled with no other assets; must be sound.
RenderScene compile_text(const std::string& text, const Files& files = {});

/// A picture and the rays that it took.
struct Rendered {
  std::uint32_t width, height;
  std::vector<float> xyz;
  std::uint64_t rays = 0;
  std::array<float, 3> at(std::uint32_t x, std::uint32_t y) const {
    const float* p = xyz.data() + (std::size_t{y} * width + x) * 3;
    return {p[0], p[1], p[2]};
  }
};

/// What a method makes of one pixel.
std::array<float, 3> resolve(const Method& method, const Gather& gather);

/// Compiles, plans and renders on this thread, by tiles of the settings' size.
Rendered render(const std::string& scene_text, const Files& files = {});

}  // namespace metamer::test
