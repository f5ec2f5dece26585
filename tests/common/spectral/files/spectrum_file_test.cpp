#include "common/spectral/files/spectrum_file.h"

#include <gtest/gtest.h>

#include <clocale>

namespace metamer {
namespace {

std::string error_of(std::string_view text) {
  const auto result = parse_spectra(text, "paint.txt");
  return result ? "no error" : format(result.error());
}

Spectrum only(std::string_view text) {
  auto result = parse_spectra(text, "paint.txt");
  if (!result) {
    ADD_FAILURE() << format(result.error());
    return {};
  }
  EXPECT_EQ(result->size(), 1U);
  EXPECT_EQ(result->front().name, "");
  return result->front().spectrum;
}

const Spectrum figure_4_4 = {.nm = {400, 500, 600, 700}, .values = {0.2, 0.3, 0.6, 0.8}};

TEST(SpectrumFile, ReadsBothExamplesOfFigure44) {
  EXPECT_EQ(only("400 700 100\n0.2\n0.3\n0.6\n0.8\n"), figure_4_4);
  EXPECT_EQ(only("400 0.2\n500 0.3\n600 0.6\n700 0.8\n"), figure_4_4);
}

TEST(SpectrumFile, TakesCommentsBlankLinesAndWindowsLines) {
  EXPECT_EQ(only("# a paint\r\n\r\n400 700 100 # nm\r\n\t0.2 0.3\r\n0.6 0.8"), figure_4_4);
  EXPECT_EQ(only("\xEF\xBB\xBF# a paint\n400\t0.2\n  500   +3e-1\n\n600 .6\n700 8E-1"), figure_4_4);
}

TEST(SpectrumFile, ReadsASingleSample) {
  const Spectrum line = {.nm = {589}, .values = {1}};
  EXPECT_EQ(only("589 1"), line);
  EXPECT_EQ(only("589 589 1\n1"), line);
}

TEST(SpectrumFile, HasADecimalPointWhateverTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    EXPECT_EQ(only("400 0.25").values[0], 0.25) << name;
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(SpectrumFile, NamesWhatIsNoSpectrum) {
  EXPECT_EQ(error_of(""), "paint.txt:1:1: error: the file has no data");
  EXPECT_EQ(error_of("\n# nothing\n"), "paint.txt:3:1: error: the file has no data");
  EXPECT_EQ(error_of("\n  hello world\n"),
            "paint.txt:2:3: error: no spectrum: expected \"from to step\", \"wavelength value\" on "
            "each line, a table, or a CGATS file with BEGIN_DATA");
  EXPECT_EQ(
      error_of("1\n2\n"),
      "paint.txt:1:1: error: expected \"wavelength value\" on each line, but there is no value");
}

TEST(SpectrumFile, LocatesWhatIsWrongInAUniformFile) {
  EXPECT_EQ(error_of("400 7oo 100\n0.2"), "paint.txt:1:5: error: \"7oo\" is not a number");
  EXPECT_EQ(error_of("400 700 0\n0.2"), "paint.txt:1:1: error: the step must be above 0 nm, not 0");
  EXPECT_EQ(error_of("700 400 5\n0.2"),
            "paint.txt:1:1: error: the last wavelength, 400, is below the first, 700");
  EXPECT_EQ(error_of("400 700 1e-9\n0.2"),
            "paint.txt:1:1: error: at most 4001 wavelengths are possible; 400 to 700 by 1e-09 are "
            "more");
  EXPECT_EQ(error_of("400 700 100\n0.2\n0.3 x\n"), "paint.txt:3:5: error: \"x\" is not a number");
  EXPECT_EQ(error_of("400 700 100\n0.2\n0.3\n0.6\n"),
            "paint.txt:5:1: error: \"400 700 100\" asks for 4 values, but the file ends after 3");
  EXPECT_EQ(error_of("400 700 100\n0.2\n0.3\n0.6\n0.8\n0.9"),
            "paint.txt:6:1: error: \"400 700 100\" asks for 4 values, and here is one more");
}

TEST(SpectrumFile, LocatesWhatIsWrongInPairs) {
  EXPECT_EQ(error_of("400 0.2\n500\n600 0.3"),
            "paint.txt:2:1: error: expected 2 cells as on line 1, not 1");
  EXPECT_EQ(error_of("400 0.2\n500 0.3 0.4\n"),
            "paint.txt:2:9: error: expected 2 cells as on line 1, not 3");
  EXPECT_EQ(error_of("400 0.2\n400 0.3\n"), "paint.txt:2:1: error: wavelength 400 is repeated");
  EXPECT_EQ(error_of("400 0.2\n410 0.2\n  390 0.3\n"),
            "paint.txt:3:3: error: wavelengths must rise: 390 follows 410");
  EXPECT_EQ(error_of("-400 0.2\n"), "paint.txt:1:1: error: wavelength -400 must be above 0 nm");
  EXPECT_EQ(error_of("400 0.2\n500 0,3\n"), "paint.txt:2:5: error: \"0,3\" is not a number");
}

TEST(SpectrumFile, TakesFiniteNumbersOnly) {
  for (const std::string word : {"nan", "-inf", "infinity", "1e999", "-1e999"}) {
    EXPECT_EQ(error_of("400 " + word),
              "paint.txt:1:5: error: \"" + word + "\" is not a finite number");
    EXPECT_EQ(error_of("400 500 100\n" + word),
              "paint.txt:2:1: error: \"" + word + "\" is not a finite number");
  }
  for (const std::string word : {"0x10", "1e", "+-1", "--1", "1.2.3", "+", "1_000", "½"}) {
    EXPECT_EQ(error_of("400 " + word), "paint.txt:1:5: error: \"" + word + "\" is not a number");
  }
}

TEST(SpectrumFile, IsBounded) {
  std::string pairs;
  for (int i = 1; i <= 4001; ++i) pairs += std::to_string(i) + " 1\n";
  EXPECT_EQ(error_of(pairs), "no error");
  EXPECT_EQ(error_of(pairs + "4002 1\n"),
            "paint.txt:4002:1: error: at most 4001 samples are possible");
  EXPECT_EQ(error_of(std::string(max_spectrum_file + 1, ' ')),
            "paint.txt: error: a spectrum file may have 16777216 bytes, not 16777217");
}

TEST(SpectrumFile, CitesHostileWordsShortAndPrintable) {
  EXPECT_EQ(error_of("400 " + std::string(1000, 'x')),
            "paint.txt:1:5: error: \"" + std::string(60, 'x') + "…\" is not a number");
  EXPECT_EQ(error_of("400 \x1B[2J"), "paint.txt:1:5: error: \"?[2J\" is not a number");
}

NamedSpectrum named(const std::string& name) { return {.name = name, .spectrum = figure_4_4}; }

std::string select_error(std::vector<NamedSpectrum> spectra, const std::string& entry) {
  const auto result = select_entry(std::move(spectra), entry);
  return result ? "no error" : format(result.error());
}

TEST(SelectEntry, TakesTheOnlyOneOrTheNamedOne) {
  EXPECT_EQ(select_entry({named("")}, "")->spectrum, figure_4_4);
  EXPECT_EQ(select_entry({named("TCS01")}, "")->spectrum, figure_4_4);
  NamedSpectrum other = named("TCS02");
  other.spectrum.values[0] = 1;
  EXPECT_EQ(select_entry({named("TCS01"), other}, "TCS02")->spectrum, other.spectrum);
}

TEST(SelectEntry, SaysWhatThereIsInstead) {
  EXPECT_EQ(select_error({named("TCS01"), named("TCS02")}, ""),
            "error: the file has 2 spectra; name one with entry: \"TCS01\", \"TCS02\"");
  EXPECT_EQ(select_error({named(""), named("")}, ""),
            "error: the file has 2 spectra; name one with entry: \"#1\", \"#2\"");
  EXPECT_EQ(select_error({named("TCS01"), named("TCS02")}, "TSC02"),
            "error: the file has no entry \"TSC02\"; did you mean \"TCS02\"?");
  EXPECT_EQ(select_error({named("")}, "TCS02"),
            "error: the file has no entry \"TCS02\"; it has \"#1\"");
  EXPECT_EQ(select_error({named("red"), named("blue"), named("red")}, "red"),
            "error: the file has several entries \"red\"; choose one: \"red#1\", \"red#2\"");
}

TEST(SelectEntry, TellsEntriesOfOneNameApartByNumber) {
  const std::vector<std::string> names = {"red", "blue", "red", "", "red#2", "blue"};
  const auto of = [&](const char* entry) { return entries_named(names, entry); };
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(of("red"), (Places{0, 2}));
  EXPECT_EQ(of("red#1"), Places{0});
  EXPECT_EQ(of("red#2"), Places{4}) << "what is called so goes before";
  EXPECT_EQ(of("blue#2"), Places{5});
  EXPECT_EQ(of("#3"), Places{2});
  EXPECT_EQ(of("#4"), Places{3});
  EXPECT_EQ(of("#6"), Places{5});
  for (const char* none : {"blue#3", "blue#0", "#7", "#0", "#", "blue#", "blue#1x", "green", "#-1",
                           "blue#99999999999999999999"})
    EXPECT_EQ(of(none), Places{}) << none;
}

}  // namespace
}  // namespace metamer
