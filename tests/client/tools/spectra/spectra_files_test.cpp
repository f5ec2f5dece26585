// Spectra by the names of files and of the CIE's tables.
#include "client/tools/spectra/spectra_files.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/spectral/cie.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

constexpr const char* two_colors =
    "SPECT\nNUMBER_OF_FIELDS 3\nBEGIN_DATA_FORMAT\nSAMPLE_NAME SPEC_400 SPEC_700\n"
    "END_DATA_FORMAT\nNUMBER_OF_SETS 2\nBEGIN_DATA\n\"red\" 0 1\n\"b\x1b[2J\" 1 0\nEND_DATA\n";

TEST(SpectraFiles, ANameOfTheCiesIsALightOrAPaint) {
  const auto both = load_spectra({"F11", "TCS09"});
  ASSERT_TRUE(both);
  ASSERT_EQ(both->size(), 2u);
  EXPECT_TRUE((*both)[0].emission());
  EXPECT_EQ((*both)[0].spectrum(), *cie::illuminant("F11"));
  EXPECT_EQ((*both)[0].outside(), Outside::zero);
  EXPECT_FALSE((*both)[1].emission());
  EXPECT_EQ((*both)[1].label, "TCS09");
  EXPECT_EQ((*both)[1].outside(), Outside::hold);
}

TEST(SpectraFiles, AFileIsAReflectanceWhereAllOfItLiesIn0To1) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.txt", "400 0\n700 1\n");
  const std::string above = folder.write("above.txt", "400 0\n700 1.0000001\n");
  const std::string below = folder.write("below.txt", "400 -0.0000001\n700 1\n");
  const auto all = load_spectra({in, above, below});
  ASSERT_TRUE(all);
  EXPECT_FALSE((*all)[0].emission());
  EXPECT_EQ((*all)[0].label, in);
  EXPECT_EQ((*all)[0].name, "in");
  EXPECT_TRUE((*all)[1].emission());
  EXPECT_TRUE((*all)[2].emission());
  EXPECT_TRUE(load_one(in, {.reading = {.as = Quantity::emission}})->emission());
  EXPECT_FALSE(load_one("D65", {.reading = {.as = Quantity::reflectance}})->emission());
}

TEST(SpectraFiles, AnEntryIsChosenByTheWordOrForAll) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.sp", two_colors);
  EXPECT_EQ(load_spectra({file})->size(), 2u);
  EXPECT_EQ(load_spectra({file})->at(1).name, "b?[2J") << "it could command a terminal";
  EXPECT_EQ(load_one(file + "#red")->spectrum().values, (std::vector<double>{0, 1}));
  EXPECT_EQ(load_one(file, {.entry = "red"})->label, file + ": red");
  EXPECT_EQ(load_one(file + "#red", {.entry = "blue"})->name, "red") << "the word's own goes first";

  // A file may be called like that itself.
  folder.write("two.sp#red", "500 0.25\n");
  EXPECT_EQ(load_one(file + "#red")->spectrum().values, (std::vector<double>{0.25}));
}

TEST(SpectraFiles, AWrongChoiceIsToldFromAWrongFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.sp", two_colors);
  const auto several = load_one(file);
  ASSERT_FALSE(several);
  EXPECT_TRUE(several.error().choice);
  const auto none = load_one(file + "#rad");
  ASSERT_FALSE(none);
  EXPECT_TRUE(none.error().choice);
  EXPECT_EQ(none.error().problem.message,
            quoted(file) + " has no spectrum named \"rad\"; did you mean \"red\"?");
  const auto unknown = load_spectra({"D65", "D66"});
  ASSERT_FALSE(unknown);
  EXPECT_FALSE(unknown.error().choice);
}

TEST(SpectraFiles, AFaultOfAFileBringsItsLineAndItsText) {
  const TemporaryFolder folder;
  const std::string text = "400 1\n500 x\n";
  const std::string file = folder.write("bad.txt", text);
  const auto bad = load_spectra({file});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().problem.file, file);
  EXPECT_EQ(bad.error().problem.line, 2);
  EXPECT_EQ(bad.error().problem.column, 5);
  EXPECT_EQ(bad.error().source, text);
  for (const std::string& other : {folder.write("empty.txt", ""), folder.file("."), std::string()})
    EXPECT_FALSE(load_spectra({other})) << other;
}

TEST(SpectraFiles, FaultsOfLightsAndPaints) {
  EXPECT_EQ(emission_fault({{500, 600}, {0, 1e300}}), "");
  EXPECT_EQ(emission_fault({{500, 600}, {1, -1e-300}}), "a light has no power below 0");
  EXPECT_EQ(reflectance_fault({{500, 600}, {0, 1}}), "");
  EXPECT_EQ(reflectance_fault({{500, 600}, {0, 1.5}}),
            "a reflectance lies in 0..1 (it is 1.5 at 600 nm)");
  EXPECT_NE(reflectance_fault({{500}, {std::numeric_limits<double>::quiet_NaN()}}), "");
}

TEST(SpectraFiles, AFilesNameSaysItsFormat) {
  EXPECT_EQ(format_for("a.sp"), SpectrumFormat::cgats);
  EXPECT_EQ(format_for("folder.sp/a.txt"), SpectrumFormat::pairs);
  EXPECT_EQ(format_for("a.ti3"), SpectrumFormat::cgats);
  EXPECT_EQ(format_for(""), SpectrumFormat::pairs);
}

}  // namespace
}  // namespace metamer::client
