// CGATS files, through parse_spectra.
#include <gtest/gtest.h>

#include "common/spectral/files/spectrum_file.h"

namespace metamer {
namespace {

using Spectra = std::vector<NamedSpectrum>;

std::string error_of(const std::string& text) {
  const auto result = parse_spectra(text, "tcs.sp");
  return result ? "no error" : format(result.error());
}

Spectra read(const std::string& text) {
  auto result = parse_spectra(text, "tcs.sp");
  if (!result) ADD_FAILURE() << format(result.error());
  return result ? *result : Spectra{};
}

/// A file whose lines a test replaces one by one.
struct File {
  std::string start = "SPECTRAL_START_NM 400\n";
  std::string end = "SPECTRAL_END_NM 420\n";
  std::string bands = "SPECTRAL_BANDS 3\n";
  std::string fields = "NUMBER_OF_FIELDS 4\n";
  std::string sets = "NUMBER_OF_SETS 2\n";
  std::string format = "BEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_410 SPEC_420\nEND_DATA_FORMAT\n";
  std::string data = "BEGIN_DATA\nred 0.1 0.2 0.3\nblue 0.4 0.5 0.6\nEND_DATA\n";

  std::string text() const {
    return "SPECT\n" + start + end + bands + fields + sets + format + data;
  }
};

const std::vector<double> nm = {400, 410, 420};

TEST(Cgats, ReadsSeveralNamedSpectra) {
  const Spectra spectra = read(File().text());
  ASSERT_EQ(spectra.size(), 2U);
  EXPECT_EQ(spectra[0].name, "red");
  EXPECT_EQ(spectra[0].spectrum, (Spectrum{nm, {0.1, 0.2, 0.3}}));
  EXPECT_EQ(spectra[1].name, "blue");
  EXPECT_EQ(spectra[1].spectrum, (Spectrum{nm, {0.4, 0.5, 0.6}}));
}

TEST(Cgats, ReadsOverWhatItDoesNotUse) {
  File file;
  file.start = "CREATED \"a # b\" # when\nLGOROWLENGTH 12\nKEYWORD \"FOO\"\nFOO\n" + file.start;
  EXPECT_EQ(read(file.text()).size(), 2U);
}

TEST(Cgats, TakesQuotedNumbersAndNamesWithBlanks) {
  File file;
  file.bands = "SPECTRAL_BANDS\t\"3\"\n";
  file.data = "BEGIN_DATA\n\"dark red\" \"0.1\" 0.2 0.3\n\"\" 0.4 0.5 0.6\nEND_DATA\n";
  const Spectra spectra = read(file.text());
  ASSERT_EQ(spectra.size(), 2U);
  EXPECT_EQ(spectra[0].name, "dark red");
  EXPECT_EQ(spectra[0].spectrum.values[0], 0.1);
  EXPECT_EQ(spectra[1].name, "");
}

TEST(Cgats, TakesSetsThatRunOverSeveralLines) {
  File file;
  file.data = "BEGIN_DATA red 0.1\n0.2\n0.3 blue 0.4 0.5\n0.6 END_DATA\n";
  const Spectra spectra = read(file.text());
  ASSERT_EQ(spectra.size(), 2U);
  EXPECT_EQ(spectra[1].spectrum, (Spectrum{nm, {0.4, 0.5, 0.6}}));
}

TEST(Cgats, TakesOtherColumnsAnywhere) {
  File file;
  file.fields = "";
  file.format =
      "BEGIN_DATA_FORMAT SPEC_400 XYZ_X SPEC_410 SAMPLE_NAME SPEC_420 SAMPLE_ID END_DATA_FORMAT\n";
  file.data = "BEGIN_DATA 0.1 99 0.2 red 0.3 1  0.4 99 0.5 blue 0.6 2 END_DATA\n";
  const Spectra spectra = read(file.text());
  ASSERT_EQ(spectra.size(), 2U);
  EXPECT_EQ(spectra[1].name, "blue") << "a name goes before an id";
  EXPECT_EQ(spectra[1].spectrum, (Spectrum{nm, {0.4, 0.5, 0.6}}));
}

TEST(Cgats, DividesByTheNorm) {
  File file;
  file.sets += "SPECTRAL_NORM 100\n";
  file.data = "BEGIN_DATA\nred 10 20 30\nblue 40 50 60\nEND_DATA\n";
  EXPECT_EQ(read(file.text())[1].spectrum, (Spectrum{nm, {0.4, 0.5, 0.6}}));
}

TEST(Cgats, TakesPositionsFromTheColumnsWhereTheHeaderHasNone) {
  File file;
  file.start = file.end = file.bands = "";
  file.format = "BEGIN_DATA_FORMAT SAMPLE_ID nm400 nm410.5 nm420 END_DATA_FORMAT\n";
  EXPECT_EQ(read(file.text())[0].spectrum, (Spectrum{{400, 410.5, 420}, {0.1, 0.2, 0.3}}));
}

TEST(Cgats, TakesPositionsFromTheHeaderWhereNamesAreRounded) {
  File file;
  file.end = "SPECTRAL_END_NM 406.5\n";
  file.format = "BEGIN_DATA_FORMAT SAMPLE_ID SPEC_400 SPEC_403 SPEC_407 END_DATA_FORMAT\n";
  EXPECT_EQ(read(file.text())[0].spectrum.nm, (std::vector<double>{400, 403.25, 406.5}));
  // As colord writes its 1 nm table of illuminant A.
  file.format = "BEGIN_DATA_FORMAT SAMPLE_ID SPEC_400000 SPEC_403250 SPEC_406500 END_DATA_FORMAT\n";
  EXPECT_EQ(read(file.text())[0].spectrum.nm, (std::vector<double>{400, 403.25, 406.5}));
}

TEST(Cgats, ReadsOneBand) {
  File file;
  file.end = "SPECTRAL_END_NM 400\n";
  file.bands = "SPECTRAL_BANDS 1\n";
  file.fields = file.sets = "";
  file.format = "BEGIN_DATA_FORMAT SPEC_400 END_DATA_FORMAT\n";
  file.data = "BEGIN_DATA 0.5 END_DATA";
  EXPECT_EQ(read(file.text())[0].spectrum, (Spectrum{{400}, {0.5}}));
  file.end = "SPECTRAL_END_NM 410\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:3:17: error: one band can't reach from 400 to 410 nm");
}

TEST(Cgats, AddsTheSpectraOfASecondTable) {
  const std::string second =
      "NUMBER_OF_SETS 1\nBEGIN_DATA\ngreen 0.7 0.8 0.9\nEND_DATA\n"
      "NUMBER_OF_FIELDS 2\nNUMBER_OF_SETS 1\n"
      "BEGIN_DATA_FORMAT INDEX RGB_R END_DATA_FORMAT\nBEGIN_DATA 0 x END_DATA\n";
  const Spectra spectra = read(File().text() + second);
  ASSERT_EQ(spectra.size(), 3U);
  EXPECT_EQ(spectra[2].name, "green");
}

TEST(Cgats, FindsBandsThatLie) {
  File file;
  file.bands = "SPECTRAL_BANDS 4\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:4:16: error: SPECTRAL_BANDS is 4, but the data format has 3 spectral columns");
  file.bands = "SPECTRAL_BANDS 1e18\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:4:16: error: SPECTRAL_BANDS is 1e+18, but the data format has 3 spectral "
            "columns");
  file.bands = "SPECTRAL_BANDS 2.5\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:4:16: error: SPECTRAL_BANDS is 2.5, but the data format has 3 spectral "
            "columns");
  file.bands = "SPECTRAL_BANDS -3\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:4:16: error: SPECTRAL_BANDS must be above 0");
  file.bands = "SPECTRAL_BANDS many\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:4:16: error: \"many\" is not a number");
  file.bands = "SPECTRAL_BANDS\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:4:1: error: SPECTRAL_BANDS has no value");
}

