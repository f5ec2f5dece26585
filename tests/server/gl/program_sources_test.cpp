// Mesa is one driver among many: what it takes, another may refuse. Khronos's reference compiler
// reads the language as it is written down.

#include "server/gl/program_sources.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>

#include "tests/server/gl/pictures.h"

namespace metamer::gl {
namespace {

/// Whether glslangValidator takes a source, which it reads from its standard input (no file that a
/// test beside this one could write, too); it prints what is wrong. `stage` as it names them.
bool is_accepted(const std::string& stage, const std::string& source) {
  std::FILE* const pipe = ::popen(("glslangValidator --stdin -S " + stage).c_str(), "w");
  std::fputs(source.c_str(), pipe);
  const int status = ::pclose(pipe);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(ProgramSources, OfEveryModelAreAsTheLanguageIsWrittenDown) {
  const RenderScene gallery = compile(read_deployed("gallery/gallery.txtpb"));
  const ProgramSources sources = program_sources(gallery, {.places = true, .passes = true});
  for (const std::string* compute :
       {&sources.shade, &sources.finish, &sources.places, &sources.combine})
    EXPECT_TRUE(is_accepted("comp", *compute));
  for (const RasterSource* raster :
       {&sources.triangles, &sources.spheres, &sources.pass_triangles, &sources.pass_spheres}) {
    EXPECT_TRUE(is_accepted("vert", raster->vertex));
    EXPECT_TRUE(is_accepted("frag", raster->fragment));
  }
}

TEST(ProgramSources, AreRefusedWhereTheyAreWrong) {
  EXPECT_FALSE(is_accepted("comp", "#version 450\nvoid main() { undeclared = 1; }\n"));
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
