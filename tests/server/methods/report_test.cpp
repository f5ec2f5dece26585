// The table of the methods' errors: a test artefact, and the one place where all are side by side.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "tests/server/methods/color_error.h"
#include "tests/server/methods/methods.h"

namespace metamer::test {
namespace {

struct Row {
  std::string name;
  v1::Method method;
};

std::vector<Row> rows() {
  std::vector<Row> all;
  for (const auto& [count, step] : {std::pair{7, 50.0}, {16, 20.0}, {31, 10.0}, {61, 5.0}})
    all.push_back({"point, " + std::to_string(count) + " uniform", uniform(400, 700, step)});
  for (const std::uint32_t count : {4u, 6u, 8u, 12u, 16u})
    all.push_back({"point, " + std::to_string(count) + " fitted", fitted(count)});
  for (const auto weighting : {v1::Linear::NONE, v1::Linear::OBSERVER})
    for (const bool bounce : {false, true})
      for (std::uint32_t bases = 3; bases <= 8; ++bases)
        all.push_back({"linear, " + std::to_string(bases) +
                           (weighting == v1::Linear::OBSERVER ? ", observer" : "") +
                           (bounce ? ", bounce" : ""),
                       linear(bases, weighting, bounce)});
  all.push_back({"prefilter", prefilter()});
  all.push_back({"rgb", rgb()});
  all.push_back({"exact", exact()});
  return all;
}

std::string cell(const ColorErrors& errors) {
  char text[40];
  std::snprintf(text, sizeof text, " %.2f / %.2f |", errors.mean, errors.worst);
  return text;
}

std::string report() {
  const std::vector<std::string> illuminants{"A", "D65", "F2", "F11"};
  std::string text =
      "# Errors of the methods\n\nΔE00, mean / worst, over the 15 test colours of the colour "
      "rendering index (direct) and over the 120\nthat they have in mirrors of each other's "
      "colours "
      "(bounce), against f64 sums by 0.05 nm from 360 to 830.\nWritten by a test "
      "(`tests/server/methods/report_test.cpp`).\n\n| method |";
  std::string rule = "|---|";
  for (const char* kind : {"direct", "bounce"})
    for (const std::string& illuminant : illuminants) {
      text += " " + illuminant + " " + kind + " |";
      rule += "---|";
    }
  text += "\n" + rule + "\n";
  for (const Row& row : rows()) {
    std::string direct, bounce;
    for (const std::string& illuminant : illuminants) {
      const MethodErrors errors = errors_of(illuminant, row.method);
      direct += cell(errors.direct);
      bounce += cell(errors.bounce);
    }
    text += "| " + row.name + " |" + direct + bounce + "\n";
  }
  return text;
}

TEST(MethodsReport, IsWrittenBesideTheProgramsOrWhereMetamerReportSays) {
  const char* wanted = std::getenv("METAMER_REPORT");
  const std::string path = wanted ? wanted : METAMER_BIN "/../methods.md";
  std::ofstream file(path);
  file << report();
  file.close();
  EXPECT_TRUE(file) << path;
}

}  // namespace
}  // namespace metamer::test
