// `metamer spectra`: what its commands print and write.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/spectral/cie.h"
#include "common/spectral/files/spectrum_file.h"
#include "tests/client/cli/said.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class Spectra : public testing::Test {
 protected:
  Spectra() {
    std::string pattern = (fs::temp_directory_path() / "metamer-spectra-XXXXXX").string();
    if (!mkdtemp(pattern.data())) ADD_FAILURE() << "no folder";
    folder_ = pattern;
  }
  ~Spectra() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }
  std::string contents(const std::string& name) const {
    std::ifstream stream(file(name), std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  Spectrum read(const std::string& name) const {
    const auto spectra = parse_spectra(contents(name), name);
    EXPECT_TRUE(spectra) << name;
    return spectra ? spectra->front().spectrum : Spectrum{{1}, {0}};
  }

  fs::path folder_;
};

TEST_F(Spectra, InfoOfAnIlluminantIsThePublishedOne) {
  const Said said = say({"spectra", "info", "F4", "--json"});
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  const Json light = said.json()["spectra"][0];
  EXPECT_EQ(light["kind"], "emission");
  EXPECT_EQ(light["from"], 380);
  EXPECT_EQ(light["to"], 780);
  EXPECT_EQ(light["samples"], 81);
  // ASTM E308's five digits, and CIE 15:2004, table T.8.
  EXPECT_NEAR(light["cie-1931-2deg"]["x"].get<double>(), 0.44018, 2e-5);
  EXPECT_NEAR(light["cie-1931-2deg"]["y"].get<double>(), 0.40329, 2e-5);
  EXPECT_NEAR(light["color_temperature"].get<double>(), 2940, 10);
  EXPECT_EQ(std::round(light["rendering"]["ra"].get<double>()), 51);
  EXPECT_GT(light["cie-1964-10deg"]["luminance"], 0);
}

TEST_F(Spectra, InfoOfABispectralMatrix) {
  const std::string sound =
      write("glow.csv", "excitation,420,440,500\n300,0,.001,0\n400,.002,.004,.001\n");
  const Said said = say({"spectra", "info", sound});
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  EXPECT_EQ(said.out, sound +
                          ": bispectral matrix\n"
                          "  excitation   300 to 400 nm, 2 wavelengths\n"
                          "  emission     420 to 500 nm, 3 wavelengths\n"
                          "  values       up to 0.004 per nm\n"
                          "  re-radiates  at most 0.21 of what comes, of light of 400 nm\n");
  const Json both = say({"spectra", "info", sound, "D65", "--json"}).json()["spectra"];
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0]["kind"], "bispectral matrix");
  EXPECT_EQ(both[1]["kind"], "emission");
  const Said wrong = say({"spectra", "info", write("w.csv", "excitation,420,440\n300,0,x\n")});
  EXPECT_EQ(wrong.code, ExitCode::bad_input);
  EXPECT_NE(wrong.err.find("w.csv:2:7: error: \"x\" is not a number"), std::string::npos)
      << wrong.err;
}

TEST_F(Spectra, InfoForPeople) {
  const Said said = say({"spectra", "info", write("grey.sp", "400 700 100\n0.5\n0.5\n0.5\n0.5\n")});
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  EXPECT_EQ(said.out, file("grey.sp") +
                          ": reflectance, read as uniform samples\n"
                          "  range        400 to 700 nm, 4 samples, straight lines between them\n"
                          "  values       0.5 to 0.5\n"
                          "  note         taken for a reflectance, as its values lie in 0..1\n"
                          "  luminance    0.5 of white under D65\n"
                          "  chromaticity x 0.31273, y 0.32903; u' 0.19784, v' 0.46834\n"
                          "  L*a*b*       76.07 0.00 0.00\n");
}

/// TCS09 by 20 nm, and without two of its samples.
const char* const even_red =
    "400 700 20\n0.052\n0.05\n0.046\n0.038\n0.03\n0.028\n0.031\n0.033\n0.041\n0.06\n0.19\n0.505\n"
    "0.717\n0.781\n0.809\n0.828\n";
const char* const uneven_red =
    "400 0.052\n420 0.05\n440 0.046\n480 0.03\n500 0.028\n520 0.031\n540 0.033\n560 0.041\n600 "
    "0.19\n620 0.505\n640 0.717\n660 0.781\n680 0.809\n700 0.828\n";

