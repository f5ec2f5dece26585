// The same spectrum in each format that is read is the same spectrum.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "common/problem.h"
#include "common/spectral/files/spectra_text.h"
#include "common/spectral/files/spectrum_file.h"

namespace metamer {
namespace {

/// Numbers that take all of a double's digits.
Spectrum awkward() {
  Spectrum spectrum;
  for (int i = 0; i < 31; ++i) {
    spectrum.nm.push_back(400 + 10 * i);
    spectrum.values.push_back(i == 3 ? 0.125 : 1.0 / (3 + i) + 1e-9 * i);
  }
  return spectrum;
}

std::string with_decimal(double value, char decimal) {
  std::string text = number_text(value);
  for (char& c : text) c = c == '.' ? decimal : c;
  return text;
}

/// A line a wavelength.
std::string tall(const Spectrum& spectrum, const std::string& head, const std::string& delimiter,
                 char decimal = '.', const std::string& unit = "") {
  std::string text = head;
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i)
    text += with_decimal(spectrum.nm[i], decimal) + unit + delimiter +
            with_decimal(spectrum.values[i], decimal) + "\n";
  return text;
}

std::string falling(Spectrum spectrum) {
  std::reverse(spectrum.nm.begin(), spectrum.nm.end());
  std::reverse(spectrum.values.begin(), spectrum.values.end());
  return tall(spectrum, "nm;R\n", ";", ',');
}

std::string micrometres(Spectrum spectrum) {
  for (double& nm : spectrum.nm) nm /= 1000;
  return tall(spectrum, "Wavelength (um)\tR\n", "\t");
}

/// A spectrum a line, its wavelengths called by `before` and `after`.
std::string wide(const Spectrum& spectrum, const std::string& before, const std::string& after,
                 char delimiter) {
  std::string heading = "Name", row = "a";
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i) {
    heading += delimiter + before + number_text(spectrum.nm[i]) + after;
    row += delimiter + number_text(spectrum.values[i]);
  }
  return heading + "\n" + row + "\n";
}

std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + number_text(value);
  return text;
}

std::string cgats_by_columns(const Spectrum& spectrum, const std::string& before) {
  std::string fields = "SAMPLE_NAME", row = "a";
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i) {
    fields += "\t" + before + number_text(spectrum.nm[i]);
    row += "\t" + number_text(spectrum.values[i]);
  }
  const std::string count = std::to_string(spectrum.nm.size() + 1);
  return "CGATS.17\nNUMBER_OF_FIELDS " + count + "\nBEGIN_DATA_FORMAT\n" + fields +
         "\nEND_DATA_FORMAT\nNUMBER_OF_SETS 1\nBEGIN_DATA\n" + row + "\nEND_DATA\n";
}

std::string cxf(const Spectrum& spectrum) {
  return "<CxF><Resources><ObjectCollection><Object Name=\"a\"><ColorValues><ReflectanceSpectrum "
         "StartWL=\"400\" Increment=\"10\">" +
         joined(spectrum.values) +
         "</ReflectanceSpectrum></ColorValues></Object></ObjectCollection></Resources></CxF>";
}

std::string tm27(const Spectrum& spectrum) {
  std::string text =
      "<IESTM2714><SpectralDistribution><SpectralQuantity>reflectance"
      "</SpectralQuantity>";
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i)
    text += "<SpectralData wavelength=\"" + number_text(spectrum.nm[i]) + "\">" +
            number_text(spectrum.values[i]) + "</SpectralData>";
  return text + "</SpectralDistribution></IESTM2714>";
}

std::string utf16(const std::string& text) {
  std::string bytes = "\xFF\xFE";
  for (const char c : text) bytes += std::string{c, '\0'};
  return bytes;
}

struct Format {
  const char* name;
  std::string format;  ///< As the reader calls it.
  std::function<std::string(const Spectrum&)> write;
};

std::string ours(const Spectrum& spectrum, SpectrumFormat format) {
  return *spectra_text({{.name = "a", .spectrum = spectrum}}, format);
}

