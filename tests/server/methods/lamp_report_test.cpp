// The page of lamps: what each method is off under each, for both observers. deploy/report writes
// it to deploy/lamps.md.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "common/color/lab.h"
#include "common/scene/methods.h"
#include "server/methods/direct_errors.h"
#include "server/plan/plan.h"
#include "tests/server/methods/lamps.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

struct NamedText {
  std::string name, text;  ///< Of a Spectrum message.
};

std::vector<NamedText> shown_lamps() {
  std::vector<NamedText> all;
  for (const char* standard : {"A", "D65", "F2", "F11"})
    all.push_back({standard, "standard: '" + std::string(standard) + "'"});
  for (const Lamp& lamp : lamps()) all.push_back({lamp.name, text_of(samples_of(lamp))});
  return all;
}

/// By 1 nm.
Spectrum tabulated(double (*reflectance)(double nm)) {
  Spectrum spectrum;
  for (int nm = 380; nm <= 780; ++nm) {
    spectrum.nm.push_back(nm);
    spectrum.values.push_back(reflectance(nm));
  }
  return spectrum;
}

double sigmoid(double nm, double at, double width) { return 1 / (1 + std::exp((at - nm) / width)); }

/// The test colours of the CIE's colour rendering index, and steep ones.
std::vector<Spectrum> reflectances() {
  std::vector<Spectrum> all;
  for (const std::string& name : cie::test_color_names()) all.push_back(*cie::test_color(name));
  for (const auto steep :
       {+[](double nm) { return 0.05 + 0.8 * sigmoid(nm, 588, 2); },
        +[](double nm) { return 0.9 - 0.8 * sigmoid(nm, 487, 2); },
        +[](double nm) { return 0.05 + 0.9 * std::exp(-std::pow((nm - 541) / 6, 2)); },
        +[](double nm) { return 0.9 - 0.8 * std::exp(-std::pow((nm - 612) / 5, 2)); }})
    all.push_back(tabulated(steep));
  return all;
}

/// Of each method in the registry, what people would choose of it.
std::vector<v1::Method> shown_methods() {
  std::vector<v1::Method> all;
  for (const MethodEntry& entry : method_entries()) {
    const std::string word = entry.word;
    if (word == "point") {
      for (const double step : {20.0, 10.0, 5.0}) {
        all.push_back(uniform(400, 700, step));
        all.push_back(cells(400, 700, step));
      }
      for (const std::uint32_t count : {8u, 16u}) all.push_back(fitted(count));
    } else if (word == "linear") {
      for (const std::uint32_t bases : {4u, 6u, 8u})
        all.push_back(linear(bases, v1::Linear::OBSERVER));
    } else {
      all.push_back(default_method(entry));
    }
  }
  return all;
}

std::string row_name(const v1::Method& method) {
  std::string name = method_text(method);
  if (method.point().lights() == v1::Point::SAMPLES && !method.point().has_fitted())
    name += ", lights sampled";
  if (method.point().lights() == v1::Point::CELLS) name += ", lights by cells";
  return name;
}

/// A lamp on every reflectance, its scene and the truth.
class LitColors {
 public:
  LitColors(const NamedText& lamp, const Observer& observer) {
    std::string text =
        "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { " +
        lamp.text + " } }";
    const std::vector<Spectrum> all = reflectances();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string name = "'m" + std::to_string(i) + "'";
      text += " material { name: " + name + " diffuse { " + text_of(all[i]) +
              " } } object { name: " + name + " material: " + name + " sphere { radius: 1 } }";
    }
    scene_ = compile_text(text);
    scene_.observer = observer;
    const PlainSum sum(scene_.emissions[0], observer);
    white_ = usable_white(sum.white());
    for (const RenderMaterial& material : scene_.materials)
      truth_.push_back(
          to_lab(sum(PlainSum::reflectance(scene_.properties[material.diffuse])), white_));
  }

  /// Mean and worst ΔE00.
  std::pair<double, double> errors(const v1::Method& choice) const {
    v1::Settings settings;
    *settings.mutable_method() = choice;
    const auto method = make_method(make_plan(scene_, settings, {.threads = 1}), scene_);
    double sum = 0, worst = 0;
    for (std::uint32_t i = 0; i < truth_.size(); ++i) {
      Gather gather(1);
      gather.weights(gather.surface(0, i), 0) = {1, 0, 0};
      const auto xyz = resolve(*method, gather);
      const double de00 = delta_e_00(to_lab({xyz[0], xyz[1], xyz[2]}, white_), truth_[i]);
      sum += de00;
      worst = std::max(worst, de00);
    }
    return {sum / static_cast<double>(truth_.size()), worst};
  }

 private:
  RenderScene scene_;
  Xyz white_;
  std::vector<Lab> truth_;
};

std::string digits(double de00) {
  char text[24];
  std::snprintf(text, sizeof text, de00 >= 9.95 ? "%.1f" : de00 >= 0.01 ? "%.2f" : "%.0e", de00);
  return text;
}

std::string lamp_table(const char* title, const Observer& observer) {
  std::string text = "\n## " + std::string(title) + "\n\n| method |", rule = "|---|";
  std::vector<LitColors> columns;
  for (const NamedText& lamp : shown_lamps()) {
    text += " " + lamp.name + " |";
    rule += "---|";
    columns.emplace_back(lamp, observer);
  }
  text += "\n" + rule + "\n";
  for (const v1::Method& method : shown_methods()) {
    text += "| " + row_name(method) + " |";
    for (const LitColors& lit : columns) {
      const auto [mean, worst] = lit.errors(method);
      text += " " + digits(mean) + " / " + digits(worst) + " |";
      EXPECT_TRUE(!method.has_exact() || worst < 0.001) << worst;
    }
    text += "\n";
  }
  return text;
}

TEST(LampReport, IsWrittenBesideTheProgramsOrWhereMetamerReportSays) {
  const char* wanted = std::getenv("METAMER_REPORT");
  const std::string path = wanted ? wanted : METAMER_BIN "/../lamps.md";
  std::ofstream file(path);
  file << R"(# Lamps and methods

Written by `deploy/report` (`tests/server/methods/lamp_report_test.cpp`).

ΔE00, mean / worst, over the 15 test colours of the CIE's colour rendering index and four steep reflectances, of light that
comes straight from them (`build/methods.md` has mirrors). The truth is a plain sum of light × reflectance × observer over
94,000 wavelengths, 0.005 nm apart; it shares no integral with the methods. White is the lamp's own; equal energy where
it is without X, Y or Z. The lamps that are no illuminants of the CIE's are in `tests/server/methods/lamps.cpp`: their lines
are 0.05 nm to some nm wide, as their kind's are, and lie between whole nanometres. With `point`, a light is sampled at each
wavelength, or is the mean of its cell.
)" << lamp_table("CIE 1931, 2°", cie::observer_1931())
       << lamp_table("CIE 1964, 10°", cie::observer_1964());
  file.close();
  EXPECT_TRUE(file) << path;
}

}  // namespace
}  // namespace metamer::test
