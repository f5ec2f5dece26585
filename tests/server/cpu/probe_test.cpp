// Pixels that are traced before the picture.
#include "server/cpu/probe.h"

#include <gtest/gtest.h>

#include "common/scene/settings.h"
#include "server/plan/plan.h"
#include "server/scene/camera_space.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

// Neighbours that share a packet with a place were not drawn, and a bound by as many draws would
// not hold.
TEST(TracingProbe, ARandomRunIsOfItsPlacesAlone) {
  for (const unsigned spp : {1u, 2u, 3u, 5u, 8u}) {
    const std::string text =
        "camera { eye { z: 4 } target {} } light { name: 'l' direction { z: -1 } spectrum { "
        "standard: 'D65' } } "
        "material { name: 'm' diffuse { constant: 0.5 } } object { name: 'o' material: 'm' sphere "
        "{ radius: 1 } } "
        "settings { width: 40 height: 30 spp: " +
        std::to_string(spp) + " method { rgb {} } }";
    const RenderScene scene = to_camera_space(compile_text(text));
    const v1::Plan plan =
        make_plan(scene, with_defaults(parse_scene(text).settings()), {.threads = 1});
    cpu::TracingProbe probe(std::make_shared<cpu::Geometry>(scene, 1));
    const std::atomic<bool> never = false;
    std::atomic<std::uint64_t> work = 0;
    ASSERT_TRUE(probe.prepare(never));
    const TracedPixels pixels =
        probe.trace(plan, {.first = 3, .count = 11, .random = true}, never, work);
    EXPECT_EQ(pixels.gathers.size(), 11u) << spp;
  }
}

}  // namespace
}  // namespace metamer::test
