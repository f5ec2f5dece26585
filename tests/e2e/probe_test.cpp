// What is under a place of a view, against closed forms: nothing here but the CIE's tables is the
// server's.
#include <cmath>

#include "client/tools/pictures/planned_developing.h"
#include "common/color/eight_bit.h"
#include "common/scene/probed.h"
#include "common/spectral/cie.h"
#include "viewer.h"

namespace metamer::test {
namespace {

using namespace client;
using Spectra = google::protobuf::RepeatedField<double>;

/// Linear between the samples of a table of the CIE's, 0 outside.
double table_at(const Spectrum& table, double nm) {
  if (nm < table.nm.front() || nm > table.nm.back()) return 0;
  for (std::size_t i = 1; i < table.nm.size(); ++i) {
    if (nm > table.nm[i]) continue;
    const double t = (nm - table.nm[i - 1]) / (table.nm[i] - table.nm[i - 1]);
    return table.values[i - 1] + t * (table.values[i] - table.values[i - 1]);
  }
  return 0;
}

/// D65 of this luminance, at every whole nm from 360 to 830.
std::vector<double> d65(double luminance) {
  const Spectrum table = *cie::illuminant("D65");
  const Spectrum& y_bar = cie::observer_1931().functions()[1];
  std::vector<double> values;
  double sum = 0;
  for (int nm = 360; nm <= 830; ++nm) {
    values.push_back(table_at(table, nm));
    sum += values.back() * table_at(y_bar, nm);
  }
  for (double& value : values) value *= luminance / sum;
  return values;
}

/// The quad's paint: from 0.2 at 400 nm to 0.9 at 700.
double paint(int nm) { return 0.2 + 0.7 * (std::clamp(nm, 400, 700) - 400) / 300; }
const char* const paint_text =
    "samples { wavelength: [400, 700] value: [0.2, 0.9] } interpolation: LINEAR";

std::array<double, 3> seen(const Spectra& eye) {
  std::array<double, 3> xyz{};
  for (int i = 0; i < eye.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      xyz[c] += eye[i] * table_at(cie::observer_1931().functions()[c], 360 + i);
  return xyz;
}

/// A matte quad in z = 0 of 2 by 2, in the middle of the picture; the lamp's light meets its middle
/// at a cosine of 0.8.
v1::Scene quad_scene() {
  return parsed(std::string("camera { eye { z: 5 } vertical_fov: 35 } light { name: 'lamp' "
                            "position { x: 3 z: 4 } spectrum { standard: 'D65' } luminance: 0.9 } "
                            "material { name: 'paint' lambert {} diffuse { ") +
                paint_text +
                " } } object { name: 'card' material: 'paint' quad { corner { x: -1 y: -1 } u { x: "
                "2 } v { y: 2 } } } settings { width: 75 height: 53 spp: 4 }");
}

class ProbeOf : public testing::TestWithParam<v1::Backend> {};

TEST_P(ProbeOf, AMatteQuadIsItsPaintTimesTheLightThatFalls) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(quad_scene(), GetParam());
  ASSERT_TRUE(view) << viewer.error().message;
  const View::Picture picture = viewer.complete(*view, 0);
  const Answer<v1::Probed> probed = viewer.probe(*view, 37, 26);
  ASSERT_TRUE(probed) << probed.error().message;
  EXPECT_EQ(probed->revision(), 0u);
  EXPECT_EQ(probed->object(), "card");
  EXPECT_EQ(probed->material(), "paint");
  for (const double zero : {probed->place().x(), probed->place().y(), probed->place().z(),
                            probed->normal().x(), probed->normal().y()})
    EXPECT_NEAR(zero, 0, 1e-6);
  EXPECT_NEAR(probed->normal().z(), 1, 1e-6);
  const std::vector<double> lamp = d65(0.9);
  ASSERT_EQ(probed->eye_size(), probed_values);
  for (int i = 0; i < probed_values; ++i) {
    const double light = 0.8 * lamp[static_cast<std::size_t>(i)];
    ASSERT_NEAR(probed->light(i), light, 1e-5 * light) << 360 + i;
    ASSERT_NEAR(probed->surface(i), paint(360 + i), 1e-9) << 360 + i;
    ASSERT_NEAR(probed->eye(i), light * paint(360 + i), 1e-5 * light) << 360 + i;
  }
  ASSERT_EQ(probed->xyz_size(), 3);
  for (std::size_t c = 0; c < 3; ++c) {
    // Four samples about the middle: as they lie to all sides of it, they differ by the square.
    EXPECT_NEAR(seen(probed->eye())[c], probed->xyz(static_cast<int>(c)),
                1e-4 * probed->xyz(static_cast<int>(c)));
  }
}

TEST_P(ProbeOf, ABackgroundIsNothing) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(quad_scene(), GetParam());
  ASSERT_TRUE(view) << viewer.error().message;
  // Nothing was drawn yet.
  const Answer<v1::Probed> before = viewer.probe(*view, 0, 0);
  ASSERT_TRUE(before) << before.error().message;
  EXPECT_EQ(before->xyz_size(), 0);
  viewer.complete(*view, 0);
  const Answer<v1::Probed> probed = viewer.probe(*view, 74, 52, 64);
  ASSERT_TRUE(probed) << probed.error().message;
  EXPECT_TRUE(probed->object().empty());
  EXPECT_EQ(probed->eye_size() + probed->light_size() + probed->surface_size(), 0);
  ASSERT_EQ(probed->xyz_size(), 3);
  EXPECT_GT(probed->xyz(1), 0) << "the square holds some of the card";
}

TEST_P(ProbeOf, APlaceOutsideIsRefusedAndTheViewLivesOn) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(quad_scene(), GetParam());
  ASSERT_TRUE(view) << viewer.error().message;
  struct Outside {
    std::uint32_t x, y, side;
    const char* message;
  };
  for (const Outside& one :
       {Outside{75, 0, 1, "the place (75, 0) lies outside the view's 75x53 pixels"},
        Outside{0, 53, 1, "the place (0, 53) lies outside the view's 75x53 pixels"},
        Outside{0, 0, 65, "a probe's square has at most 64 pixels a side"}}) {
    const Answer<v1::Probed> probed = viewer.probe(*view, one.x, one.y, one.side);
    ASSERT_FALSE(probed) << one.message;
    EXPECT_EQ(probed.error().code, v1::Error::LIMIT);
    EXPECT_EQ(probed.error().message, one.message);
  }
  EXPECT_FALSE(viewer.complete(*view, 0).rgb.empty());
}

