// Views as a client has them: frames, changes, and others who want the same worker.
#include "client/session/view.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <boost/asio.hpp>
#include <functional>

#include "daemon.h"
#include "running_job.h"
#include "scenes.h"

namespace metamer::test {
namespace {

using namespace client;

namespace asio = boost::asio;

v1::Scene parsed(const std::string& text) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &scene));
  return scene;
}

/// A client that opens views and waits for everything.
class Viewer {
 public:
  explicit Viewer(const Daemon& daemon) {
    run([&]() -> asio::awaitable<void> {
      auto connected = co_await Session::connect(daemon.address());
      EXPECT_TRUE(connected);
      session_ = std::move(*connected);
    });
  }
  ~Viewer() {
    session_.reset();
    loop_.run();
  }

  /// Null and the error where it can't be.
  std::unique_ptr<View> open(const v1::Scene& scene, v1::Backend backend = v1::CPU) {
    std::unique_ptr<View> view;
    run([&] { return open_into(scene, {}, backend, view); });
    return view;
  }
  /// With a mesh, while this client goes on; how it came out is in error().
  void begin_open(const v1::Scene& scene, const Upload& mesh, v1::Backend backend,
                  std::unique_ptr<View>& view, bool& ended) {
    loop_.restart();
    asio::co_spawn(loop_, open_into(scene, {mesh}, backend, view),
                   [&](std::exception_ptr) { ended = true; });
  }
  void update(View& view, v1::UpdateView change, const std::vector<Upload>& files = {}) {
    run([&]() -> asio::awaitable<void> {
      EXPECT_TRUE(co_await view.update(std::move(change), files));
    });
  }
  void ask(View& view) {
    run([&]() -> asio::awaitable<void> { co_await view.ask(); });
  }
  void close(View& view) {
    run([&]() -> asio::awaitable<void> { EXPECT_TRUE(co_await view.close()); });
  }
  /// A frame that was asked for; nothing and the error where there is none.
  std::optional<View::Picture> next(View& view) {
    std::optional<View::Picture> picture;
    run([&]() -> asio::awaitable<void> {
      auto next = co_await view.next();
      error_ = next ? SessionError{} : next.error();
      if (next) picture = std::move(*next);
    });
    return picture;
  }
  /// The frame that has all samples of a revision.
  View::Picture complete(View& view, std::uint64_t revision) {
    for (int i = 0; i < 100; ++i) {
      ask(view);
      auto picture = next(view);
      if (!picture) break;
      if (picture->frame.complete() && picture->frame.revision() == revision) return *picture;
    }
    ADD_FAILURE() << "never complete: " << error_.message;
    return {};
  }
  const SessionError& error() const { return error_; }

 private:
  asio::awaitable<void> open_into(v1::Scene scene, std::vector<Upload> files, v1::Backend backend,
                                  std::unique_ptr<View>& view) {
    Submission submission = make_submission(scene, {}, "view", false);
    submission.request.set_backend(backend);
    for (Upload& file : files) {
      v1::AssetName& asset = *submission.request.add_asset();
      asset.set_name(file.name);
      asset.set_sha256(std::string(to_bytes(file.sha256)));
      submission.uploads.push_back(std::move(file));
    }
    auto opened = co_await View::open(*session_, submission);
    error_ = opened ? SessionError{} : opened.error();
    if (opened) view = std::move(*opened);
  }

  void run(const std::function<asio::awaitable<void>()>& work) {
    loop_.restart();
    bool done = false;
    asio::co_spawn(loop_, work(), [&](std::exception_ptr) { done = true; });
    while (!done && loop_.run_one() > 0) {
    }
  }

  asio::io_context loop_{1};
  std::unique_ptr<Session> session_;
  SessionError error_;
};

v1::Scene direct_scene() {
  v1::Scene scene = parsed(small_scene());
  scene.mutable_settings()->set_depth(0);
  return scene;
}

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

TEST(View, AJobAndViewsOfBothBackendsShareTheirWorkers) {
  const Daemon daemon;
  for (const v1::Backend backend : {v1::CPU, v1::GL}) {
    v1::Scene endless = parsed(endless_scene());
    endless.mutable_settings()->set_backend(backend);
    endless.mutable_settings()->set_spp(16);
    std::string text;
    google::protobuf::TextFormat::PrintToString(endless, &text);
    RunningJob job(daemon, text);
    Viewer viewer(daemon);
    const auto one = viewer.open(direct_scene(), backend);
    const auto other = viewer.open(direct_scene(), backend);
    ASSERT_TRUE(one && other) << viewer.error().message;
    viewer.complete(*one, 0);
    viewer.complete(*other, 0);
    EXPECT_FALSE(job.event("tile").is_null()) << "the job goes on";
    EXPECT_EQ(daemon.metamer({"cancel", job.id()}).code, 0);
  }
}

TEST(View, ASlowClientHoldsUpNobody) {
  const Daemon daemon;
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const auto slow = daemon.start({"view", scene, "--record", "1000", "--rate", "1"});
  ASSERT_TRUE(slow->line_out("scene.txtpb"));
  const Json fast = daemon.json({"view", scene, "--record", "300"});
  EXPECT_EQ(fast["frames"].size(), 300u);
  // Had they had turns with each other, this would have come after the slow one's 300th second.
  slow->signal(SIGINT);
  const Ended ended = slow->wait();
  EXPECT_EQ(ended.code, 5);
  EXPECT_NE(ended.out.find(" frames ("), std::string::npos) << "what was recorded is told";
}

