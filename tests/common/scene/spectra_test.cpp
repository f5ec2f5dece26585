#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "common/image/spectral_exr.h"
#include "common/scene/limits.h"
#include "common/scene/validate.h"
#include "common/spectral/cie.h"
#include "scene_text.h"

namespace metamer::test {
namespace {

/// Files from memory; counts how often each is read.
struct Files {
  std::map<std::string, std::string> files;
  std::map<std::string, int> reads;

  AssetReader reader() {
    return [this](const std::string& name) -> Result<std::string> {
      ++reads[name];
      const auto found = files.find(name);
      if (found == files.end()) return problem("file \"" + name + "\" is not there");
      return found->second;
    };
  }
};

const char* const two_reds =
    "SPECT\nSPECTRAL_START_NM 400\nSPECTRAL_END_NM 700\nSPECTRAL_BANDS 4\n"
    "NUMBER_OF_FIELDS 5\nNUMBER_OF_SETS 2\n"
    "BEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_500 SPEC_600 SPEC_700\nEND_DATA_FORMAT\n"
    "BEGIN_DATA\nred 0.1 0.1 0.7 0.8\nwine 0.1 0 0.3 0.4\nEND_DATA\n";

/// A reflectance of 0.25 at the left and 0.75 at the right, and more than 1 below.
std::string two_swatches() {
  SpectralImage image;
  image.width = image.height = 2;
  image.reflectance = true;
  image.nm = {400, 500, 600, 700};
  for (const float value : {0.25F, 0.75F, 1.5F, 1.5F})
    image.values.insert(image.values.end(), 4, value);
  const auto file = std::filesystem::temp_directory_path() / "metamer-two-swatches.exr";
  EXPECT_TRUE(write_spectral_exr(image, make_image(2, 2, {"X", "Y", "Z"}), file, {}));
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  std::filesystem::remove(file);
  return bytes;
}

v1::Spectrum from_file(const std::string& name, const std::string& entry = {}) {
  v1::Spectrum message;
  message.set_file(name);
  message.set_entry(entry);
  return message;
}

std::string error_of(const v1::Spectrum& message, SpectrumRole role, Files files = {}) {
  const auto spectrum = load_spectrum(message, "m", role, files.reader());
  return spectrum ? std::string() : spectrum.error().field + ": " + spectrum.error().message;
}

Strings light_spectrum(const std::string& text) {
  return findings({.light = "light { position { } spectrum { " + text + " } }"});
}

Strings diffuse(const std::string& text) {
  return findings({.material = "material { name: \"grey\" diffuse { " + text + " } }"});
}

TEST(SceneSpectrum, ConstantsHoldOverAllThatCanBeSampled) {
  v1::Spectrum message;
  message.set_constant(0.25);
  const auto spectrum = load_spectrum(message, "m", SpectrumRole::emission, Files().reader());
  ASSERT_TRUE(spectrum);
  const Resampled resampled =
      resample(*spectrum, {limits::min_wavelength, 555, limits::max_wavelength}, Outside::zero);
  EXPECT_EQ(resampled.values, std::vector<double>({0.25, 0.25, 0.25}));
  EXPECT_EQ(resampled.below + resampled.above, 0u);
}

TEST(SceneSpectrum, StandardsAreTheTables) {
  v1::Spectrum message;
  message.set_standard("F11");
  const auto spectrum = load_spectrum(message, "m", SpectrumRole::emission, Files().reader());
  ASSERT_TRUE(spectrum);
  EXPECT_EQ(*spectrum, *cie::illuminant("F11"));
}

TEST(SceneSpectrum, SamplesAreTakenAsWritten) {
  v1::Spectrum message;
  for (const double nm : {400.0, 500.0}) message.mutable_samples()->add_wavelength(nm);
  for (const double value : {0.5, 1.0}) message.mutable_samples()->add_value(value);
  const auto spectrum = load_spectrum(message, "m", SpectrumRole::property, Files().reader());
  ASSERT_TRUE(spectrum);
  EXPECT_EQ(spectrum->nm, std::vector<double>({400, 500}));
  EXPECT_EQ(spectrum->values, std::vector<double>({0.5, 1}));
}

TEST(SceneSpectrum, FilesGiveTheEntryThatIsNamed) {
  Files files{.files = {{"reds.sp", two_reds}}, .reads = {}};
  const auto spectrum =
      load_spectrum(from_file("reds.sp", "wine"), "m", SpectrumRole::property, files.reader());
  ASSERT_TRUE(spectrum);
  EXPECT_EQ(spectrum->values, std::vector<double>({0.1, 0, 0.3, 0.4}));
}

TEST(SceneSpectrum, ErrorsInFilesKeepTheirPlace) {
  Files files{.files = {{"bad.txt", "400 0.5\n500 x\n"}}, .reads = {}};
  const auto spectrum =
      load_spectrum(from_file("bad.txt"), "m", SpectrumRole::property, files.reader());
  ASSERT_FALSE(spectrum);
  EXPECT_EQ(spectrum.error().field, "m.file");
  EXPECT_EQ(spectrum.error().file, "bad.txt");
  EXPECT_EQ(spectrum.error().line, 2);
  EXPECT_EQ(spectrum.error().column, 5);
}

TEST(SceneSpectrum, ErrorsAboutFilesStandAtTheirField) {
  const Files reds{.files = {{"reds.sp", two_reds}, {"dark.txt", "400 0\n500 0\n"}}, .reads = {}};
  EXPECT_EQ(error_of(from_file("reds.sp", "wien"), SpectrumRole::property, reds).substr(0, 9),
            "m.entry: ");
  EXPECT_EQ(error_of(from_file("reds.sp"), SpectrumRole::property, reds).substr(0, 8), "m.file: ");
  EXPECT_EQ(error_of(from_file("x.sp"), SpectrumRole::property, reds),
            "m.file: file \"x.sp\" is not there");
  EXPECT_EQ(error_of(from_file("dark.txt"), SpectrumRole::emission, reds),
            "m.file: \"dark.txt\" is 0 at every wavelength");
  EXPECT_EQ(error_of(from_file("dark.txt"), SpectrumRole::property, reds), "");
}

TEST(SceneSpectrum, ValuesInFilesMustSuitTheirRole) {
  const Files files{.files = {{"loud.txt", "400 0.5\n500 1.25\n"}, {"neg.txt", "400 1\n500 -2\n"}},
                    .reads = {}};
  EXPECT_EQ(
      error_of(from_file("loud.txt"), SpectrumRole::property, files),
      "m.file: \"loud.txt\": a reflectance must lie in 0..1 (it is 1.25 at 500 nm): above 1 is "
      "fluorescence, which clamp leaves out and Material.fluorescence models, or another scale");
  EXPECT_EQ(error_of(from_file("loud.txt"), SpectrumRole::emission, files), "");
  EXPECT_EQ(
      error_of(from_file("neg.txt"), SpectrumRole::emission, files),
      "m.file: \"neg.txt\": an emission must not be negative (it is -2 at 500 nm); clamp makes "
      "noise below 0 to 0");
}

TEST(SceneObserver, IsTheCiesOrThatOfItsFile) {
  Files files{.files = {{"eye.csv", "nm,x,y,z\n400,0,0.5,1\n700,1,0.5,0\n"}}, .reads = {}};
  v1::Settings settings;
  EXPECT_EQ(*load_observer(settings, "settings", files.reader()), cie::observer_1931());
  settings.set_observer(v1::CIE_1964_10DEG);
  EXPECT_EQ(*load_observer(settings, "settings", files.reader()), cie::observer_1964());
  settings.clear_observer();
  settings.set_observer_file("eye.csv");
  const auto own = load_observer(settings, "settings", files.reader());
  ASSERT_TRUE(own);
  EXPECT_EQ(own->name(), "eye.csv");
  EXPECT_EQ(own->functions()[2].values, std::vector<double>({1, 0}));
}

TEST(SceneObserver, ThatIsWrongIsLocatedInItsFile) {
  Files files{.files = {{"eye.csv", "400,0,0.5,1\n700,1,-0.5,0\n"}}, .reads = {}};
  v1::Scene scene;
  scene.mutable_settings()->set_observer_file("eye.csv");
  auto problems = validate_spectra(scene, files.reader());
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].field, "settings.observer_file");
  EXPECT_EQ(format(problems[0]),
            "eye.csv: error: settings.observer_file: is no observer: ȳ must not be negative (it is "
            "-0.5 at 700 nm)");
  scene.mutable_settings()->set_observer_file("none.csv");
  problems = validate_spectra(scene, files.reader());
  EXPECT_EQ(describe(problems), Strings{"settings.observer_file: file \"none.csv\" is not there"});
}