/// The 8 bits that a client makes of X Y Z.
std::vector<std::uint8_t> developed(const std::vector<float>& xyz, const v1::Plan& plan) {
  const auto planned = planned_developing(plan);
  EXPECT_TRUE(planned);
  const Developing& by = planned->developing;
  const Matrix3 matrix = multiply(by.space.from_xyz, by.adaptation);
  const EightBit codes(by.space.transfer);
  std::vector<std::uint8_t> rgb;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    for (const Vector3& row : matrix)
      rgb.push_back(codes(static_cast<float>(row[0] * double{xyz[i]} + row[1] * double{xyz[i + 1]} +
                                             row[2] * double{xyz[i + 2]})));
  return rgb;
}

TEST_P(ProbeOf, FramesHaveTheXyzThatTheirColoursAreMadeOf) {
  const Daemon daemon;
  Viewer viewer(daemon);
  v1::Scene scene = direct_scene();
  // Several bands.
  scene.mutable_settings()->set_width(300);
  scene.mutable_settings()->set_height(200);
  const auto view = viewer.open(scene, GetParam());
  ASSERT_TRUE(view) << viewer.error().message;
  View::Picture picture;
  for (int i = 0; i < 10 && !picture.frame.complete(); ++i) {
    viewer.ask(*view, true);
    const auto next = viewer.next(*view);
    ASSERT_TRUE(next) << viewer.error().message;
    picture = *next;
    EXPECT_EQ(picture.xyz.size(), picture.frame.complete() ? picture.rgb.size() : 0);
  }
  ASSERT_TRUE(picture.frame.complete());
  EXPECT_EQ(developed(picture.xyz, view->plan()), picture.rgb);
  const Answer<v1::Probed> probed = viewer.probe(*view, 150, 120);
  ASSERT_TRUE(probed) << probed.error().message;
  ASSERT_EQ(probed->xyz_size(), 3);
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(probed->xyz(c), picture.xyz[(120 * 300 + 150) * 3 + static_cast<std::size_t>(c)]);
}