TEST(View, AHeavyOneLeavesTheOthersTheirTurns) {
  const Daemon daemon;
  Viewer viewer(daemon);
  v1::Scene heavy = direct_scene();
  // Minutes for its first frame, and it is closed in the middle of it.
  heavy.mutable_settings()->set_width(2048);
  heavy.mutable_settings()->set_height(2048);
  const v1::Light lamp = heavy.light(0);
  for (int i = 0; i < 200; ++i) {
    *heavy.add_light() = lamp;
    heavy.mutable_light()->rbegin()->set_name("lamp " + std::to_string(i));
  }
  heavy.mutable_settings()->mutable_method()->mutable_point()->set_from(380);
  heavy.mutable_settings()->mutable_method()->mutable_point()->set_to(780);
  heavy.mutable_settings()->mutable_method()->mutable_point()->set_step(0.1);
  const auto big = viewer.open(heavy);
  ASSERT_TRUE(big) << viewer.error().message;
  viewer.ask(*big);
  const auto small = viewer.open(direct_scene());
  ASSERT_TRUE(small);
  viewer.complete(*small, 0);
  viewer.close(*big);
}

/// A floor of so many squares a side.
Upload floor_mesh(int side) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string((side + 1) * (side + 1)) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(side * side) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (int z = 0; z <= side; ++z)
    for (int x = 0; x <= side; ++x) text += std::to_string(x) + " 0 " + std::to_string(-z) + "\n";
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x) {
      const int at = z * (side + 1) + x;
      text += "4 " + std::to_string(at) + " " + std::to_string(at + 1) + " " +
              std::to_string(at + side + 2) + " " + std::to_string(at + side + 1) + "\n";
    }
  Upload mesh;
  mesh.name = "floor.ply";
  mesh.size = text.size();
  mesh.sha256 = sha256(text);
  mesh.bytes = std::move(text);
  return mesh;
}

TEST(View, OthersGetFramesWhileASceneIsImported) {
  const Daemon daemon;
  const Upload mesh = floor_mesh(400);
  v1::Scene heavy = direct_scene();
  heavy.mutable_object(0)->mutable_mesh()->set_file(mesh.name);
  for (const v1::Backend backend : {v1::CPU, v1::GL}) {
    Viewer viewer(daemon);
    const auto light = viewer.open(direct_scene(), backend);
    ASSERT_TRUE(light) << viewer.error().message;
    // The second time nothing is uploaded, and all that is waited for is the import.
    for (const bool uploaded : {false, true}) {
      std::unique_ptr<View> view;
      bool ended = false;
      viewer.begin_open(heavy, mesh, backend, view, ended);
      int frames = 0;
      for (std::uint64_t revision = 1; !ended; ++revision) {
        v1::UpdateView change;
        change.set_revision(revision);
        *change.mutable_camera() = heavy.camera();
        viewer.update(*light, change);
        viewer.ask(*light);
        ASSERT_TRUE(viewer.next(*light)) << viewer.error().message;
        ++frames;
      }
      ASSERT_TRUE(view) << viewer.error().message;
      EXPECT_GT(frames, uploaded ? 10 : 0);
      viewer.close(*view);
    }
  }
}

TEST(View, OneWhoseClientGoesWhileItIsImportedLeavesTheOthersAlone) {
  const Daemon daemon;
  const Folder folder;
  v1::Scene heavy = direct_scene();
  folder.write("floor.ply", floor_mesh(400).bytes);
  heavy.mutable_object(0)->mutable_mesh()->set_file("floor.ply");
  std::string text;
  google::protobuf::TextFormat::PrintToString(heavy, &text);
  const std::string scene = folder.write("heavy.txtpb", text);
  Viewer viewer(daemon);
  for (int i = 0; i < 3; ++i) {
    const auto client = daemon.start({"view", scene});
    const auto light = viewer.open(direct_scene());
    ASSERT_TRUE(light) << viewer.error().message;
    viewer.complete(*light, 0);
    client->signal(SIGKILL);
    viewer.close(*light);
  }
  EXPECT_EQ(daemon.json({"info"})["info"]["worker"][0]["starts"], 1) << "the worker lives";
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

TEST(View, EndsWithItsWorkerAndCanBeOpenedAgain) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(direct_scene());
  ASSERT_TRUE(view);
  viewer.complete(*view, 0);
  ::kill(daemon.worker_pid(), SIGKILL);
  EXPECT_FALSE(viewer.next(*view));
  EXPECT_EQ(viewer.error().message, "the worker was lost: killed by signal 9 (Killed)");
  const auto again = viewer.open(direct_scene());
  ASSERT_TRUE(again) << viewer.error().message;
  viewer.complete(*again, 0);
}

TEST(View, AClientHasAtMostFour) {
  const Daemon daemon;
  Viewer viewer(daemon);
  std::vector<std::unique_ptr<View>> views;
  for (int i = 0; i < 4; ++i) {
    views.push_back(viewer.open(direct_scene()));
    ASSERT_TRUE(views.back()) << viewer.error().message;
  }
  EXPECT_FALSE(viewer.open(direct_scene()));
  EXPECT_EQ(viewer.error().message, "a client may have 4 views open at a time");
  viewer.close(*views[1]);
  EXPECT_TRUE(viewer.open(direct_scene()));
}

TEST(View, AThirdFrameBeforeTheFirstIsRefused) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(direct_scene());
  ASSERT_TRUE(view);
  viewer.complete(*view, 0);
  for (int i = 0; i < 3; ++i) viewer.ask(*view);
  EXPECT_FALSE(viewer.next(*view));
  EXPECT_EQ(viewer.error().message, "a view has at most 2 frames coming");
}

}  // namespace
}  // namespace metamer::test