TEST(SceneObserver, IsTheCiesOrOnesOwnAndNotBoth) {
  EXPECT_EQ(findings({.settings = "settings { observer_file: 'eye.csv' }"}), Strings{});
  EXPECT_EQ(
      findings({.settings = "settings { observer: CIE_1964_10DEG observer_file: 'eye.csv' }"}),
      Strings{"settings.observer_file: an observer_file takes the place of observer, which is "
              "given too: leave out one"});
}

TEST(SceneSpectrum, SourcesThatAreWrongByThemselves) {
  EXPECT_EQ(light_spectrum(""),
            Strings({"light[0].spectrum: spectrum needs a standard, a file, a constant, samples, "
                     "sunlight or lines"}));
  EXPECT_EQ(diffuse(""), Strings({"material[0].diffuse: spectrum needs a standard, a file, a "
                                  "constant or samples"}));
  EXPECT_EQ(light_spectrum("standard: \"d65\""),
            Strings({"light[0].spectrum.standard: \"d65\" is not a standard illuminant; did you "
                     "mean \"D65\"?"}));
  EXPECT_EQ(light_spectrum("file: \"\""),
            Strings({"light[0].spectrum.file: file must not be empty"}));
  EXPECT_EQ(light_spectrum("constant: -1"),
            Strings({"light[0].spectrum.constant: an emission must not be negative (it is -1)"}));
  EXPECT_EQ(light_spectrum("constant: 0"),
            Strings({"light[0].spectrum.constant: an emission must not be 0 at every "
                     "wavelength"}));
  EXPECT_EQ(light_spectrum("constant: 1 entry: \"x\""),
            Strings({"light[0].spectrum.entry: entry is for spectra from a file"}));
  EXPECT_EQ(diffuse("standard: \"A\""),
            Strings({"material[0].diffuse.standard: a standard illuminant is an emission, not a "
                     "property"}));
  EXPECT_EQ(diffuse("constant: 1.5"),
            Strings({"material[0].diffuse.constant: a property must lie in 0..1 (it is 1.5)"}));
}

