// Views as a client has them: frames, changes, and what is refused.
#include <cstdlib>

#include "viewer.h"

namespace metamer::test {
namespace {

using namespace client;

/// How many of the bytes differ by more than one code.
std::size_t different(const View::Picture& a, const View::Picture& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  if (a.rgb.size() != b.rgb.size() || a.rgb.empty()) return ~std::size_t{0};
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) count += std::abs(a.rgb[i] - b.rgb[i]) > 1;
  return count;
}

struct Change {
  const char* name;
  const char* text;  ///< An UpdateView.
};
constexpr Change changes[] = {
    {"camera", "camera { eye { x: 1 y: 1.5 z: 3.5 } target { y: 0.6 } vertical_fov: 40 }"},
    {"far_camera", "camera { eye { x: 90 y: 40 z: 99 } target { y: 0.6 } vertical_fov: 2 }"},
    {"light", "light { name: 'lamp' position { x: -1 y: 3 z: 2 } spectrum { standard: 'F11' } }"},
    {"material",
     "material { name: 'ball' diffuse { constant: 0.3 } cook_torrance {} "
     "slope { beckmann { roughness: 0.3 } } fresnel { conductor { metal: 'Au' } } }"},
    {"anisotropic_material", "material { name: 'floor' diffuse { constant: 0.3 } ward_phong {} }"},
    {"method", "settings { width: 75 height: 53 spp: 4 depth: 0 method { rgb {} } }"},
    {"size", "settings { width: 40 height: 30 spp: 2 depth: 0 }"},
    {"shading", "settings { width: 75 height: 53 spp: 4 depth: 0 shading: CONSTANT }"},
};
/// The scene as it is after the change.
v1::Scene changed(v1::Scene scene, const v1::UpdateView& change) {
  if (change.has_camera()) *scene.mutable_camera() = change.camera();
  if (change.has_settings()) *scene.mutable_settings() = change.settings();
  for (const v1::Light& light : change.light())
    for (v1::Light& old : *scene.mutable_light())
      if (old.name() == light.name()) old = light;
  for (const v1::Material& material : change.material())
    for (v1::Material& old : *scene.mutable_material())
      if (old.name() == material.name()) old = material;
  return scene;
}

class ViewOf : public testing::TestWithParam<v1::Backend> {};

TEST_P(ViewOf, AChangedSceneShowsWhatOneOpenedOnItShows) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const v1::Scene scene = direct_scene();
  for (const Change& change : changes) {
    SCOPED_TRACE(change.name);
    v1::UpdateView update;
    ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(change.text, &update));
    update.set_revision(5);

    const auto view = viewer.open(scene, GetParam());
    ASSERT_TRUE(view) << viewer.error().message;
    const View::Picture before = viewer.complete(*view, 0);
    viewer.update(*view, update);
    const View::Picture after = viewer.complete(*view, 5);
    const auto fresh = viewer.open(changed(scene, update), GetParam());
    ASSERT_TRUE(fresh) << viewer.error().message;
    const View::Picture expected = viewer.complete(*fresh, 0);
    // Seen from elsewhere, f32 may put a sample of an edge to its other side.
    EXPECT_LE(different(after, expected), expected.rgb.size() / 100);
    if (before.width == after.width) {
      EXPECT_GT(different(before, after), before.rgb.size() / 100);
    }
    viewer.close(*view);
    viewer.close(*fresh);
  }
}

/// What a scene becomes another by.
struct Replacement {
  const char* name;
  void (*make)(v1::Scene&);
};
const Replacement replacements[] = {
    {"an object moves",
     [](v1::Scene& scene) {
       scene.mutable_object(1)->mutable_sphere()->mutable_center()->set_x(0.7);
     }},
    {"an object comes before others, with a material of its own",
     [](v1::Scene& scene) {
       const v1::Scene more = parsed(
           "material { name: 'wall' lambert {} diffuse { constant: 0.5 } } object { name: 'wall' "
           "material: 'wall' quad { corner { x: -2 z: -2 } u { x: 4 } v { y: 3 } } }");
       scene.add_material()->CopyFrom(more.material(0));
       scene.mutable_material()->SwapElements(0, 2);
       scene.add_object()->CopyFrom(more.object(0));
       scene.mutable_object()->SwapElements(0, 2);
     }},
    {"an object and its material go",
     [](v1::Scene& scene) {
       scene.mutable_object()->RemoveLast();
       scene.mutable_material()->RemoveLast();
     }},
    {"lights and settings are others",
     [](v1::Scene& scene) {
       scene.mutable_light()->DeleteSubrange(0, 1);
       scene.mutable_light(0)->set_luminance(0.9);
       scene.mutable_settings()->set_width(60);
       scene.mutable_settings()->mutable_method()->mutable_rgb();
     }},
    {"the mesh is another",
     [](v1::Scene& scene) { scene.mutable_object(0)->mutable_mesh()->set_file("b.ply"); }},
};

