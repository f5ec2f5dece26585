// X Y Z and L*a*b* of the CIE's test colours by another program, ArgyllCMS's spec2cie (Debian's
// package argyll), from the same tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>

#include "common/color/lab.h"
#include "common/spectral/files/spectra_text.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;

struct Seen {
  Xyz xyz;  ///< Of a white of Y = 100; of a display, in cd/m².
  Lab lab;
};

class Argyll : public testing::Test {
 protected:
  Argyll() {
    std::string pattern = (fs::temp_directory_path() / "metamer-argyll-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    write("paints.ti3", paints());
  }
  ~Argyll() override { fs::remove_all(folder_); }

  /// A file of measurements by 1 or 5 nm; `rows` have a value for each of 360 to 830 nm.
  static std::string measurements(const char* device, double norm, int step,
                                  const std::vector<std::vector<double>>& rows) {
    const std::size_t bands = rows.front().size();
    std::ostringstream text;
    text << "CTI3\n\nDESCRIPTOR \"metamer\"\nORIGINATOR \"metamer\"\n"
         << "KEYWORD \"DEVICE_CLASS\"\nDEVICE_CLASS \"" << device << "\"\n"
         << "KEYWORD \"COLOR_REP\"\nCOLOR_REP \"LAB_RGB\"\n"
         << "KEYWORD \"SPECTRAL_BANDS\"\nSPECTRAL_BANDS \"" << bands << "\"\n"
         << "KEYWORD \"SPECTRAL_START_NM\"\nSPECTRAL_START_NM \"360\"\n"
         << "KEYWORD \"SPECTRAL_END_NM\"\nSPECTRAL_END_NM \"830\"\n"
         << "KEYWORD \"SPECTRAL_NORM\"\nSPECTRAL_NORM \"" << norm << "\"\n\n"
         << "NUMBER_OF_FIELDS " << bands + 4 << "\nBEGIN_DATA_FORMAT\nSAMPLE_ID RGB_R RGB_G RGB_B";
    for (std::size_t k = 0; k < bands; ++k) text << " SPEC_" << 360 + step * static_cast<int>(k);
    text << "\nEND_DATA_FORMAT\n\nNUMBER_OF_SETS " << rows.size() << "\nBEGIN_DATA\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
      text << i + 1 << " 0 0 0";
      // With a point, without which Argyll reads integers.
      for (const double value : rows[i]) text << " " << std::to_string(value);
      text << "\n";
    }
    return text.str() + "END_DATA\n";
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  /// The test colours as measurements, and a perfect white last.
  static std::string paints() {
    std::vector<std::vector<double>> rows;
    for (const std::string& name : cie::test_color_names())
      rows.push_back(cie::test_color(name)->values);
    rows.emplace_back(rows[0].size(), 1.0);
    for (std::vector<double>& row : rows)
      for (double& value : row) value *= 100;
    return measurements("INPUT", 100, 5, rows);
  }

  /// What Argyll computes under a light for each of the sixteen.
  std::vector<Seen> ask(const std::string& light, const std::string& observer) const {
    write("light.sp", *spectra_text({{.name = light, .spectrum = *cie::illuminant(light)}},
                                    SpectrumFormat::cgats));
    return run("-o " + observer + " -i light.sp paints.ti3");
  }

  std::vector<Seen> run(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.string() + "' && spec2cie -n " + arguments + " seen.ti3 > said 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream said(folder_ / "said");
    std::stringstream words;
    words << said.rdbuf();
    EXPECT_EQ(status, 0) << "spec2cie (Debian's package argyll) is missing or failed: "
                         << words.str();
    return status == 0 ? read() : std::vector<Seen>{};
  }

  std::vector<Seen> read() const {
    // The last three columns are L*a*b* relative to the light; LAB_L is relative to D50.
    std::ifstream stream(folder_ / "seen.ti3");
    std::map<std::string, std::size_t> columns;
    std::vector<std::string> names;
    std::vector<Seen> seen;
    std::string line;
    while (std::getline(stream, line) && line != "BEGIN_DATA_FORMAT") {
    }
    std::getline(stream, line);
    std::istringstream header(line);
    for (std::string name; header >> name;) {
      columns[name] = names.size();
      names.push_back(name);
    }
    if (columns.count("XYZ_X") == 0) return {};
    const std::size_t xyz = columns["XYZ_X"], lab = names.size() - 3;
    while (std::getline(stream, line) && line != "BEGIN_DATA") {
    }
    while (std::getline(stream, line) && line != "END_DATA") {
      std::istringstream words(line);
      std::vector<double> numbers;
      for (double number = 0; words >> number;) numbers.push_back(number);
      if (numbers.size() != names.size()) return {};
      seen.push_back({{numbers[xyz], numbers[xyz + 1], numbers[xyz + 2]},
                      {numbers[lab], numbers[lab + 1], numbers[lab + 2]}});
    }
    return seen;
  }

  fs::path folder_;
};

TEST_F(Argyll, AgreesOnXyzAndLabOfAllTestColours) {
  const Wavelengths wavelengths = observer_wavelengths();
  for (const auto& [word, observer] :
       {std::pair{"1931_2", cie::observer_1931()}, std::pair{"1964_10", cie::observer_1964()}})
    for (const char* light : {"A", "D50", "D65", "F2", "F7", "F11"}) {
      const std::vector<Seen> theirs = ask(light, word);
      ASSERT_EQ(theirs.size(), 16U) << light;
      const ObserverWeights lit = under_light(observer, *cie::illuminant(light), wavelengths.nm());
      const Xyz white = to_xyz(lit, std::vector<double>(wavelengths.size(), 1.0));
      // Argyll bends a curve through the light's and the paint's 5 nm samples, we draw straight
      // lines: measured, up to 0.018 of 100 in X, Y, Z and ΔE00 0.008.
      for (std::size_t i = 0; i <= 15; ++i) {
        Xyz own = white;
        if (i < 15)
          own = to_xyz(lit, resample(*cie::test_color(cie::test_color_names()[i]), wavelengths.nm(),
                                     Outside::hold)
                                .values);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(100 * own[c], theirs[i].xyz[c], 0.025) << light << " " << i;
        EXPECT_LT(delta_e_00(to_lab(own, white), theirs[i].lab), 0.012) << light << " " << i;
      }
    }
}

TEST_F(Argyll, SeesMonochromaticLightAlike) {
  // Argyll has the CIE's values by 1 nm and a sum over them; X Y Z of a display are in cd/m².
  std::vector<std::vector<double>> lines;
  for (std::size_t i = 0; i < 471; ++i) {
    lines.emplace_back(471, 0.0);
    lines[i][i] = 1000;
  }
  write("lines.ti3", measurements("DISPLAY", 1, 1, lines));
  for (const auto& [word, observer, tolerance] :
       {std::tuple{"1931_2", cie::observer_1931(), 5e-4},
        std::tuple{"1964_10", cie::observer_1964(), 3.5e-3}}) {
    const std::vector<Seen> theirs = run(std::string("-o ") + word + " lines.ti3");
    ASSERT_EQ(theirs.size(), lines.size());
    const auto& functions = observer.functions();
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(functions[c].values[i], theirs[i].xyz[c] / 683, tolerance)
            << word << " " << functions[c].nm[i] << " nm";
  }
}

}  // namespace
}  // namespace metamer