TEST(SceneSpectrum, SamplesThatAreWrong) {
  EXPECT_EQ(diffuse("samples { }"),
            Strings({"material[0].diffuse.samples: samples need at least one wavelength"}));
  EXPECT_EQ(diffuse("samples { wavelength: [400, 500] value: 1 }"),
            Strings({"material[0].diffuse.samples.value: samples need as many values as "
                     "wavelengths (1 values, 2 wavelengths)"}));
  EXPECT_EQ(diffuse("samples { wavelength: [500, 400, 400] value: [1, 1, 1] }"),
            Strings({"material[0].diffuse.samples.wavelength[1]: wavelengths must rise (400 comes "
                     "after 500)",
                     "material[0].diffuse.samples.wavelength[2]: wavelengths must not repeat (400 "
                     "is there twice)"}));
  EXPECT_EQ(diffuse("samples { wavelength: [400, 500] value: [0.5, 1.5] }"),
            Strings({"material[0].diffuse.samples.value[1]: a property must lie in 0..1 (it is "
                     "1.5 at 500 nm)"}));
  EXPECT_EQ(light_spectrum("samples { wavelength: [400, 500] value: [0, 0] }"),
            Strings({"light[0].spectrum.samples.value: an emission must not be 0 at every "
                     "wavelength"}));
}

TEST(SceneSpectra, EveryFileIsReadOnceAndEveryProblemFound) {
  v1::Scene scene;
  *scene.add_light()->mutable_spectrum() = from_file("neg.txt");
  *scene.add_material()->mutable_diffuse() = from_file("reds.sp", "red");
  *scene.add_material()->mutable_diffuse() = from_file("reds.sp", "wine");
  *scene.add_material()->mutable_specular() = from_file("gone.sp", "a");
  *scene.add_material()->mutable_specular() = from_file("gone.sp", "b");
  Files files{.files = {{"reds.sp", two_reds}, {"neg.txt", "400 1\n500 -2\n"}}, .reads = {}};
  EXPECT_EQ(
      describe(validate_spectra(scene, files.reader())),
      Strings(
          {"light[0].spectrum.file: \"neg.txt\": an emission must not be negative (it is -2 at 500 "
           "nm); clamp makes noise below 0 to 0",
           "material[2].specular.file: file \"gone.sp\" is not there"}));
  EXPECT_EQ(files.reads,
            (std::map<std::string, int>{{"gone.sp", 1}, {"neg.txt", 1}, {"reds.sp", 1}}));
}

v1::Spectrum read_as(const std::string& name, const std::string& reading) {
  v1::Spectrum message = from_file(name);
  google::protobuf::TextFormat::ParseFromString(reading, message.mutable_reading());
  return message;
}

