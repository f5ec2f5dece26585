#include "client/tools/spectra/spectrum_word.h"

#include <gtest/gtest.h>

#include "client/tools/spectra/spectra_files.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

TEST(SpectrumWord, SaysHowItsFileIsRead) {
  const TemporaryFolder folder;
  const std::string file = folder.write("lamp.csv", "x");
  const auto all = parse_spectrum_word(file + "#warm white@um@percent@clamp@emission@linear");
  ASSERT_TRUE(all) << all.error().message;
  EXPECT_TRUE(all->is_file);
  EXPECT_EQ(all->name, file);
  EXPECT_EQ(all->entry, "warm white");
  EXPECT_EQ(all->reading.unit, WavelengthUnit::um);
  EXPECT_EQ(all->reading.scale, Scale::percent);
  EXPECT_EQ(all->reading.as, Quantity::emission);
  EXPECT_TRUE(all->reading.clamp);
  EXPECT_EQ(all->interpolation, Interpolation::linear);

  const auto some = parse_spectrum_word(file + "@1@nm");
  ASSERT_TRUE(some);
  EXPECT_EQ(some->name, file);
  EXPECT_FALSE(some->entry);
  EXPECT_EQ(some->reading.scale, Scale::one);
  EXPECT_EQ(some->reading.unit, WavelengthUnit::nm);
}

TEST(SpectrumWord, ThatIsAFilesNameIsThatFile) {
  const TemporaryFolder folder;
  for (const char* name : {"a@um", "a#b", "a#b@2x.csv", "@clamp", "1"}) {
    const std::string file = folder.write(name, "x");
    const auto word = parse_spectrum_word(file);
    ASSERT_TRUE(word);
    EXPECT_TRUE(word->is_file);
    EXPECT_EQ(word->name, file);
    EXPECT_FALSE(word->entry);
    EXPECT_FALSE(word->reading.unit);
    EXPECT_FALSE(word->reading.clamp);
  }
  // Nearer words of the other kind belong to it.
  const auto entry = parse_spectrum_word(folder.file("a#b@2x.csv") + "#c@d@um");
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->name, folder.file("a#b@2x.csv"));
  EXPECT_EQ(entry->entry, "c@d");
  EXPECT_EQ(entry->reading.unit, WavelengthUnit::um);
}

TEST(SpectrumWord, OfNoFileIsAName) {
  for (const char* name : {"D65", "D:6504K", "2856K", "436nm:0.6+546.1nm", "TCS09"}) {
    const auto word = parse_spectrum_word(name);
    ASSERT_TRUE(word) << name;
    EXPECT_FALSE(word->is_file) << name;
    EXPECT_EQ(word->name, name);
  }
}

TEST(SpectrumWord, NamesTheWordsThatItDoesNotKnow) {
  const TemporaryFolder folder;
  const std::string file = folder.write("lamp.csv", "x");
  const auto unknown = parse_spectrum_word(file + "@percnt@um");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("did you mean \"percent\""), std::string::npos)
      << unknown.error().message;
  const auto none = parse_spectrum_word("D65@um");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "there is no file \"D65\", of which \"@um\" says how it is read");
}

TEST(SpectrumWord, GoesBeforeWhatIsSaidOfAllFiles) {
  const TemporaryFolder folder;
  const std::string gold = folder.write("gold.txt", "0.4 50\n0.5 60\n0.6 70\n");
  const SpectrumChoice choice{.reading = {.unit = WavelengthUnit::nm}, .use = Use::property};
  const auto one = load_one(gold + "@um@percent@linear", choice);
  ASSERT_TRUE(one) << one.error().problem.message;
  EXPECT_EQ(one->samples.nm, (std::vector<double>{400, 500, 600}));
  EXPECT_EQ(one->samples.values, (std::vector<double>{0.5, 0.6, 0.7}));
  EXPECT_TRUE(one->notes.empty());
}

}  // namespace
}  // namespace metamer::client