std::vector<Format> formats() {
  return {
      {"pairs", "pairs", [](const Spectrum& s) { return ours(s, SpectrumFormat::pairs); }},
      {"uniform", "uniform samples",
       [](const Spectrum& s) { return ours(s, SpectrumFormat::uniform); }},
      {"cgats", "CGATS", [](const Spectrum& s) { return ours(s, SpectrumFormat::cgats); }},
      {"nm", "CGATS", [](const Spectrum& s) { return cgats_by_columns(s, "nm"); }},
      {"SPECTRAL_NM_", "CGATS",
       [](const Spectrum& s) { return cgats_by_columns(s, "SPECTRAL_NM_"); }},
      {"R_", "CGATS", [](const Spectrum& s) { return cgats_by_columns(s, "R_"); }},
      {"csv", "a table with commas", [](const Spectrum& s) { return tall(s, "nm,R\n", ","); }},
      {"semicolons", "a table with semicolons, decimal commas",
       [](const Spectrum& s) { return tall(s, "nm;R\n", ";", ','); }},
      {"tabs", "a table with tabs", [](const Spectrum& s) { return tall(s, "nm\tR\n", "\t"); }},
      {"falling", "a table with semicolons, decimal commas", falling},
      {"um", "a table with tabs", micrometres},
      {"no-break space", "pairs", [](const Spectrum& s) { return tall(s, "", "\xC2\xA0"); }},
      {"wide", "a table with commas, a spectrum a line",
       [](const Spectrum& s) { return wide(s, "", "nm", ','); }},
      {"wide R", "a table with semicolons, a spectrum a line",
       [](const Spectrum& s) { return wide(s, "R[", "nm]", ';'); }},
      {"OceanView", "OceanView's text",
       [](const Spectrum& s) { return tall(s, ">>>>>Begin Spectral Data<<<<<\n", "\t"); }},
      {"Sekonic", "Sekonic's export",
       [](const Spectrum& s) {
         std::string text = "Model,C-7000\n";
         for (std::size_t i = 0; i < s.nm.size(); ++i)
           text +=
               "Spectral Data " + number_text(s.nm[i]) + "[nm]," + number_text(s.values[i]) + "\n";
         return text;
       }},
      {"UPRtek", "a table with tabs",
       [](const Spectrum& s) { return tall(s, "Model\tMK350\n", "\t", '.', "nm"); }},
      {"CxF3", "CxF3", cxf},
      {"TM-27", "IES TM-27", tm27},
      {"UTF-16", "pairs", [](const Spectrum& s) { return utf16(ours(s, SpectrumFormat::pairs)); }},
  };
}

TEST(EveryFormat, WrittenAndReadBackGivesTheSameValues) {
  const Spectrum spectrum = awkward();
  for (const Format& format : formats()) {
    const std::string text = format.write(spectrum);
    for (const char* end : {"\n", "\r\n", "\r"}) {
      std::string lines;
      for (const char c : text) lines += c == '\n' ? std::string(end) : std::string(1, c);
      if (format.name == std::string("UTF-16")) lines = text;
      const auto file = read_spectrum_file(lines, "f");
      ASSERT_TRUE(file) << format.name << ": " << metamer::format(file.error());
      EXPECT_EQ(file->format, format.format) << format.name;
      ASSERT_EQ(file->spectra.size(), 1U) << format.name;
      EXPECT_EQ(file->spectra.front().spectrum, spectrum) << format.name;
    }
  }
}

TEST(EveryFormat, CutShortIsAnErrorOrASpectrum) {
  for (const Format& format : formats()) {
    const std::string text = format.write(awkward());
    for (std::size_t size = 0; size < text.size(); size += 7) {
      const auto file = read_spectrum_file(std::string_view(text).substr(0, size), "f");
      EXPECT_TRUE(file ? !file->spectra.empty() : !file.error().message.empty()) << format.name;
    }
  }
}

}  // namespace
}  // namespace metamer
