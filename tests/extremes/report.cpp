#include "tests/extremes/report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>

#include "tests/extremes/builds.h"
#include "tests/extremes/gl_build.h"
#include "tests/laws/reflectance.h"

namespace metamer::extremes {
namespace {

/// What the rows of one line of a table add up to.
struct Line {
  int rows = 0;
  std::map<Build, double> worst;
  std::map<Build, int> missed;
};

/// By form, then by extreme; "" stands for all rows of the form.
using Lines = std::map<std::string, Line>;
struct Tables {
  std::vector<std::pair<std::string, Lines>> forms;
  std::string renderer = "none";
};

Lines& lines_of(Tables& tables, const std::string& form) {
  if (tables.forms.empty() || tables.forms.back().first != form) tables.forms.push_back({form, {}});
  return tables.forms.back().second;
}

void add(Lines& lines, const Row& row, const std::map<Build, Error>& errors) {
  std::set<std::string> places(row.extremes.begin(), row.extremes.end());
  places.insert("");
  for (const std::string& place : places) {
    Line& line = lines[place];
    ++line.rows;
    for (const auto& [build, error] : errors) {
      line.worst[build] = std::max(line.worst[build], error.size);
      line.missed[build] += !error.within;
    }
  }
}

Tables collect() {
  Tables tables;
  auto gl = gl::device_count() > 0 ? GlBuild::create() : problem("no EGL device");
  if (gl) tables.renderer = gl->renderer();
  for (const char* file : files) {
    const auto& rows = table(file);
    std::map<Build, Values> values{{Build::f64, evaluate_f64(rows)},
                                   {Build::f32, evaluate_f32(rows)}};
    if (gl) {
      if (auto of_gl = gl->evaluate(rows)) values[Build::glsl] = std::move(*of_gl);
    }
    const std::string names = std::string(file) == "fresnel" ? "" : std::string(file) + ": ";
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::map<Build, Error> errors;
      for (const auto& [build, all] : values) {
        if (!all[i].empty()) errors[build] = compare(rows[i], all[i], bound(build, rows[i]));
      }
      add(lines_of(tables, names + rows[i].form), rows[i], errors);
    }
  }
  return tables;
}

std::string row_text(const std::string& head, const Line& line) {
  std::string text = head + " " + std::to_string(line.rows) + " |";
  for (const Build build : {Build::f64, Build::f32, Build::glsl}) {
    std::array<char, 60> cell{" – |"};
    if (const auto found = line.worst.find(build); found != line.worst.end()) {
      const int missed = line.missed.at(build);
      std::snprintf(cell.data(), cell.size(), missed ? " **%.1e** (%d beyond) |" : " %.1e |",
                    found->second, missed);
    }
    text += cell.data();
  }
  return text + "\n";
}

}  // namespace

std::string report() {
  const Tables tables = collect();
  std::string text =
      "# The models at the extremes\n\n"
      "The largest errors against tests/extremes/*.csv, the definitions in 50 digits. f64: "
      "relative. f32:\n"
      "relative or of the lobe's peak, the smaller. GLSL: of the peak. Bounds: 1e-12; 2e-6 or "
      "5e-7; 2e-4.\n"
      "From vectors, around the peak of a lobe: relative, where the lobe is above 1e-6 of its "
      "peak. "
      "Bounds: 1e-9;\n1e-3; 1e-3.\n"
      "Beyond them: bold. GLSL ran on " +
      tables.renderer +
      ".\n\n"
      "| form | rows | f64 | f32 | GLSL |\n|---|---|---|---|---|\n";
  for (const auto& [form, lines] : tables.forms) text += row_text("| " + form + " |", lines.at(""));

  text +=
      "\n## By extreme\n\n| form | extreme | rows | f64 | f32 | GLSL "
      "|\n|---|---|---|---|---|---|\n";
  for (const auto& [form, lines] : tables.forms) {
    for (const auto& [place, line] : lines)
      if (!place.empty()) text += row_text("| " + form + " | " + place + " |", line);
  }
  return text +
         "\n## Hemispherical reflectance\n\n"
         "Of white light, with C_D = C_S = F = 1, by the light's angle of incidence; all else at "
         "its\n"
         "default.\n\n" +
         laws::reflectance_table();
}

}  // namespace metamer::extremes
