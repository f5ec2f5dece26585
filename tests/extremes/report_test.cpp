#include "tests/extremes/report.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace metamer::extremes {
namespace {

TEST(ExtremesReport, IsWrittenBesideTheProgramsOrWhereMetamerReportSays) {
  const char* wanted = std::getenv("METAMER_REPORT");
  const std::string path = wanted ? wanted : METAMER_BIN "/../extremes.md";
  std::ofstream file(path);
  file << report();
  file.close();
  EXPECT_TRUE(file) << path;
}

}  // namespace
}  // namespace metamer::extremes