INSTANTIATE_TEST_SUITE_P(Backend, ProbeOf, testing::Values(v1::CPU, v1::GL),
                         [](const auto& info) { return v1::Backend_Name(info.param); });

/// The eye looks at a mirror that turns its look by a right angle, to a wall that faces the lamp at
/// a cosine of 0.8; the mirror itself has its edge to the lamp.
TEST(Probe, AMirrorShowsWhatItReflects) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(parsed(
      std::string("camera { eye { z: 5 } vertical_fov: 5 } light { name: 'lamp' position { y: 3 } "
                  "spectrum { standard: 'D65' } } material { name: 'glass' lambert {} diffuse { "
                  "constant: 0 } specular { constant: 0.5 } mirror: 0.8 } material { name: 'paint' "
                  "lambert {} diffuse { ") +
      paint_text +
      " } } object { name: 'mirror' material: 'glass' quad { corner { x: -0.5 y: -0.5 z: 0.5 } u { "
      "x: 1 z: -1 } v { y: 1 } } } object { material: 'paint' quad { corner { x: 4 y: -1 z: 1 } u "
      "{ z: -2 } v { y: 2 } } } settings { width: 9 height: 9 spp: 4 depth: 2 }"));
  ASSERT_TRUE(view) << viewer.error().message;
  const Answer<v1::Probed> probed = viewer.probe(*view, 4, 4);
  ASSERT_TRUE(probed) << probed.error().message;
  EXPECT_EQ(probed->object(), "mirror");
  EXPECT_NEAR(probed->normal().x(), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(probed->normal().z(), std::sqrt(0.5), 1e-6);
  const std::vector<double> lamp = d65(1);
  ASSERT_EQ(probed->eye_size(), probed_values);
  for (int i = 0; i < probed_values; ++i) {
    const double wall = 0.8 * lamp[static_cast<std::size_t>(i)] * paint(360 + i);
    ASSERT_NEAR(probed->eye(i), 0.8 * 0.5 * wall, 1e-5 * wall) << 360 + i;
    ASSERT_NEAR(probed->light(i), 0, 1e-6) << 360 + i;
    ASSERT_EQ(probed->surface(i), 0) << 360 + i;
  }
}

TEST(Probe, AnObjectWithoutANameIsToldByItsPlaceInTheScene) {
  const Daemon daemon;
  Viewer viewer(daemon);
  v1::Scene scene = quad_scene();
  scene.mutable_object(0)->clear_name();
  const auto view = viewer.open(scene);
  ASSERT_TRUE(view) << viewer.error().message;
  const Answer<v1::Probed> probed = viewer.probe(*view, 37, 26);
  ASSERT_TRUE(probed) << probed.error().message;
  EXPECT_EQ(probed->object(), "object[0]");
}

TEST(Probe, FollowsAChange) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(quad_scene());
  ASSERT_TRUE(view) << viewer.error().message;
  viewer.complete(*view, 0);
  ASSERT_TRUE(viewer.probe(*view, 37, 26));
  v1::UpdateView change;
  change.set_revision(1);
  *change.add_material() = quad_scene().material(0);
  change.mutable_material(0)->mutable_diffuse()->Clear();
  change.mutable_material(0)->mutable_diffuse()->set_constant(0.25);
  viewer.update(*view, change);
  const Answer<v1::Probed> probed = viewer.probe(*view, 37, 26);
  ASSERT_TRUE(probed) << probed.error().message;
  EXPECT_EQ(probed->revision(), 1u);
  EXPECT_EQ(probed->surface(100), 0.25);
  EXPECT_EQ(probed->xyz_size(), 0) << "no frame of this revision was drawn";
}

}  // namespace
}  // namespace metamer::test
