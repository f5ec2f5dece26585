// The GL backend as a user meets it.
#include <gtest/gtest.h>
#include <signal.h>

#include "running_job.h"
#include "scenes.h"

namespace metamer::test {
namespace {

TEST(Gl, RendersWhatTheCpuRenders) {
  const Daemon daemon;
  Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  for (const std::string method : {"point", "exact"}) {
    const std::string cpu = folder / ("cpu-" + method + ".exr");
    const std::string gl = folder / ("gl-" + method + ".exr");
    const Ended first = daemon.metamer(
        {"render", scene, "--method", method, "--depth", "0", "-o", cpu, "--exr", "xyz"});
    ASSERT_EQ(first.code, 0) << first.err;
    const Json document = daemon.json(
        {"render", scene, "--method", method, "--backend", "gl", "-o", gl, "--exr", "xyz"});
    EXPECT_EQ(document["plan"]["backend"], "gl");
    EXPECT_EQ(document["timing"]["pass"].size(), 4u);
    // The worker keeps the scene's geometry, and its programs, which know no method.
    const Json& record = document["record"];
    EXPECT_EQ(record["warm"].size(), method == "point" ? 0u : 2u) << record;
    EXPECT_FALSE(record["machine"][0]["gpu"].get<std::string>().empty());
    // Edges may fall to either side; what lies between them is the same.
    const Json compared = parse_document(metamer({"compare", cpu, gl, "--json"}).out)["difference"];
    EXPECT_LT(compared["median"].get<double>(), 0.02) << compared.dump(2);
    EXPECT_LT(compared["percentile_95"].get<double>(), 0.5) << compared.dump(2);
  }
}

TEST(Gl, VerifiesItsPicturesByItself) {
  const Daemon daemon;
  Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const auto verified = [&](const std::string& method) {
    return daemon.json({"render", scene, "--backend", "gl", "--verify", "--method", method, "-o",
                        folder / "a.png"});
  };
  const Json exact = verified("exact");
  ASSERT_EQ(exact["exit_code"], 0) << exact;
  EXPECT_EQ(exact["accuracy"]["error"]["share"], 1);
  EXPECT_LT(exact["accuracy"]["error"]["maximum"].get<double>(), 0.02);
  EXPECT_GT(verified("rgb")["accuracy"]["error"]["maximum"].get<double>(), 0.5);
}

TEST(Gl, SaysThatMirrorsAreLeftOut) {
  const Daemon daemon;
  Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Ended ended = daemon.metamer({"render", scene, "--backend", "gl", "-o", folder / "a.exr"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.err.find("the gl backend has no mirrors"), std::string::npos) << ended.err;
}

TEST(Gl, KeepsNoFactors) {
  const Daemon daemon;
  Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Ended ended = daemon.metamer(
      {"render", scene, "--backend", "gl", "--keep-factors", "-o", folder / "a.exr"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("need what the cpu backend keeps"), std::string::npos) << ended.err;
}

TEST(Gl, MethodsAreChosenByWhatItsOwnPicturesCost) {
  const Daemon daemon;
  Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Json explained = daemon.json({"explain", scene, "--backend", "gl"});
  ASSERT_EQ(explained["exit_code"], 0) << explained;
  ASSERT_GT(explained["plan"]["prediction"].size(), 8u);
  for (const Json& one : explained["plan"]["prediction"]) EXPECT_GT(one["render"].get<double>(), 0);
  for (const Json& notice : explained["plan"]["notice"])
    EXPECT_NE(notice["field"], "settings.backend");  // nothing to excuse

  const Json chosen = daemon.json(
      {"render", scene, "--backend", "gl", "--tolerance", "0.5", "-o", folder / "a.png"});
  ASSERT_EQ(chosen["exit_code"], 0) << chosen;
  EXPECT_TRUE(chosen["accuracy"]["kept"].get<bool>());
  EXPECT_GT(chosen["plan"]["prediction"].size(), 0u);
}

TEST(Gl, InfoTellsWhatEachBackendHas) {
  const Daemon daemon;
  const Json sets = daemon.json({"info"})["info"]["capabilities"]["backend_features"];
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(sets[0]["name"], "cpu");
  EXPECT_EQ(sets[0]["feature"],
            Json({"mirrors", "exact_fresnel", "anisotropy", "corner_shading", "factors", "textures",
                  "area_lights", "environment", "planes", "fluorescence", "transmission", "lens",
                  "inter_reflection", "normal_maps", "alpha"}));
  EXPECT_EQ(sets[1]["name"], "gl");
  EXPECT_EQ(sets[1]["feature"],
            Json({"exact_fresnel", "anisotropy", "corner_shading", "fluorescence", "multi_pass"}));
}

TEST(Gl, InfoNamesTheDeviceAndWhatWasFoundOfIt) {
  const Daemon daemon;
  const Json info = daemon.json({"info"})["info"];
  EXPECT_EQ(info["capabilities"]["backend"], Json({"cpu", "gl"}));
  const Json gl = info["capabilities"]["gl"];
  EXPECT_FALSE(gl["renderer"].get<std::string>().empty());
  EXPECT_EQ(info["worker"].size(), 3u);
  EXPECT_EQ(info["worker"][1]["backend"], "gl");
  const Ended ended = daemon.metamer({"info"});
  EXPECT_NE(ended.out.find(gl["renderer"].get<std::string>()), std::string::npos) << ended.out;
}

TEST(Gl, AMissingDeviceFailsItsJobsAndNoOthers) {
  const Daemon daemon(Daemon::Listens::unix_socket, {"--gl-device", "15"});
  Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  for (int turn = 0; turn < 2; ++turn) {
    const Ended failed =
        daemon.metamer({"render", scene, "--backend", "gl", "-o", folder / "a.exr"});
    EXPECT_EQ(failed.code, 4) << failed.err;
    EXPECT_NE(failed.err.find("there is no GL device 15"), std::string::npos) << failed.err;
  }
  EXPECT_EQ(daemon.metamer({"render", scene, "-o", folder / "b.exr"}).code, 0);
  EXPECT_EQ(daemon.json({"info"})["info"]["capabilities"]["backend"], Json({"cpu"}));
}

TEST(Gl, AContextThatGoesUnderAJobFailsItAndTheNextHasAnother) {
  setenv("METAMER_TEST_LOSE_CONTEXT", "20", 1);
  const Daemon daemon;
  unsetenv("METAMER_TEST_LOSE_CONTEXT");
  Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const std::string picture = folder / "a.exr";
  const Ended failed =
      daemon.metamer({"render", scene, "--backend", "gl", "--spp", "64", "-o", picture});
  EXPECT_EQ(failed.code, 4);
  EXPECT_NE(failed.err.find("the GL context is gone"), std::string::npos) << failed.err;
  const Ended next = daemon.metamer({"render", scene, "--backend", "gl", "-o", picture});
  EXPECT_EQ(next.code, 0) << next.err;
  EXPECT_EQ(daemon.json({"info"})["info"]["worker"][1]["starts"], 2);
}

TEST(Gl, BothBackendsRenderAtTheSameTime) {
  const Daemon daemon;
  Folder folder;
  const std::string endless = folder.write("endless.txtpb", endless_scene());
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const std::string job = daemon.submit(endless);
  EXPECT_EQ(daemon.metamer({"render", scene, "--backend", "gl", "-o", folder / "a.exr"}).code, 0);
  EXPECT_EQ(daemon.job_state(job), "running");
}

TEST(Gl, AKilledWorkerIsReplacedAndItsJobDoneAgain) {
  const Daemon daemon(Daemon::Listens::unix_socket, {"--worker-timeout", "60"});
  Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const auto worker = [&] { return daemon.json({"info"})["info"]["worker"][1]; };
  while (worker()["state"] != "idle") {
  }
  HeldWorkers held(daemon);  // or it may have ended before it is seen
  const std::string job = daemon.submit(scene, {"--backend", "gl"});
  while (worker()["state"] != "busy") {
  }
  kill(worker()["pid"].get<pid_t>(), SIGKILL);
  const Ended fetched = daemon.metamer({"fetch", job, "-o", folder / "a.exr"});
  EXPECT_EQ(fetched.code, 0) << fetched.err;
  EXPECT_GE(worker()["starts"].get<int>(), 2);
}

}  // namespace
}  // namespace metamer::test
