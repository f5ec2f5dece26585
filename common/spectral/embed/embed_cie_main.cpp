// Writes the CIE's tables as C++, read from colord-data's files with the reader that scenes use.
// Run by the build: embed_cie FOLDER OUTPUT.cpp

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "common/spectral/files/spectrum_file.h"
#include "common/spectral/observer.h"

namespace {

using metamer::NamedSpectrum;

[[noreturn]] void fail(const std::string& text) {
  std::cerr << text << '\n';
  std::exit(EXIT_FAILURE);
}

/// The spectra of a file, which must be `count`.
std::vector<NamedSpectrum> read(const std::string& path, std::size_t count) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("embed_cie: can't open " + path);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  auto spectra = metamer::parse_spectra(text, path);
  if (!spectra) fail(metamer::format(spectra.error(), text));
  if (spectra->size() != count) {
    fail("embed_cie: " + path + " must have " + std::to_string(count) + " spectra");
  }
  return std::move(*spectra);
}

std::string list(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += metamer::number_text(number) + ", ";
  return text;
}

void write_tables(std::ostream& out, const std::string& name,
                  const std::vector<NamedSpectrum>& spectra) {
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    const std::string suffix = name + "_" + std::to_string(i);
    const metamer::Spectrum& spectrum = spectra[i].spectrum;
    out << "constexpr double nm_" << suffix << "[] = {" << list(spectrum.nm) << "};\n"
        << "constexpr double values_" << suffix << "[] = {" << list(spectrum.values) << "};\n";
  }
  out << "constexpr Table all_" << name << "[] = {\n";
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    const std::string suffix = name + "_" + std::to_string(i);
    out << "    {\"" << spectra[i].name << "\", nm_" << suffix << ", values_" << suffix << "},\n";
  }
  out << "};\n\n";
}

/// colord's F10 has 0.0063 at 385 nm, which is F11's value there, and 0.0881 at 605 nm, where the
/// CIE's table (CIE 15:2004, T.6) has 0.0080 and 0.0831 as the Python package colour has it (FL10).
/// The CIE's chromaticity, x 0.3458, y 0.3588, bears out the second alone: with 0.0881 x is 0.3461,
/// and what is at 385 nm changes it by 3e-7.
void correct_f10(metamer::Spectrum& light) {
  const auto correct = [&](double nm, double wrong, double right) {
    const auto at = std::find(light.nm.begin(), light.nm.end(), nm) - light.nm.begin();
    double& value = light.values.at(static_cast<std::size_t>(at));
    if (value != wrong && value != right) fail("embed_cie: F10 has other values than it had");
    value = right;
  };
  correct(385, 0.0063, 0.0080);
  correct(605, 0.0881, 0.0831);
}

/// colord has no D75. It is made as the CIE's other tables of daylight are (CIE 15:2004, 3.1): of
/// S0, S1, S2 with M1 and M2 of 7500 K × 1.4388 / 1.4380 rounded to three digits.
NamedSpectrum make_d75(const std::string& folder) {
  const auto s = read(folder + "/ref/CIE-1986-daylight-SPD.cmf", 3);
  constexpr double m1 = 0.145, m2 = -0.760;
  NamedSpectrum d75{.name = "D75", .spectrum = s[0].spectrum};
  for (std::size_t i = 0; i < d75.spectrum.values.size(); ++i)
    d75.spectrum.values[i] =
        (s[0].spectrum.values[i] + m1 * s[1].spectrum.values[i] + m2 * s[2].spectrum.values[i]) /
        100;
  return d75;
}

std::vector<NamedSpectrum> read_illuminants(const std::string& folder) {
  std::vector<NamedSpectrum> all;
  for (const std::string name :
       {"A",  "B",  "C",  "D50", "D55", "D65", "D93", "E",   "F1",  "F2",
        "F3", "F4", "F5", "F6",  "F7",  "F8",  "F9",  "F10", "F11", "F12"}) {
    if (name == "D93") all.push_back(make_d75(folder));
    all.push_back(read(folder + "/illuminant/CIE-" + name + ".sp", 1).front());
    all.back().name = name;
    if (name == "F10") correct_f10(all.back().spectrum);
  }
  return all;
}

/// By 1 nm, as the CIE tabulates them.
std::vector<NamedSpectrum> read_observers(const std::string& folder) {
  std::vector<NamedSpectrum> all = read(folder + "/cmf/CIE1931-2deg-XYZ.cmf", 3);
  for (NamedSpectrum& function : read(folder + "/cmf/CIE1964-10deg-XYZ.cmf", 3)) {
    all.push_back(std::move(function));
  }
  for (NamedSpectrum& function : all)
    function.spectrum = metamer::matching_function(function.spectrum);
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) fail("usage: embed_cie FOLDER OUTPUT.cpp");
  const std::string folder = argv[1];
  std::ofstream out(argv[2], std::ios::binary);
  out << "// Written by embed_cie from the files in " << folder << ".\n"
      << "#include \"common/spectral/cie_tables.h\"\n\n"
      << "namespace metamer::cie::tables {\nnamespace {\n\n";
  write_tables(out, "observers", read_observers(folder));
  write_tables(out, "illuminants", read_illuminants(folder));
  write_tables(out, "test_colors", read(folder + "/ref/CIE-TCS.sp", 15));
  write_tables(out, "daylight", read(folder + "/ref/CIE-1986-daylight-SPD.cmf", 3));
  out << "}  // namespace\n\n";
  for (const std::string name : {"observers", "illuminants", "test_colors", "daylight"}) {
    out << "constinit const std::span<const Table> " << name << " = all_" << name << ";\n";
  }
  out << "\n}  // namespace metamer::cie::tables\n";
  out.close();
  if (!out) fail(std::string("embed_cie: can't write ") + argv[2]);
  return EXIT_SUCCESS;
}