TEST_F(Spectra, InfoNamesTheInterpolationAndSeesByIt) {
  // numpy over 0.05 nm: x̄, ȳ, z̄ and the curves by Sprague's and Steffen's formulas at 1 nm.
  struct Row {
    const char *text, *asked, *interpolation;
    double luminance, l, a, b;
  };
  for (const Row& row :
       {Row{even_red, "", "sprague", 0.131994, 43.0621, 54.6707, 32.5128},
        Row{even_red, "linear", "linear", 0.134448, 43.4260, 54.3543, 33.1820},
        Row{uneven_red, "", "monotone-cubic", 0.133803, 43.3308, 54.1715, 33.0236},
        Row{uneven_red, "linear", "linear", 0.139992, 44.2318, 53.5784, 34.5627}}) {
    std::vector<std::string> words = {"spectra", "info", write("red.txt", row.text),
                                      "--under", "F11",  "--json"};
    if (*row.asked) words.insert(words.end(), {"--interpolation", row.asked});
    const Said said = say(words);
    ASSERT_EQ(said.code, ExitCode::done) << said.err;
    const Json red = said.json()["spectra"][0];
    EXPECT_EQ(red["interpolation"], row.interpolation);
    EXPECT_NEAR(red["luminance"].get<double>(), row.luminance, 2e-6) << row.interpolation;
    EXPECT_NEAR(red["lab"][0].get<double>(), row.l, 5e-4) << row.interpolation;
    EXPECT_NEAR(red["lab"][1].get<double>(), row.a, 5e-4) << row.interpolation;
    EXPECT_NEAR(red["lab"][2].get<double>(), row.b, 5e-4) << row.interpolation;
  }
  EXPECT_NE(say({"spectra", "info", write("red.txt", even_red)})
                .out.find("16 samples, Sprague's interpolation between them"),
            std::string::npos);
  EXPECT_EQ(say({"spectra", "info", "TCS09", "--json"}).json()["spectra"][0]["interpolation"],
            "linear");
}

TEST_F(Spectra, InterpolationThatCannotBeIsRefused) {
  const std::string red = write("red.txt", uneven_red);
  const Said said = say({"spectra", "info", red, "--interpolation", "sprague"});
  EXPECT_EQ(said.code, ExitCode::bad_input);
  EXPECT_EQ(said.err,
            "error: " + red +
                ": Sprague's interpolation takes samples at even distances; 420 nm is not "
                "at one\n");
}

TEST_F(Spectra, ConvertAndNormalizeWriteTheSamplesThatWereRead) {
  const std::string red = write("red.txt", even_red);
  ASSERT_EQ(say({"spectra", "convert", red, "-o", file("red.sp")}).code, ExitCode::done);
  EXPECT_EQ(read("red.sp"), read("red.txt"));
  ASSERT_EQ(say({"spectra", "normalize", red, "--as", "emission", "-o", file("light.txt")}).code,
            ExitCode::done);
  EXPECT_EQ(read("light.txt").nm, read("red.txt").nm);
}

TEST_F(Spectra, ResamplingTakesTheCurve) {
  // A polynomial of the fourth degree is Sprague's own; below 360 nm, too.
  std::string text = "300 420 10\n";
  const auto quartic = [](double nm) {
    const double x = (nm - 360) / 60;
    return 0.5 + x * (0.1 + x * (0.2 + x * (-0.1 - x * 0.1)));
  };
  for (int nm = 300; nm <= 420; nm += 10) text += number_text(quartic(nm)) + "\n";
  ASSERT_EQ(say({"spectra", "resample", write("coarse.txt", text), "--samples", "340:380:4", "-o",
                 file("fine.txt")})
                .code,
            ExitCode::done);
  const Spectrum made = read("fine.txt");
  for (std::size_t i = 0; i < made.nm.size(); ++i)
    EXPECT_NEAR(made.values[i], quartic(made.nm[i]), 1e-12) << made.nm[i];
}

TEST_F(Spectra, AsSaysWhatAFileIs) {
  std::vector<std::string> words = {"spectra", "info", write("a.txt", "400 0.5\n700 0.5\n"),
                                    "--json"};
  EXPECT_EQ(say(words).json()["spectra"][0]["kind"], "reflectance");
  words.insert(words.end(), {"--as", "emission"});
  EXPECT_EQ(say(words).json()["spectra"][0]["kind"], "emission");
  words.back() = "light";
  EXPECT_EQ(say(words).err,
            "--as: light not in {reflectance,transmittance,emission}\nRun with --help for more "
            "information.\n");
}