TEST(Cgats, FindsAHeaderThatContradictsItselfOrTheColumns) {
  File file;
  file.end = "";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:2:19: error: SPECTRAL_START_NM, SPECTRAL_END_NM and SPECTRAL_BANDS belong "
            "together");
  file.end = "SPECTRAL_END_NM 380\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:8:20: error: \"SPEC_410\" stands where the header puts 390 nm");
  file.end = "SPECTRAL_END_NM 400\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:3:17: error: wavelength 400 is repeated");
  file.end = "SPECTRAL_END_NM 440\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:8:20: error: \"SPEC_410\" stands where the header puts 420 nm");
  file.end = "SPECTRAL_END_NM nan\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:3:17: error: \"nan\" is not a finite number");
}

TEST(Cgats, FindsCountsThatLie) {
  File file;
  file.fields = "NUMBER_OF_FIELDS 5\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:5:18: error: NUMBER_OF_FIELDS is 5, but the data format has 4");
  file.fields = "";
  file.sets = "NUMBER_OF_SETS 3\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:12:1: error: the data end after 2 sets, but NUMBER_OF_SETS is 3");
  file.sets = "NUMBER_OF_SETS 1\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:11:1: error: more data than NUMBER_OF_SETS, 1, stands for");
}

TEST(Cgats, FindsColumnsThatDoNotRise) {
  File file;
  file.start = file.end = file.bands = "";
  file.format = "BEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_420 SPEC_410\nEND_DATA_FORMAT\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:5:11: error: wavelengths must rise: 410 follows 420");
  file.format = "BEGIN_DATA_FORMAT\nSAMPLE_ID LAB_L LAB_A LAB_B\nEND_DATA_FORMAT\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:1:1: error: no spectrum: the data have no columns like SPEC_380");
}

