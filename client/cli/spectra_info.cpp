// What a spectrum is: its range, and how it looks.
#include <algorithm>
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/spectra_input.h"
#include "common/color/chromaticity.h"
#include "common/color/lab.h"
#include "common/color/rendering_index.h"

namespace metamer::cli {
namespace {

std::string digits(double value, const char* format = "%.6g") {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void add_range(const LoadedSpectrum& one, Json& json, std::string& text) {
  const Spectrum& spectrum = one.spectrum;
  const auto [least, most] = std::minmax_element(spectrum.values.begin(), spectrum.values.end());
  json["name"] = one.label;
  json["kind"] = one.emission ? "emission" : "reflectance";
  json["from"] = spectrum.nm.front();
  json["to"] = spectrum.nm.back();
  json["samples"] = spectrum.nm.size();
  json["min"] = *least;
  json["max"] = *most;
  text += one.label + (one.emission ? ": emission" : ": reflectance") + "\n  range        " +
          number_text(spectrum.nm.front()) + " to " + number_text(spectrum.nm.back()) + " nm, " +
          std::to_string(spectrum.nm.size()) + (spectrum.nm.size() == 1 ? " sample" : " samples") +
          "\n  values       " + digits(*least) + " to " + digits(*most);
}

void add_chromaticity(const Xyz& xyz, Json& json, std::string& text) {
  const auto c = chromaticity(xyz);
  if (!c) return;
  const Uv uv = uv_1976(*c);
  json["x"] = c->x;
  json["y"] = c->y;
  json["u_prime"] = uv.u;
  json["v_prime"] = uv.v;
  text += "\n  chromaticity x " + digits(c->x, "%.5f") + ", y " + digits(c->y, "%.5f") + "; u' " +
          digits(uv.u, "%.5f") + ", v' " + digits(uv.v, "%.5f");
}

/// Temperature and rendering, which are defined for the 1931 observer.
void add_whiteness(const Spectrum& light, const Wavelengths& wavelengths,
                   const std::vector<double>& power, Json& json, std::string& text) {
  const Xyz xyz = to_xyz(observer_weights(cie::Observer::cie_1931_2deg, wavelengths), power);
  const auto own = chromaticity(xyz);
  const auto temperature = own ? color_temperature(*own) : std::nullopt;
  if (temperature) {
    json["color_temperature"] = temperature->kelvin;
    json["duv"] = temperature->duv;
    text += "\n  temperature  " + digits(temperature->kelvin, "%.0f") + " K, Duv " +
            digits(temperature->duv, "%.4f");
  } else {
    text += "\n  temperature  none: no black body is like it";
  }
  const auto index = rendering_index(light);
  if (!index) return;
  json["rendering"] = {{"ra", index->ra}, {"each", index->each}, {"distance", index->distance}};
  text +=
      "\n  rendering    Ra " + digits(index->ra, "%.0f") + ", R9 " + digits(index->each[8], "%.0f");
  if (index->distance > RenderingIndex::tolerance)
    text += " (of little meaning: it is tinted by " + digits(index->distance, "%.4f") + " in u, v)";
}

void add_emission(const LoadedSpectrum& one, Json& json, std::string& text) {
  const Wavelengths wavelengths = own_wavelengths(one.spectrum);
  const std::vector<double> power = resample(one.spectrum, wavelengths.nm(), Outside::zero).values;
  for (const auto& [word, observer] :
       {std::pair{"cie-1931-2deg", cie::Observer::cie_1931_2deg},
        std::pair{"cie-1964-10deg", cie::Observer::cie_1964_10deg}}) {
    const Xyz xyz = to_xyz(observer_weights(observer, wavelengths), power);
    Json& of_observer = json[word];
    of_observer["luminance"] = xyz[1];
    text += std::string("\n  luminance    ") + digits(xyz[1]) + " (" + word + ")";
    add_chromaticity(xyz, of_observer, text);
  }
  add_whiteness(one.spectrum, wavelengths, power, json, text);
}

void add_reflectance(const LoadedSpectrum& one, const Spectrum& light, const std::string& under,
                     cie::Observer observer, Json& json, std::string& text) {
  const Wavelengths wavelengths = fine_wavelengths(light);
  const ObserverWeights lit = under_light(observer_weights(observer, wavelengths),
                                          resample(light, wavelengths.nm(), Outside::zero).values);
  const Xyz white = to_xyz(lit, std::vector<double>(wavelengths.size(), 1.0));
  const Xyz xyz = to_xyz(lit, resample(one.spectrum, wavelengths.nm(), Outside::hold).values);
  json["under"] = under;
  json["luminance"] = xyz[1];
  text += "\n  luminance    " + digits(xyz[1]) + " of white under " + under;
  add_chromaticity(xyz, json, text);
  if (!(*std::min_element(white.begin(), white.end()) > 0)) return;
  const Lab lab = to_lab(xyz, white);
  json["lab"] = {lab.l, lab.a, lab.b};
  text += "\n  L*a*b*       " + digits(lab.l, "%.2f") + " " + digits(lab.a, "%.2f") + " " +
          digits(lab.b, "%.2f");
}

}  // namespace

ExitCode spectra_info(const SpectraOptions& options) {
  Report report(options.json);
  const auto observer = observer_of(options.observer);
  if (!observer) {
    report.error(observer.error().message);
    return report.finish(ExitCode::bad_input);
  }
  const auto spectra = load_spectra(options, options.files, report);
  const auto light = load_light(options.under, "--under", report);
  if (!spectra || !light) return report.finish(ExitCode::bad_input);
  for (const LoadedSpectrum& one : *spectra) {
    Json json;
    std::string text;
    add_range(one, json, text);
    if (one.emission)
      add_emission(one, json, text);
    else
      add_reflectance(one, *light, options.under, *observer, json, text);
    report.document()["spectra"].push_back(json);
    report.line(text);
  }
  return report.finish(ExitCode::done);
}

}  // namespace metamer::cli