TEST_F(Spectra, ResamplingTellsASpikeThatItMisses) {
  const std::string spike = write("spike.txt", "400 1\n546 1\n547 301\n548 1\n700 1\n");
  const std::string unsaid =
      "note: a plain file does not say that it is an emission: --as says it where it is read, or "
      "write CGATS\n";
  const Said said =
      say({"spectra", "resample", spike, "--samples", "400:700:100", "-o", file("new.txt")});
  EXPECT_EQ(said.code, ExitCode::done);
  EXPECT_EQ(said.err, file("spike.txt") +
                          ": note: the new samples change its energy: 50 % of it is missed between "
                          "500 and 600 nm, 50 % of it is missed in all\n" +
                          unsaid);
  EXPECT_EQ(contents("new.txt"), "400 1\n500 1\n600 1\n700 1\n");

  EXPECT_EQ(
      say({"spectra", "resample", spike, "--wavelengths", "447,547,647", "-o", file("other.txt")})
          .err,
      file("spike.txt") + ": note: 16.7 % of its energy lies outside the new range\n" +
          file("spike.txt") +
          ": note: the new samples change its energy: 2.97e+03 % of it is added between "
          "447 and 547 nm, 5.94e+03 % of it is added in all\n" +
          unsaid);
}

TEST_F(Spectra, ResamplingSaysWhereThereAreNoData) {
  const Said said = say({"spectra", "resample", write("a.txt", "450 2\n700 2\n"), "--json",
                         "--samples", "400:700:50"});
  ASSERT_EQ(said.code, ExitCode::done);
  EXPECT_EQ(said.json()["notes"][0]["message"], "1 of 7 wavelengths lie outside its data: 0 there");
  EXPECT_EQ(said.json()["text"], "400 0\n450 2\n500 2\n550 2\n600 2\n650 2\n700 2\n");
}

TEST_F(Spectra, NormalizingGivesTheLuminanceUnderTheObserver) {
  for (const char* observer : {"cie-1931-2deg", "cie-1964-10deg"}) {
    ASSERT_EQ(say({"spectra", "normalize", "F11", "--observer", observer, "--luminance", "0.25",
                   "-o", file("f11.sp")})
                  .code,
              ExitCode::done);
    const Json info = say({"spectra", "info", file("f11.sp"), "--as", "emission", "--json"}).json();
    EXPECT_NEAR(info["spectra"][0][observer]["luminance"].get<double>(), 0.25, 1e-14);
  }
}

TEST_F(Spectra, RgbOfAWhiteUnderItsLightIsTheLights) {
  std::vector<std::string> words = {"spectra", "rgb",    write("white.txt", "500 1\n"),
                                    "F2",      "--json", "--under",
                                    "F2",      "--rgb",  "rec-2020"};
  const Json plain = say(words).json();
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(plain["spectra"][0]["linear"][c].get<double>(),
                plain["spectra"][1]["linear"][c].get<double>(), 1e-13);
  EXPECT_EQ(plain["spectra"][0]["in_gamut"], false) << "F2 is yellower than the space's white";

  words.insert(words.end(), {"--adapt", "bradford"});
  const Json adapted = say(words).json();
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(adapted["spectra"][0]["linear"][c].get<double>(), 1, 1e-12);
  EXPECT_EQ(adapted["spectra"][0]["in_gamut"], true);
}

TEST_F(Spectra, ConvertingKeepsEveryBit) {
  const Spectrum original = *cie::illuminant("F7");
  std::string from = "F7";
  for (const char* name : {"a.sp", "b.uniform", "c.pairs", "d.cmf"}) {
    std::vector<std::string> words = {"spectra", "convert", from, "-o", file(name)};
    if (std::string(name) == "b.uniform") words.insert(words.end(), {"--format", "uniform"});
    ASSERT_EQ(say(words).code, ExitCode::done) << name;
    EXPECT_EQ(read(name), original) << name;
    from = file(name);
  }
}