TEST(Cgats, FindsWordsAndNonsenseAmongTheValues) {
  File file;
  file.data = "BEGIN_DATA\nred 0.1 0.2 0.3\nblue 0.4 x 0.6\nEND_DATA\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:12:10: error: \"x\" is not a number");
  file.data = "BEGIN_DATA\nred 0.1 nan 0.3\nblue 0.4 0.5 0.6\nEND_DATA\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:11:9: error: \"nan\" is not a finite number");
  file.data = "BEGIN_DATA\nred 0.1 1e308 0.3\nblue 0.4 0.5 0.6\nEND_DATA\n";
  file.sets += "SPECTRAL_NORM 0.01\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:12:9: error: \"1e308\" divided by SPECTRAL_NORM is not finite");
}

TEST(Cgats, FindsDataThatStopShort) {
  File file;
  file.data = "BEGIN_DATA\nred 0.1 0.2 0.3\nblue 0.4 0.5\nEND_DATA\n";
  EXPECT_EQ(error_of(file.text()),
            "tcs.sp:13:1: error: the data end after 3 of the 4 fields of a set");
  file.data = "BEGIN_DATA\nred 0.1 0.2 0.3\nblue 0.4 0.5";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:12:13: error: END_DATA is missing");
  file.data = "BEGIN_DATA\nred 0.1 0.2 0.3\nblue 0.4 0.5 0.6\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:13:1: error: END_DATA is missing");
  file.data = "BEGIN_DATA\nred 0.1 0.2 0.3\n\"blue 0.4 0.5 0.6\nEND_DATA\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:12:1: error: the string has no closing quote");
  file.format = "BEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400";
  file.data = "";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:8:19: error: END_DATA_FORMAT is missing");
}

TEST(Cgats, FindsPartsThatAreMissing) {
  EXPECT_EQ(error_of("SPECT\nBEGIN_DATA\n1\nEND_DATA\n"),
            "tcs.sp:2:1: error: BEGIN_DATA stands before any data format");
  EXPECT_EQ(error_of("SPECT\nDESCRIPTOR \"a\nBEGIN_DATA\n"),
            "tcs.sp:2:12: error: the string has no closing quote");
  EXPECT_EQ(error_of("\"a\nBEGIN_DATA"), "tcs.sp:1:1: error: the string has no closing quote");
}

TEST(Cgats, FindsSpectralColumnsInEverySpellingOfTheField) {
  for (const std::string prefix : {"SPEC_", "spec_", "SPECTRAL_NM", "SPECTRAL_NM_", "Spectral_Nm_",
                                   "nm", "NM", "NM_", "R_", "r_"}) {
    File file;
    file.start = file.end = file.bands = "";
    file.format = "BEGIN_DATA_FORMAT\nSAMPLE_ID " + prefix + "400 " + prefix + "410 " + prefix +
                  "420\nEND_DATA_FORMAT\n";
    EXPECT_EQ(read(file.text()).at(1).spectrum, (Spectrum{nm, {0.4, 0.5, 0.6}})) << prefix;
  }
}

TEST(Cgats, ReadsItsKeywordsInAnyCase) {
  File file;
  file.format = "begin_data_format\nSample_Id SPEC_400 SPEC_410 SPEC_420\nend_data_format\n";
  file.bands = "Spectral_Bands 3\n";
  file.data = "begin_data\nred 1 2 3\nblue 4 5 6\nEnd_Data\n";
  EXPECT_EQ(read(file.text()).at(1).name, "blue");
}