TEST(SceneSpectrum, OfAFileIsReadAsTheSceneSays) {
  Files files{{{"percent.csv", "nm;R\n400;20\n500;50\n600;80\n"},
               {"noisy.txt", "400 -0.25\n500 3\n600 4\n"},
               {"gold.txt", "0.4 1.5\n0.5 1\n0.6 0.25\n"}},
              {}};
  const auto values = [&](const v1::Spectrum& message, SpectrumRole role) {
    const auto read = load_spectrum(message, "m", role, files.reader());
    return read ? read->values : std::vector<double>{};
  };
  EXPECT_EQ(values(read_as("percent.csv", "scale: PERCENT"), SpectrumRole::property),
            (std::vector<double>{0.2, 0.5, 0.8}));
  EXPECT_EQ(values(read_as("noisy.txt", "clamp: true"), SpectrumRole::emission),
            (std::vector<double>{0, 3, 4}));
  const auto gold =
      load_spectrum(read_as("gold.txt", "unit: UM"), "m", SpectrumRole::index, files.reader());
  ASSERT_TRUE(gold);
  EXPECT_EQ(*gold, (Spectrum{{400, 500, 600}, {1.5, 1, 0.25}}));

  EXPECT_EQ(error_of(read_as("percent.csv", "scale: ONE"), SpectrumRole::property, files),
            "m.file: \"percent.csv\": a reflectance must lie in 0..1 (it is 20 at 400 nm): above 1 "
            "is fluorescence, which clamp leaves out and Material.fluorescence models, or another "
            "scale");
  EXPECT_EQ(
      error_of(from_file("noisy.txt"), SpectrumRole::emission, files),
      "m.file: \"noisy.txt\": an emission must not be negative (it is -0.25 at 400 nm); clamp "
      "makes noise below 0 to 0");
  EXPECT_EQ(
      error_of(from_file("gold.txt"), SpectrumRole::index, files),
      "m.file: wavelengths from 0.4 to 0.6 look like µm; say in which unit they are (um or nm)");
  EXPECT_EQ(error_of(read_as("percent.csv", "as: EMISSION"), SpectrumRole::property, files),
            "m.file: \"percent.csv\": it is an emission, and a reflectance or transmittance is "
            "needed");
}

TEST(SceneSpectrum, TellsWhatItGuessedOfAFile) {
  Files files{{{"percent.csv", "nm;R\n400;20\n500;50\n600;80\n"}}, {}};
  const auto noted =
      load_noted_spectrum(from_file("percent.csv"), "m", SpectrumRole::property, files.reader());
  ASSERT_TRUE(noted);
  EXPECT_EQ(noted->spectrum.values, (std::vector<double>{0.2, 0.5, 0.8}));
  EXPECT_EQ(noted->notes,
            std::vector<std::string>{
                "\"percent.csv\": taken for percents, as the file's values reach 80"});
}

TEST(SceneSpectrum, ReadingIsForFilesAlone) {
  EXPECT_EQ(diffuse("constant: 0.5 reading { clamp: true }"),
            Strings({"material[0].diffuse.reading: reading is for spectra from a file"}));
}

TEST(SceneSpectrum, LightsAreNamedByTemperature) {
  EXPECT_EQ(light_spectrum("standard: \"D:6504K\""), Strings());
  EXPECT_EQ(light_spectrum("standard: \"2856K\""), Strings());
  EXPECT_EQ(light_spectrum("standard: \"D:3000K\""),
            Strings({"light[0].spectrum.standard: \"D:3000K\" is out of range: daylight may have "
                     "4000 to 25000 K"}));
}

TEST(PicturesSpectra, APixelIsAnEntry) {
  Files files{{{"swatches.exr", two_swatches()}}, {}};
  const auto load = [&](const std::string& entry, SpectrumRole role = SpectrumRole::property) {
    return load_spectrum(from_file("swatches.exr", entry), "m.diffuse", role, files.reader());
  };
  EXPECT_EQ(load("1x0")->values, std::vector<double>(4, 0.75));
  EXPECT_EQ(load("0x0-1x0")->values, std::vector<double>(4, 0.5));
  const auto above = load("0x1");
  ASSERT_FALSE(above);
  EXPECT_EQ(above.error().field, "m.diffuse.file");
  EXPECT_NE(above.error().message.find("a reflectance must lie in 0..1"), std::string::npos);
  const auto outside = load("2x0");
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().field, "m.diffuse.file");
  EXPECT_EQ(outside.error().message, "has no pixel there: it has 2 by 2");
  EXPECT_FALSE(load(""));
  // The file says that it is a reflectance.
  EXPECT_FALSE(load("0x0", SpectrumRole::emission));

  // Pixels of one file in one scene are told apart.
  v1::Scene scene;
  for (const char* entry : {"0x0", "0x1", "3x3"})
    *scene.add_material()->mutable_diffuse() = from_file("swatches.exr", entry);
  const auto problems = describe(validate_spectra(scene, files.reader()));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].substr(0, 24), "material[1].diffuse.file");
  EXPECT_EQ(problems[1].substr(0, 24), "material[2].diffuse.file");
}

}  // namespace
}  // namespace metamer::test
