// `metamer spectra`: what its commands print and write.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/cli/commands.h"
#include "common/spectral/cie.h"
#include "common/spectral/spectrum_file.h"

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

SpectraOptions input(const std::vector<std::string>& files, bool json = true) {
  SpectraOptions options;
  options.json = json;
  options.files = files;
  return options;
}

struct Said {
  ExitCode code;
  std::string out, err;
  Json json() const { return Json::parse(out); }
};

template <class Options>
Said say(ExitCode (*command)(const Options&), const Options& options) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const ExitCode code = command(options);
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST_F(Spectra, InfoOfAnIlluminantIsThePublishedOne) {
  const Said said = say(spectra_info, input({"F4"}));
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  const Json light = said.json()["spectra"][0];
  EXPECT_EQ(light["kind"], "emission");
  EXPECT_EQ(light["from"], 380);
  EXPECT_EQ(light["to"], 780);
  EXPECT_EQ(light["samples"], 81);
  // CIE 15:2004, table T.8.
  EXPECT_NEAR(light["cie-1931-2deg"]["x"].get<double>(), 0.4402, 2e-4);
  EXPECT_NEAR(light["cie-1931-2deg"]["y"].get<double>(), 0.4031, 2e-4);
  EXPECT_NEAR(light["color_temperature"].get<double>(), 2940, 10);
  EXPECT_EQ(std::round(light["rendering"]["ra"].get<double>()), 51);
  EXPECT_GT(light["cie-1964-10deg"]["luminance"], 0);
}

TEST_F(Spectra, InfoForPeople) {
  const Said said =
      say(spectra_info, input({write("grey.sp", "400 700 100\n0.5\n0.5\n0.5\n0.5\n")}, false));
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  EXPECT_EQ(said.out, file("grey.sp") +
                          ": reflectance\n"
                          "  range        400 to 700 nm, 4 samples\n"
                          "  values       0.5 to 0.5\n"
                          "  luminance    0.5 of white under D65\n"
                          "  chromaticity x 0.31274, y 0.32904; u' 0.19784, v' 0.46835\n"
                          "  L*a*b*       76.07 0.00 0.00\n");
}

TEST_F(Spectra, AsSaysWhatAFileIs) {
  SpectraOptions options = input({write("a.txt", "400 0.5\n700 0.5\n")});
  EXPECT_EQ(say(spectra_info, options).json()["spectra"][0]["kind"], "reflectance");
  options.kind = "emission";
  EXPECT_EQ(say(spectra_info, options).json()["spectra"][0]["kind"], "emission");
  options.kind = "light";
  EXPECT_EQ(say(spectra_info, options).err,
            "error: --as: \"light\" is neither emission nor reflectance\n");
}

TEST_F(Spectra, ResamplingTellsASpikeThatItMisses) {
  ResampleOptions options;
  options.input = input({write("spike.txt", "400 1\n546 1\n547 301\n548 1\n700 1\n")}, false);
  options.samples = "400:700:100";
  options.output.file = file("new.txt");
  const Said said = say(resample_spectra, options);
  EXPECT_EQ(said.code, ExitCode::done);
  EXPECT_EQ(said.err, file("spike.txt") +
                          ": note: the new samples change its energy: 50 % of it is missed between "
                          "500 and 600 nm, 50 % of it is missed in all\n");
  EXPECT_EQ(contents("new.txt"), "400 1\n500 1\n600 1\n700 1\n");

  options.samples.reset();
  options.wavelengths = "447,547,647";
  options.output.file = file("other.txt");
  EXPECT_EQ(say(resample_spectra, options).err,
            file("spike.txt") + ": note: 16.7 % of its energy lies outside the new range\n" +
                file("spike.txt") +
                ": note: the new samples change its energy: 2.97e+03 % of it is added between "
                "447 and 547 nm, 5.94e+03 % of it is added in all\n");
}

TEST_F(Spectra, ResamplingSaysWhereThereAreNoData) {
  ResampleOptions options;
  options.input = input({write("a.txt", "450 2\n700 2\n")});
  options.samples = "400:700:50";
  const Said said = say(resample_spectra, options);
  ASSERT_EQ(said.code, ExitCode::done);
  EXPECT_EQ(said.json()["notes"][0]["message"], "1 of 7 wavelengths lie outside its data: 0 there");
  EXPECT_EQ(said.json()["text"], "400 0\n450 2\n500 2\n550 2\n600 2\n650 2\n700 2\n");
}

TEST_F(Spectra, NormalizingGivesTheLuminanceUnderTheObserver) {
  for (const char* observer : {"cie-1931-2deg", "cie-1964-10deg"}) {
    NormalizeOptions options;
    options.input = input({"F11"});
    options.input.observer = observer;
    options.luminance = 0.25;
    options.output.file = file("f11.sp");
    ASSERT_EQ(say(normalize_spectra, options).code, ExitCode::done);
    SpectraOptions of_file = input({file("f11.sp")});
    of_file.kind = "emission";
    const Json info = say(spectra_info, of_file).json();
    EXPECT_NEAR(info["spectra"][0][observer]["luminance"].get<double>(), 0.25, 1e-14);
  }
}

