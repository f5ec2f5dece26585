// The numbers that README.md and --help promise.
#include <gtest/gtest.h>

#include <filesystem>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

const char* const no_server_named =
    "error: no server named: use --server unix:PATH, HOST:PORT or tls:HOST:PORT, or set "
    "METAMER_SERVER\n";

TEST(ExitCode, ZeroWhenDone) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Ended ended = metamer({"render", scene, "-o", folder / "a.png", "-o", folder / "a.exr"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, (folder / "a.png") + "\n" + (folder / "a.exr") + "\n");
  EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a.exr"));
}

TEST(ExitCode, TwoForBadUsage) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{},
        {"rendre"},
        {"render"},
        {"render", "a.txtpb"},
        {"jobs", "--no-such-option"},
        {"watch", "seven"},
        {"fetch", "1"},
        {"render", "a.txtpb", "-o", "a.png", "--spp", "many"}}) {
    const Ended ended = metamer(words);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_NE(ended.err, "");
  }
}

TEST(ExitCode, TwoWhereACommandNeedsAServerAndNoneIsNamed) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  for (const std::vector<std::string>& words : {std::vector<std::string>{"submit", scene},
                                                {"jobs"},
                                                {"watch", "1"},
                                                {"fetch", "1", "-o", "a.png"},
                                                {"cancel", "1"},
                                                {"pause", "1"},
                                                {"resume", "1"},
                                                {"priority", "1", "5"},
                                                {"info"}}) {
    const Ended ended = metamer(words);
    EXPECT_EQ(ended.code, 2) << words[0];
    EXPECT_EQ(ended.out, "") << words[0];
    EXPECT_EQ(ended.err, no_server_named) << words[0];
  }
}

TEST(ExitCode, TwoForOutputThatCannotBe) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Ended ended = metamer({"render", scene, "-o", "a.jpg", "-o", "no/such/a.png", "-o", "b.exr",
                               "-o", "./b.exr", "--exr", "lab"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(
      ended.err,
      "error: --output: \"a.jpg\" ends neither in .png nor in .exr\n"
      "error: --output: there is no folder \"no/such\"\n"
      "error: --output: \"./b.exr\" is named twice\n"
      "error: --exr: \"lab\" is neither rgb nor xyz nor spectral, nor spectral:FROM:TO:STEP\n");
}

TEST(ExitCode, TwoForAJobThatIsNotThere) {
  const Daemon daemon;
  for (const std::vector<std::string>& words : {std::vector<std::string>{"watch", "7"},
                                                {"fetch", "7", "-o", "a.png"},
                                                {"cancel", "7"},
                                                {"pause", "7"},
                                                {"resume", "7"},
                                                {"priority", "7", "-5"}}) {
    const Ended ended = daemon.metamer(words);
    EXPECT_EQ(ended.code, 2) << words[0];
    EXPECT_EQ(ended.err, "error: there is no job 7\n") << words[0];
  }
}

TEST(ExitCode, ThreeWhereNobodyListens) {
  const Folder folder;
  const std::string socket = "unix:" + (folder / "nobody");
  const Ended ended = metamer({"info", "--server", socket});
  EXPECT_EQ(ended.code, 3);
  EXPECT_EQ(ended.err, "error: can't connect to " + socket + ": No such file or directory\n");

  ProcessOptions options;
  options.environment["METAMER_SERVER"] = socket;
  EXPECT_EQ(metamer({"jobs"}, options).code, 3);
}

TEST(ExitCode, TwoForAnAddressThatIsNone) {
  const Ended ended = metamer({"info", "--server", "somewhere"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err,
            "error: \"somewhere\" is no endpoint: expected unix:PATH, HOST:PORT, PORT or "
            "tls:HOST:PORT\n");
}

TEST(ExitCode, ThreeWhenThePrivateServerDoesNotStart) {
  // A copy of the client alone has no metamerd beside it, and none in PATH.
  const Folder folder;
  std::filesystem::copy(METAMER_BIN "/metamer", folder / "metamer");
  const std::string scene = folder.write("scene.txtpb", small_scene());
  ProcessOptions options;
  options.environment["PATH"] = folder.path();
  const Ended ended = run({folder / "metamer", "render", scene, "-o", folder / "a.png"}, options);
  EXPECT_EQ(ended.code, 3);
  EXPECT_EQ(ended.err, "error: cannot start metamerd: No such file or directory\n");
}

TEST(ExitCode, TwoBeforeRenderingWhenAFolderIsInThePicturesWay) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  std::filesystem::create_directory(folder / "a.png");
  const Ended ended = metamer({"render", scene, "-o", folder / "a.png"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(ended.err, "error: --output: \"" + (folder / "a.png") + "\" is a folder\n");
}

// 4 and 5 are with the tests of lost workers and of cancelling.

}  // namespace
}  // namespace metamer::test
