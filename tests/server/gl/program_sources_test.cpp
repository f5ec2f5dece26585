// Mesa is one driver among many: what it takes, another may refuse. Khronos's reference compiler
// reads the language as it is written down.

#include "server/gl/program_sources.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>

#include "tests/server/gl/pictures.h"

namespace metamer::gl {
namespace {

/// What glslangValidator says of a source; empty: nothing is wrong. `stage` as it names them.
std::string complaints(const std::string& stage, const std::string& source) {
  const std::string file = testing::TempDir() + "source." + stage;
  std::FILE* const out = std::fopen(file.c_str(), "w");
  std::fputs(source.c_str(), out);
  std::fclose(out);
  std::FILE* const pipe =
      ::popen(("glslangValidator -S " + stage + " " + file + " 2>&1").c_str(), "r");
  std::string said;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) said += static_cast<char>(c);
  const int status = ::pclose(pipe);
  std::remove(file.c_str());
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? "" : "it fails: " + said;
}

TEST(ProgramSources, OfEveryModelAreAsTheLanguageIsWrittenDown) {
  const RenderScene gallery = compile(read_deployed("gallery/gallery.txtpb"));
  const ProgramSources sources = program_sources(gallery, {.places = true, .passes = true});
  for (const std::string* compute :
       {&sources.shade, &sources.finish, &sources.places, &sources.combine})
    EXPECT_EQ(complaints("comp", *compute), "");
  for (const RasterSource* raster :
       {&sources.triangles, &sources.spheres, &sources.pass_triangles, &sources.pass_spheres}) {
    EXPECT_EQ(complaints("vert", raster->vertex), "");
    EXPECT_EQ(complaints("frag", raster->fragment), "");
  }
}

TEST(ProgramSources, AreRefusedWhereTheyAreWrong) {
  EXPECT_NE(complaints("comp", "#version 450\nvoid main() { undeclared = 1; }\n"), "");
}

TEST(ProgramSources, HoldWhatIsWantedAlone) {
  const ProgramSources sources =
      program_sources(compile(read_deployed("gallery/gallery.txtpb")), {});
  EXPECT_EQ(sources.places, "");
  EXPECT_EQ(sources.combine, "");
  EXPECT_EQ(sources.pass_triangles.fragment, "");
  EXPECT_NE(sources.shade, "");
}

}  // namespace
}  // namespace metamer::gl