TEST_F(Spectra, MetamerMatchesUnderOneLightAndSaysHowItDiffers) {
  const Said said =
      say({"spectra", "metamer", "TCS05", "--against", "F11", "-o", file("other.sp"), "--json"});
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  double d65 = NAN, f11 = NAN;
  const Json document = said.json();
  for (const Json& one : document["differences"]) {
    if (one["light"] == "D65") d65 = one["de00"];
    if (one["light"] == "F11") f11 = one["de00"];
  }
  EXPECT_LT(d65, 1e-6);
  EXPECT_GT(f11, 5);

  // The file that was written is that reflectance.
  const Json colors =
      say({"spectra", "rgb", "TCS05", file("other.sp"), "--json"}).json()["spectra"];
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(colors[0]["xyz"][c].get<double>(), colors[1]["xyz"][c].get<double>(), 1e-12);
}

TEST_F(Spectra, PlotIsAPngWhateverANameHolds) {
  std::vector<std::string> words = {
      "spectra", "plot", "D65", "TCS09", write("it's\n'x' \\", "500 0.5\n"), "-o", file("a.png")};
  const Said said = say(words);
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  EXPECT_EQ(contents("a.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  words.back() = "a.pdf";
  EXPECT_EQ(say(words).err, "error: --output: \"a.pdf\" does not end in .png\n");
}

TEST_F(Spectra, BadInputIsLocated) {
  Said said = say({"spectra", "info", "D66"});
  EXPECT_EQ(said.code, ExitCode::bad_input);
  EXPECT_EQ(
      said.err,
      "error: there is no file, CIE illuminant or test colour \"D66\"; did you mean \"D65\"?\n");

  said = say({"spectra", "info", write("bad.txt", "400 1\n500 x\n")});
  EXPECT_EQ(said.code, ExitCode::bad_input);
  EXPECT_EQ(said.err.substr(0, file("bad.txt").size() + 12), file("bad.txt") + ":2:5: error:");

  EXPECT_EQ(say({"spectra", "resample", "D65"}).err,
            "error: say where: --samples FROM:TO:STEP or --wavelengths NM,NM,…\n");
  EXPECT_EQ(say({"spectra", "resample", "D65", "--samples", "400:700:0"}).code,
            ExitCode::bad_input);

  EXPECT_EQ(say({"spectra", "normalize", "TCS01"}).err,
            "error: \"TCS01\" is taken for a reflectance, which has no luminance of its own; --as "
            "emission says otherwise\n");

  said = say({"spectra", "metamer", write("white.txt", "500 1\n"), "-o", file("none.sp")});
  EXPECT_EQ(said.code, ExitCode::bad_input);
  EXPECT_FALSE(fs::exists(file("none.sp")));
}

TEST_F(Spectra, ANameFromAFileCannotCommandATerminal) {
  const std::string evil =
      write("evil.sp",
            "SPECT\nBEGIN_DATA_FORMAT\nSAMPLE_NAME SPEC_400 SPEC_700\nEND_DATA_FORMAT\n"
            "BEGIN_DATA\n\"a\x1b[2Jb\" 1 1\nEND_DATA\n");
  const Said said = say({"spectra", "info", evil});
  EXPECT_EQ(said.code, ExitCode::done);
  EXPECT_EQ(said.out.find('\x1b'), std::string::npos);
  EXPECT_NE(said.out.find("a?[2Jb"), std::string::npos);
}

TEST_F(Spectra, OneOfSeveralIsChosenByItsName) {
  const std::string both =
      write("two.sp",
            "SPECT\nNUMBER_OF_FIELDS 3\nBEGIN_DATA_FORMAT\nSAMPLE_NAME SPEC_400 "
            "SPEC_700\nEND_DATA_FORMAT\nNUMBER_OF_SETS 2\nBEGIN_DATA\n\"red\" 0 1\n"
            "\"blue\" 1 0\nEND_DATA\n");
  std::vector<std::string> words = {"spectra", "convert", both};
  EXPECT_EQ(say(words).err,
            "error: a plain file holds one spectrum, not 2: write CGATS, or choose one\n");
  words.insert(words.end(), {"--entry", "blue"});
  EXPECT_EQ(say(words).out, "400 1\n700 0\n");
  words.back() = "green";
  EXPECT_EQ(say(words).err,
            "error: \"" + both + "\" has no spectrum named \"green\"; it has \"red\", \"blue\"\n");
}

}  // namespace
}  // namespace metamer::cli