/// A pyramid of this height.
Upload pyramid(const std::string& name, double height) {
  Upload mesh;
  mesh.name = name;
  mesh.bytes =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n-2 0 1\n2 0 1\n2 0 "
      "-3\n-2 0 -3\n0 " +
      std::to_string(height) + " -1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  mesh.size = mesh.bytes.size();
  mesh.sha256 = sha256(mesh.bytes);
  return mesh;
}

TEST_P(ViewOf, AReplacedSceneShowsWhatOneOpenedOnItShows) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const std::vector<Upload> meshes = {pyramid("a.ply", 0.5), pyramid("b.ply", 1.2)};
  v1::Scene scene = direct_scene();
  scene.mutable_object(0)->mutable_mesh()->set_file("a.ply");
  const auto view = viewer.open(scene, GetParam(), meshes);
  ASSERT_TRUE(view) << viewer.error().message;
  std::uint64_t revision = 0;
  for (const Replacement& one : replacements) {
    SCOPED_TRACE(one.name);
    viewer.replace(*view, scene, ++revision, meshes);
    const View::Picture before = viewer.complete(*view, revision);
    v1::Scene other = scene;
    one.make(other);
    viewer.replace(*view, other, ++revision, meshes);
    const View::Picture after = viewer.complete(*view, revision);
    const auto fresh = viewer.open(other, GetParam(), meshes);
    ASSERT_TRUE(fresh) << viewer.error().message;
    const View::Picture expected = viewer.complete(*fresh, 0);
    EXPECT_LE(different(after, expected), expected.rgb.size() / 100);
    if (before.width == after.width) {
      EXPECT_GT(different(before, after), before.rgb.size() / 100);
    }
    viewer.close(*fresh);
  }

  // A bad one is refused, with its problems, and the view stays as it was.
  v1::Scene bad = scene;
  bad.mutable_object(1)->set_material("none");
  viewer.replace(*view, scene, ++revision, meshes);
  const View::Picture before = viewer.complete(*view, revision);
  viewer.replace(*view, bad, ++revision, meshes);
  EXPECT_FALSE(viewer.next(*view));
  ASSERT_EQ(viewer.error().problems.size(), 1u);
  EXPECT_EQ(viewer.error().problems[0].field(), "object[1].material");
  v1::UpdateView same;
  same.set_revision(++revision);
  *same.mutable_camera() = scene.camera();
  viewer.update(*view, same);
  const View::Picture after = viewer.complete(*view, revision);
  // A GPU draws as many rows at once as the last ones took time: where one band ends, f32 may put a
  // sample of an edge to its other side.
  EXPECT_LE(different(after, before), GetParam() == v1::GL ? before.rgb.size() / 100 : 0);
}

INSTANTIATE_TEST_SUITE_P(Backend, ViewOf, testing::Values(v1::CPU, v1::GL),
                         [](const auto& info) { return v1::Backend_Name(info.param); });