TEST_F(Spectra, RgbOfAWhiteUnderItsLightIsTheLights) {
  SpectraRgbOptions options;
  options.input = input({write("white.txt", "500 1\n"), "F2"});
  options.input.under = "F2";
  options.development.rgb = "rec-2020";
  const Json plain = say(spectra_rgb, options).json();
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(plain["spectra"][0]["linear"][c].get<double>(),
                plain["spectra"][1]["linear"][c].get<double>(), 1e-13);
  EXPECT_EQ(plain["spectra"][0]["in_gamut"], false) << "F2 is yellower than the space's white";

  options.development.adaptation = "bradford";
  const Json adapted = say(spectra_rgb, options).json();
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(adapted["spectra"][0]["linear"][c].get<double>(), 1, 1e-12);
  EXPECT_EQ(adapted["spectra"][0]["in_gamut"], true);
}

TEST_F(Spectra, ConvertingKeepsEveryBit) {
  const Spectrum original = *cie::illuminant("F7");
  std::string from = "F7";
  for (const char* name : {"a.sp", "b.uniform", "c.pairs", "d.cmf"}) {
    ConvertOptions options;
    options.input = input({from});
    options.output.file = file(name);
    if (std::string(name) == "b.uniform") options.output.format = "uniform";
    ASSERT_EQ(say(convert_spectra, options).code, ExitCode::done) << name;
    EXPECT_EQ(read(name), original) << name;
    from = file(name);
  }
}

TEST_F(Spectra, MetamerMatchesUnderOneLightAndSaysHowItDiffers) {
  MetamerOptions options;
  options.input = input({"TCS05"});
  options.against = "F11";
  options.output.file = file("other.sp");
  const Said said = say(find_metamer, options);
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
  SpectraRgbOptions rgb;
  rgb.input = input({"TCS05", file("other.sp")});
  const Json colors = say(spectra_rgb, rgb).json()["spectra"];
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(colors[0]["xyz"][c].get<double>(), colors[1]["xyz"][c].get<double>(), 1e-12);
}

TEST_F(Spectra, PlotIsAPngWhateverANameHolds) {
  PlotSpectraOptions options;
  options.input = input({"D65", "TCS09", write("it's\n'x' \\", "500 0.5\n")}, false);
  options.file = file("a.png");
  const Said said = say(plot_spectra, options);
  ASSERT_EQ(said.code, ExitCode::done) << said.err;
  EXPECT_EQ(contents("a.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(say(plot_spectra,
                [&] {
                  auto other = options;
                  other.file = "a.pdf";
                  return other;
                }())
                .err,
            "error: --output: \"a.pdf\" does not end in .png\n");
}

TEST_F(Spectra, BadInputIsLocated) {
  Said said = say(spectra_info, input({"D66"}, false));
  EXPECT_EQ(said.code, ExitCode::bad_input);
  EXPECT_EQ(
      said.err,
      "error: there is no file, CIE illuminant or test colour \"D66\"; did you mean \"D65\"?\n");

  said = say(spectra_info, input({write("bad.txt", "400 1\n500 x\n")}, false));
  EXPECT_EQ(said.code, ExitCode::bad_input);
  EXPECT_EQ(said.err.substr(0, file("bad.txt").size() + 12), file("bad.txt") + ":2:5: error:");

  ResampleOptions nowhere;
  nowhere.input = input({"D65"}, false);
  EXPECT_EQ(say(resample_spectra, nowhere).err,
            "error: say where: --samples FROM:TO:STEP or --wavelengths NM,NM,…\n");
  nowhere.samples = "400:700:0";
  EXPECT_EQ(say(resample_spectra, nowhere).code, ExitCode::bad_input);

  NormalizeOptions paint;
  paint.input = input({"TCS01"}, false);
  EXPECT_EQ(say(normalize_spectra, paint).err,
            "error: \"TCS01\" is taken for a reflectance, which has no luminance of its own; --as "
            "emission says otherwise\n");

  MetamerOptions white;
  white.input = input({write("white.txt", "500 1\n")}, false);
  white.output.file = file("none.sp");
  said = say(find_metamer, white);
  EXPECT_EQ(said.code, ExitCode::bad_input);
  EXPECT_FALSE(fs::exists(file("none.sp")));
}

TEST_F(Spectra, ANameFromAFileCannotCommandATerminal) {
  const std::string evil =
      write("evil.sp",
            "SPECT\nBEGIN_DATA_FORMAT\nSAMPLE_NAME SPEC_400 SPEC_700\nEND_DATA_FORMAT\n"
            "BEGIN_DATA\n\"a\x1b[2Jb\" 1 1\nEND_DATA\n");
  const Said said = say(spectra_info, input({evil}, false));
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
  ConvertOptions options;
  options.input = input({both}, false);
  EXPECT_EQ(say(convert_spectra, options).err,
            "error: a plain file holds one spectrum, not 2: write CGATS, or choose one\n");
  options.input.entry = "blue";
  EXPECT_EQ(say(convert_spectra, options).out, "400 1\n700 0\n");
  options.input.entry = "green";
  EXPECT_EQ(say(convert_spectra, options).err,
            "error: \"" + options.input.files[0] + "\" has no spectrum named \"green\"\n");
}

}  // namespace
}  // namespace metamer::cli
