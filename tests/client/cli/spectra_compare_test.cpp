// `metamer spectra compare`, and what the commands of spectra say of files as people have them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "common/scene/files.h"
#include "tests/client/cli/said.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::cli {
namespace {

using Json = nlohmann::ordered_json;

TEST(SpectraCompare, NamesThePaintThatMatches) {
  const client::TemporaryFolder folder;
  const std::string fabrics =
      folder.write("fabrics.csv",
                   "Wavelength [nm];Wool [%];Linen [%]\n400;20;5,5\n500;30;30\n"
                   "600;40;60\n700;50;70\n");
  const std::string sample = folder.write("sample.txt", "400 0.2\n500 0.31\n600 0.4\n700 0.5\n");
  const std::string swatches = folder.file("swatches.png");
  const Said said = say({"spectra", "compare", sample, fabrics, "--under", "D65,2856K,D:5003K,F11",
                         "-o", swatches, "-o", folder.file("table.csv"), "--json"});
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  const Json answer = said.json();
  ASSERT_EQ(answer["candidates"].size(), 2U);
  EXPECT_EQ(answer["candidates"][0]["under"].size(), 4U);
  EXPECT_EQ(answer["nearest"], fabrics + ": Wool");
  EXPECT_LT(answer["candidates"][0]["worst"]["de00"].get<double>(), 3);
  EXPECT_GT(answer["candidates"][1]["worst"]["de00"].get<double>(), 10);
  EXPECT_NEAR(answer["candidates"][1]["under"][0]["metamerism_de00"].get<double>(), 0, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(swatches));
  const auto table = read_file(folder.file("table.csv"), 1 << 20);
  ASSERT_TRUE(table);
  EXPECT_EQ(std::count(table->begin(), table->end(), '\n'), 1 + 2 * 4);
  EXPECT_EQ(table->substr(0, 20), "candidate,light,de00");

  EXPECT_EQ(say({"spectra", "compare", sample, fabrics, "--max", "3"}).code, ExitCode::done);
  const Said over = say({"spectra", "compare", sample, fabrics, "--max", "0.01"});
  EXPECT_EQ(over.code, ExitCode::other);
  EXPECT_NE(over.out.find("is nearest to"), std::string::npos);
}

TEST(SpectraCompare, SaysWhatItCannotCompare) {
  const client::TemporaryFolder folder;
  const std::string paint = folder.write("a.txt", "400 0.2\n700 0.5\n");
  EXPECT_EQ(say({"spectra", "compare", paint}).code, ExitCode::bad_input);
  EXPECT_EQ(say({"spectra", "compare", paint, "TCS99"}).code, ExitCode::bad_input);
  EXPECT_EQ(say({"spectra", "compare", paint, "D65"}).code, ExitCode::bad_input);
  EXPECT_EQ(say({"spectra", "compare", paint, "TCS01", "--under", "TCS09"}).code,
            ExitCode::bad_input);
  EXPECT_EQ(say({"spectra", "compare", paint, "TCS01", "--under", "D66"}).code,
            ExitCode::bad_input);
  EXPECT_EQ(say({"spectra", "compare", paint, "TCS01", "-o", "a.exr"}).code, ExitCode::bad_input);
  EXPECT_EQ(say({"spectra", "compare", paint, "TCS01", "--as", "emission"}).code,
            ExitCode::bad_input);
}

TEST(SpectraCompare, RefusesWhatIsNoNumber) {
  for (const char* limit : {"nan", "NaN", "-nan", "-1", "x", ""}) {
    const Said said = say({"spectra", "compare", "TCS01", "TCS02", "--max", limit});
    EXPECT_EQ(said.code, ExitCode::bad_input) << limit;
    EXPECT_NE(said.err.find("--max"), std::string::npos) << said.err;
    EXPECT_LT(said.err.size(), 200U) << said.err;
  }
}

TEST(SpectraCompare, SaysWhatItTookItsLightsFor) {
  const client::TemporaryFolder folder;
  const std::string lamps = folder.write("lamps.csv", "um;warm;cold\n0,4;-1;5\n0,5;2;4\n0,6;5;2\n");
  const Said said =
      say({"spectra", "compare", "TCS01", "TCS02", "--under", "D65," + lamps + "#warm@clamp"});
  EXPECT_EQ(said.code, ExitCode::done) << said.err;
  EXPECT_NE(said.err.find("1 of 3 values were below 0 and are clamped"), std::string::npos)
      << said.err;
}

TEST(SpectraCompare, RefusesLightsWhoseSumsAreLost) {
  const client::TemporaryFolder folder;
  for (const char* power : {"1e308", "1e-310"}) {
    const std::string p = power;
    const std::string lamp =
        folder.write("lamp.txt", "400 " + p + "\n500 " + p + "\n600 " + p + "\n700 " + p + "\n");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"spectra", "compare", "TCS01", "TCS02", "--under", lamp},
          {"spectra", "info", lamp},
          {"spectra", "info", "TCS01", "--under", lamp}}) {
      const Said said = say(words);
      EXPECT_EQ(said.code, ExitCode::bad_input) << power;
      EXPECT_NE(said.err.find(lamp + ":1"), std::string::npos) << said.err;
      EXPECT_NE(said.err.find("can be summed"), std::string::npos) << said.err;
    }
  }
}

