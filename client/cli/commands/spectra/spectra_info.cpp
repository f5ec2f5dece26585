// What a spectrum is: its range, and how it looks.
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/commands/spectra/bispectral.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/tools/spectra/spectrum_facts.h"

namespace metamer::cli {
namespace {

using client::EmissionFacts;
using client::LoadedSpectrum;
using client::ReflectanceFacts;
using client::SpectrumFacts;

std::string digits(double value, const char* format = "%.6g") {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// What programs read.

void add_chromaticity(const std::optional<Chromaticity>& c, Json& json) {
  if (!c) return;
  const Uv uv = uv_1976(*c);
  json["x"] = c->x;
  json["y"] = c->y;
  json["u_prime"] = uv.u;
  json["v_prime"] = uv.v;
}

void add(const EmissionFacts& facts, Json& json) {
  for (const client::ObservedLight& one : facts.observed) {
    Json& of_observer = json[one.observer.name()];
    of_observer["luminance"] = one.luminance;
    add_chromaticity(one.chromaticity, of_observer);
  }
  if (facts.temperature) {
    json["color_temperature"] = facts.temperature->kelvin;
    json["duv"] = facts.temperature->duv;
  }
  if (const auto& index = facts.rendering)
    json["rendering"] = {{"ra", index->ra}, {"each", index->each}, {"distance", index->distance}};
}

void add(const ReflectanceFacts& facts, const std::string& under, Json& json) {
  json["under"] = under;
  json["luminance"] = facts.luminance;
  add_chromaticity(facts.chromaticity, json);
  if (facts.lab) json["lab"] = {facts.lab->l, facts.lab->a, facts.lab->b};
}

Json json_of(const LoadedSpectrum& one, const SpectrumFacts& facts, const std::string& under) {
  Json json;
  json["name"] = one.label;
  json["kind"] = quantity_text(one.quantity);
  if (!one.format.empty()) json["format"] = one.format;
  if (!one.notes.empty()) json["notes"] = one.notes;
  json["from"] = facts.from;
  json["to"] = facts.to;
  json["samples"] = facts.samples;
  json["interpolation"] = word_of(one.curve.interpolation);
  if (one.curve.straight > 0) json["straight_stretches"] = one.curve.straight;
  json["min"] = facts.min;
  json["max"] = facts.max;
  if (const auto* emission = std::get_if<EmissionFacts>(&facts.look)) add(*emission, json);
  if (const auto* paint = std::get_if<ReflectanceFacts>(&facts.look)) add(*paint, under, json);
  return json;
}

// What people read.

std::string text_of(const std::optional<Chromaticity>& c) {
  if (!c) return {};
  const Uv uv = uv_1976(*c);
  return "\n  chromaticity x " + digits(c->x, "%.5f") + ", y " + digits(c->y, "%.5f") + "; u' " +
         digits(uv.u, "%.5f") + ", v' " + digits(uv.v, "%.5f");
}

std::string text_of(const EmissionFacts& facts) {
  std::string text;
  for (const client::ObservedLight& one : facts.observed)
    text += "\n  luminance    " + digits(one.luminance) + " (" + one.observer.name() + ")" +
            text_of(one.chromaticity);
  if (facts.temperature)
    text += "\n  temperature  " + digits(facts.temperature->kelvin, "%.0f") + " K, Duv " +
            digits(facts.temperature->duv, "%.4f");
  else
    text += "\n  temperature  none: no black body is like it";
  const auto& index = facts.rendering;
  if (!index) return text;
  text +=
      "\n  rendering    Ra " + digits(index->ra, "%.0f") + ", R9 " + digits(index->each[8], "%.0f");
  if (index->distance > RenderingIndex::tolerance)
    text += " (of little meaning: it is tinted by " + digits(index->distance, "%.4f") + " in u, v)";
  return text;
}

std::string text_of(const ReflectanceFacts& facts, const std::string& under) {
  std::string text = "\n  luminance    " + digits(facts.luminance) + " of white under " + under +
                     text_of(facts.chromaticity);
  if (facts.lab)
    text += "\n  L*a*b*       " + digits(facts.lab->l, "%.2f") + " " +
            digits(facts.lab->a, "%.2f") + " " + digits(facts.lab->b, "%.2f");
  return text;
}

/// What it is between its samples.
std::string between(const LoadedSpectrum& one) {
  const auto text = [&](const char* curve) {
    if (one.curve.straight == 0) return curve + std::string(" between them");
    return curve + std::string(" between them, but straight lines in ") +
           std::to_string(one.curve.straight) +
           (one.curve.straight == 1 ? " stretch" : " stretches") +
           (one.emission() ? " where it goes below 0" : " where it leaves 0..1");
  };
  switch (one.curve.interpolation) {
    case Interpolation::linear:
      return text("straight lines");
    case Interpolation::sprague:
      return text("Sprague's interpolation");
    case Interpolation::monotone_cubic:
      return text("a monotone cubic");
  }
  return {};
}

std::string text_of(const LoadedSpectrum& one, const SpectrumFacts& facts,
                    const std::string& under) {
  std::string text = one.label + ": " + quantity_text(one.quantity) +
                     (one.format.empty() ? "" : ", read as " + one.format) + "\n  range        " +
                     number_text(facts.from) + " to " + number_text(facts.to) + " nm, " +
                     std::to_string(facts.samples) +
                     (facts.samples == 1 ? " sample" : " samples, " + between(one)) +
                     "\n  values       " + digits(facts.min) + " to " + digits(facts.max);
  for (const std::string& note : one.notes) text += "\n  note         " + note;
  if (const auto* emission = std::get_if<EmissionFacts>(&facts.look)) text += text_of(*emission);
  if (const auto* paint = std::get_if<ReflectanceFacts>(&facts.look))
    text += text_of(*paint, under);
  return text;
}

ExitCode run(const SpectraOptions& given) {
  SpectraOptions options = given;
  Report report(options.json);
  bool sound = true;
  std::erase_if(options.files, [&](const std::string& file) {
    const auto told = tell_bispectral(file, report);
    sound = sound && told.value_or(true);
    return told.has_value();
  });
  if (!sound) return report.finish(ExitCode::bad_input);
  if (options.files.empty()) return report.finish(ExitCode::done);
  const auto observer = load_observer(options.observer, report);
  if (!observer) return report.finish(ExitCode::bad_input);
  const auto spectra = load_spectra(options, options.files, report);
  const auto light = load_light(options.under, "--under", *observer, report);
  if (!spectra || !light) return report.finish(ExitCode::bad_input);
  tell_ends_of(*spectra, {{options.under, *light, *observer}}, *observer, report);
  for (const LoadedSpectrum& one : *spectra) {
    const auto facts =
        client::spectrum_facts(one, *light, *observer, *find_table_weights(options.weights));
    if (!facts) return refuse(one.label + ": " + facts.error().message, report);
    report.document()["spectra"].push_back(json_of(one, *facts, options.under));
    report.line(text_of(one, *facts, options.under));
  }
  return report.finish(ExitCode::done);
}

void declare(SpectraOptions& values, Options& options) {
  declare_spectra(values, options);
  declare_observer(values, options);
  declare_under(values, options);
  declare_weights(values.weights, options);
}

}  // namespace

Command commands::spectra_info() {
  return make_command<SpectraOptions>(
      "spectra info", "range, luminance, chromaticity, temperature, Ra", declare, run);
}

}  // namespace metamer::cli