TEST(Cgats, KnowsBlankCellsBetweenTabs) {
  File file;
  file.fields = "NUMBER_OF_FIELDS\t5\n";
  file.format =
      "BEGIN_DATA_FORMAT\nSAMPLE_ID\tSAMPLE_NAME\tSPEC_400\tSPEC_410\tSPEC_420\n"
      "END_DATA_FORMAT\n";
  file.data = "BEGIN_DATA\n1\t\t0.1\t0.2\t0.3\n2\t\"dark red\"\t0.4\t0.5\t0.6\t\nEND_DATA\n";
  const Spectra spectra = read(file.text());
  ASSERT_EQ(spectra.size(), 2U);
  EXPECT_EQ(spectra[0].name, "1");
  EXPECT_EQ(spectra[0].spectrum.values, (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(spectra[1].name, "dark red");
  file.data = "BEGIN_DATA\n1\ta\t0.1\t\t0.3\n2\tb\t0.4\t0.5\t0.6\nEND_DATA\n";
  EXPECT_EQ(error_of(file.text()), "tcs.sp:11:9: error: there is no value for \"SPEC_410\"");
}

TEST(Cgats, SaysWhatItMeasures) {
  const auto quantity_of = [](const std::string& type) {
    const auto read =
        read_spectrum_file("SPECT\nMEAS_TYPE \"" + type + "\"\n" + File().text(), "a");
    return read ? read->quantity : std::nullopt;
  };
  EXPECT_EQ(quantity_of("REFLECTIVE"), Quantity::reflectance);
  EXPECT_EQ(quantity_of("Transmissive"), Quantity::transmittance);
  for (const char* type : {"EMISSION", "EMISSION_PROJECTOR", "AMBIENT", "AMBIENT_FLASH", "FLASH"})
    EXPECT_EQ(quantity_of(type), Quantity::emission) << type;
  EXPECT_EQ(quantity_of("SENSITIVITY"), std::nullopt);
}

TEST(Cgats, TakesColumnsThatFall) {
  File file;
  file.start = file.end = file.bands = "";
  file.format = "BEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_420 SPEC_410 SPEC_400\nEND_DATA_FORMAT\n";
  EXPECT_EQ(read(file.text()).at(0).spectrum, (Spectrum{nm, {0.3, 0.2, 0.1}}));
}

TEST(Cgats, EachPrefixOfAFileIsAnErrorAndNoCrash) {
  const std::string text = File().text();
  const std::size_t whole = text.rfind("END_DATA") + 8;
  for (std::size_t size = 0; size < whole; ++size) {
    EXPECT_NE(error_of(text.substr(0, size)), "no error") << size;
  }
  EXPECT_EQ(error_of(text.substr(0, whole)), "no error");
}

TEST(Cgats, BoundsItsColumnsAndSpectra) {
  std::string columns;
  for (int i = 0; i < 5001; ++i) columns += " LAB_" + std::to_string(i);
  const std::string wide = "BEGIN_DATA_FORMAT" + columns;
  EXPECT_EQ(
      error_of("CGATS\n" + wide + " SPEC_380 END_DATA_FORMAT\n"),
      "tcs.sp:2:" + std::to_string(wide.size() + 2) + ": error: at most 5001 columns are possible");

  std::string bands;
  for (int i = 1; i <= 4002; ++i) bands += " SPEC_" + std::to_string(i);
  EXPECT_EQ(error_of("CGATS\nBEGIN_DATA_FORMAT" + bands + " END_DATA_FORMAT\nBEGIN_DATA\n"),
            "tcs.sp:2:19: error: at most 4001 samples are possible, not 4002");

  std::string data;
  for (int i = 0; i < 4096; ++i) data += "1\n";
  const std::string head = "CGATS\nBEGIN_DATA_FORMAT SPEC_380 END_DATA_FORMAT\nBEGIN_DATA\n";
  EXPECT_EQ(error_of(head + data + "END_DATA\n"), "no error");
  EXPECT_EQ(error_of(head + data + "1\nEND_DATA\n"),
            "tcs.sp:4100:1: error: at most 4096 spectra are possible");
}

}  // namespace
}  // namespace metamer