TEST(SpectraCompare, TheReferenceIsNoCandidate) {
  const client::TemporaryFolder folder;
  const std::string fabrics = folder.write(
      "fab.csv",
      "nm;ref [%];near [%];far [%]\n400;20;21;50\n500;30;31;30\n600;50;51;20\n700;60;61;10\n");
  const Said said = say({"spectra", "compare", fabrics + "#ref", fabrics, "--json"});
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  EXPECT_EQ(said.json()["candidates"].size(), 2U);
  EXPECT_EQ(said.json()["nearest"], fabrics + ": near");
  EXPECT_EQ(say({"spectra", "compare", fabrics + "#ref", fabrics, "--max", "0.01"}).code,
            ExitCode::other);
  // Who asks for it by name has it.
  EXPECT_EQ(say({"spectra", "compare", fabrics + "#ref", fabrics + "#ref", "--json"})
                .json()["candidates"][0]["worst"]["de00"],
            0);
}

TEST(SpectraCompare, SaysWhichIndexMIs) {
  const Said said = say({"spectra", "compare", "TCS01", "TCS02", "--under", "A,D65"});
  EXPECT_NE(said.out.find("M: the metamerism index of dE00 against A"), std::string::npos)
      << said.out;
}

TEST(SpectraCompare, SaysWhereDataEndAndWhatIsALine) {
  const client::TemporaryFolder folder;
  const std::string paint = folder.write("paint.txt", "500 0.1\n600 0.5\n");
  const std::string lamp = folder.write("lamp.txt", "450 5\n650 5\n");
  const std::string line = folder.write("line.txt", "550 0.5\n");
  const std::string eye = folder.write("eye.csv", [] {
    std::string text;  // CIE 1931 by 50 nm, ended at 600 nm
    for (const char* row :
         {"400,0.01431,0.000396,0.06785", "450,0.3362,0.038,1.77211", "500,0.0049,0.323,0.272",
          "550,0.43345,0.99495,0.00875", "600,1.0622,0.631,0.0008"})
      text += row + std::string("\n");
    return text;
  }());
  const auto told = [](const std::vector<std::string>& words, const std::string& what) {
    const Said said = say(words);
    EXPECT_EQ(said.code, ExitCode::done) << said.err;
    EXPECT_NE(said.err.find(what), std::string::npos) << said.err;
  };
  const std::string beyond = "its data end at 500 and 600 nm: ", dark = "where it still has power";
  told({"spectra", "compare", paint, "TCS01", "--under", "D65"}, beyond);
  told({"spectra", "compare", "TCS01", paint, "--under", "D65"}, "of light \"D65\" lies beyond");
  told({"spectra", "info", paint}, beyond);
  told({"spectra", "rgb", paint}, beyond);
  told({"spectra", "compare", "TCS01", "TCS02", "--under", lamp}, dark);
  told({"spectra", "info", lamp}, dark);
  told({"spectra", "compare", "TCS01", "TCS02", "--under", line},
       "a line, as it has a single sample");
  told({"spectra", "info", "D65", "--observer", eye}, "where it still sees 100 % of its most");
  EXPECT_EQ(say({"spectra", "compare", "TCS01", "TCS02"}).err, "");
  EXPECT_EQ(say({"spectra", "info", "D65", "TCS01", "F11", "--observer", "cie-1964-10deg"}).err,
            "");
}

TEST(SpectraCompare, SaysWhatOfALightLooksLikeAPaint) {
  const client::TemporaryFolder folder;
  const auto err = [&](const std::string& text, const std::string& words = "") {
    const std::string file = folder.write("a.csv", text);
    return say({"spectra", "compare", "TCS01", "TCS02", "--under", file + words}).err;
  };
  const std::string percents = "nm;R [%]\n360;20\n500;30\n830;60\n";
  EXPECT_NE(err(percents).find("by its own words"), std::string::npos) << err(percents);
  EXPECT_EQ(err(percents, "@emission"), "");
  EXPECT_NE(err("nm;wool [%]\n360;20\n500;30\n830;60\n").find("though the file is in percents"),
            std::string::npos);
  EXPECT_NE(err("nm,a\n360,0.2\n500,0.3\n830,0.6\n").find("its values lie in 0..1"),
            std::string::npos);
  EXPECT_EQ(err("nm,a\n360,0\n500,1\n830,0\n"), "") << "normalised, as lamps are";
  EXPECT_NE(err("nm,reflectance\n360,0.2\n500,0.3\n830,0.6\n").find("by its own words"),
            std::string::npos);
}

TEST(SpectraInfo, SaysWhatAFileWasTakenFor) {
  const client::TemporaryFolder folder;
  const std::string percent = folder.write("percent.csv", "nm,R\n400,20\n500,50\n600,80\n");
  const Json guessed = say({"spectra", "info", percent, "--as", "reflectance", "--json"}).json();
  EXPECT_EQ(guessed["spectra"][0]["format"], "a table with commas");
  EXPECT_EQ(guessed["spectra"][0]["notes"][0], "taken for percents, as the file's values reach 80");
  EXPECT_EQ(guessed["spectra"][0]["max"], 0.8);
  const Json said =
      say({"spectra", "info", percent, "--as", "reflectance", "--scale", "percent", "--json"})
          .json();
  EXPECT_FALSE(said["spectra"][0].contains("notes"));

  const std::string gold = folder.write("gold.txt", "0.4 0.5\n0.5 0.6\n0.6 0.7\n");
  const Said unsaid = say({"spectra", "info", gold});
  EXPECT_EQ(unsaid.code, ExitCode::bad_input);
  EXPECT_NE(unsaid.err.find("look like µm"), std::string::npos) << unsaid.err;
  EXPECT_EQ(say({"spectra", "info", gold, "--unit", "um", "--json"}).json()["spectra"][0]["from"],
            400);

  const std::string noisy = folder.write("noisy.txt", "400 -0.01\n500 20\n600 30\n");
  EXPECT_EQ(say({"spectra", "info", noisy, "--clamp", "--json"}).json()["spectra"][0]["min"], 0);
}

}  // namespace
}  // namespace metamer::cli