TEST(View, ItsCompletePictureIsWhatRenderWrites) {
  const Daemon daemon;
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  for (const std::string backend : {"cpu", "gl"}) {
    const std::vector<std::string> options = {"--backend", backend,    "--depth",
                                              "0",         "--method", "exact"};
    std::vector<std::string> render = {"render", scene, "-o", folder / "render.png"};
    std::vector<std::string> view = {"view", scene, "--record", "3", "-o", folder / "view.png"};
    render.insert(render.end(), options.begin(), options.end());
    view.insert(view.end(), options.begin(), options.end());
    ASSERT_EQ(daemon.metamer(render).code, 0);
    const Json document = daemon.json(view);
    EXPECT_EQ(document["frames"].size(), 3u);
    EXPECT_EQ(document["plan"]["backend"], backend);
    const Result<Image> a = read_image(folder / "render.png"), b = read_image(folder / "view.png");
    ASSERT_TRUE(a && b);
    ASSERT_EQ(a->pixels.size(), b->pixels.size());
    // The same samples in another order of summation.
    for (std::size_t i = 0; i < a->pixels.size(); ++i)
      ASSERT_NEAR(a->pixels[i], b->pixels[i], 1.01 / 255) << backend << ' ' << i;
  }
}

TEST(View, TellsWhatIsWrongWithAScene) {
  const Daemon daemon;
  Viewer viewer(daemon);
  v1::Scene scene = direct_scene();
  scene.mutable_object(1)->set_material("none");
  EXPECT_FALSE(viewer.open(scene));
  ASSERT_EQ(viewer.error().problems.size(), 1u);
  EXPECT_EQ(viewer.error().problems[0].field(), "object[1].material");
  scene = direct_scene();
  scene.mutable_settings()->set_width(4096);
  scene.mutable_settings()->set_height(4096);
  EXPECT_FALSE(viewer.open(scene));
  ASSERT_EQ(viewer.error().problems.size(), 1u);
  EXPECT_EQ(viewer.error().problems[0].message(), "a view has at most 4194304 pixels");
}

TEST(View, ARefusedChangeLeavesItAsItWas) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(direct_scene());
  ASSERT_TRUE(view);
  const View::Picture before = viewer.complete(*view, 0);
  for (const char* text :
       {"light { name: 'none' }", "material { name: 'ball' diffuse { standard: 'no such' } }",
        "camera { eye {} target {} }", "settings { width: 99999 }",
        "settings { width: 4096 height: 4096 }",
        "light { name: 'lamp' position {} spectrum { file: 'nowhere.txt' } }"}) {
    v1::UpdateView change;
    ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &change)) << text;
    change.set_revision(1);
    viewer.update(*view, change);
    EXPECT_FALSE(viewer.next(*view)) << text;
    EXPECT_EQ(viewer.error().message, "the change was refused");
    EXPECT_FALSE(viewer.error().problems.empty()) << text;
  }
  v1::UpdateView same;
  *same.mutable_camera() = direct_scene().camera();
  same.set_revision(2);
  viewer.update(*view, same);
  EXPECT_EQ(viewer.complete(*view, 2).rgb, before.rgb);
}

TEST(View, ALightMayBecomeThatOfAFile) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto by_file = viewer.open(direct_scene()), by_samples = viewer.open(direct_scene());
  ASSERT_TRUE(by_file && by_samples);
  v1::UpdateView change;
  const std::string lamp = "light { name: 'lamp' position { x: 1 y: 3 z: 2 } ";
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(
      lamp + "spectrum { samples { wavelength: [400, 700] value: [1, 4] } } }", &change));
  viewer.update(*by_samples, change);
  const View::Picture expected = viewer.complete(*by_samples, 0);

  Upload file;
  file.name = "lamp.txt";
  file.bytes = "400 1\n700 4\n";
  file.size = file.bytes.size();
  file.sha256 = sha256(file.bytes);
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(
      lamp + "spectrum { file: 'lamp.txt' } }", &change));
  change.set_revision(1);
  viewer.update(*by_file, change, {file});
  EXPECT_EQ(viewer.complete(*by_file, 1).rgb, expected.rgb);
}

TEST(View, WordsThatMakeNoSenseAreRefused) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--rate", "nan"},
                                                {"--rate", "0"},
                                                {"--swing", "nan"},
                                                {"--swing", "-1"},
                                                {"-o", folder / "a.exr"},
                                                {"-o", folder / "none/a.png"},
                                                {"-o", ""},
                                                {"--record", "0"}}) {
    std::vector<std::string> all = {"view", scene};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(metamer(all).code, 2) << words[0] << ' ' << words[1];
  }
}

}  // namespace
}  // namespace metamer::test
