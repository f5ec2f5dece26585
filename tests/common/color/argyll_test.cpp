// X Y Z and L*a*b* of the CIE's test colours by another program, ArgyllCMS's spec2cie (Debian's
// package argyll), from the same tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "common/color/lab.h"
#include "common/spectral/spectra_text.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;

struct Seen {
  Xyz xyz;  ///< Of a white of Y = 100.
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

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  /// The test colours as measurements, and a perfect white last.
  static std::string paints() {
    std::string text =
        "CTI3\n\nDESCRIPTOR \"Test colours\"\nORIGINATOR \"metamer\"\n"
        "KEYWORD \"DEVICE_CLASS\"\nDEVICE_CLASS \"INPUT\"\n"
        "KEYWORD \"COLOR_REP\"\nCOLOR_REP \"LAB_RGB\"\n"
        "KEYWORD \"SPECTRAL_BANDS\"\nSPECTRAL_BANDS \"95\"\n"
        "KEYWORD \"SPECTRAL_START_NM\"\nSPECTRAL_START_NM \"360\"\n"
        "KEYWORD \"SPECTRAL_END_NM\"\nSPECTRAL_END_NM \"830\"\n"
        "KEYWORD \"SPECTRAL_NORM\"\nSPECTRAL_NORM \"100\"\n\n"
        "NUMBER_OF_FIELDS 99\nBEGIN_DATA_FORMAT\nSAMPLE_ID RGB_R RGB_G RGB_B";
    for (int nm = 360; nm <= 830; nm += 5) text += " SPEC_" + std::to_string(nm);
    text += "\nEND_DATA_FORMAT\n\nNUMBER_OF_SETS 16\nBEGIN_DATA\n";
    for (std::size_t i = 0; i <= 15; ++i) {
      text += std::to_string(i + 1) + " 0 0 0";
      for (std::size_t k = 0; k < 95; ++k)
        // With a point, without which Argyll reads integers.
        text +=
            " " + std::to_string(
                      i == 15 ? 100 : 100 * cie::test_color(cie::test_color_names()[i])->values[k]);
      text += "\n";
    }
    return text + "END_DATA\n";
  }

  /// What Argyll computes under a light for each of the sixteen.
  std::vector<Seen> ask(const std::string& light, const std::string& observer) const {
    write("light.sp", *spectra_text({{.name = light, .spectrum = *cie::illuminant(light)}},
                                    SpectrumFormat::cgats));
    const std::string command = "cd '" + folder_.string() + "' && spec2cie -n -o " + observer +
                                " -i light.sp paints.ti3 seen.ti3 > said 2>&1";
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
  for (const auto& [word, observer] : {std::pair{"1931_2", cie::Observer::cie_1931_2deg},
                                       std::pair{"1964_10", cie::Observer::cie_1964_10deg}})
    for (const char* light : {"A", "D50", "D65", "F2", "F7", "F11"}) {
      const std::vector<Seen> theirs = ask(light, word);
      ASSERT_EQ(theirs.size(), 16U) << light;
      const ObserverWeights lit = under_light(observer, *cie::illuminant(light), wavelengths.nm());
      const Xyz white = to_xyz(lit, std::vector<double>(wavelengths.size(), 1.0));
      // Both start from samples every 5 nm. Argyll bends a curve through them, we draw straight
      // lines, which cut corners off x̄, ȳ, z̄ and off mercury's lines: measured, that is up to 0.032
      // of 100 in X, Y, Z with smooth lights, 0.127 with lamps, and ΔE00 0.056 with all of them.
      const bool lines = light[0] == 'F';
      for (std::size_t i = 0; i <= 15; ++i) {
        Xyz own = white;
        if (i < 15)
          own = to_xyz(lit, resample(*cie::test_color(cie::test_color_names()[i]), wavelengths.nm(),
                                     Outside::hold)
                                .values);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(100 * own[c], theirs[i].xyz[c], lines ? 0.15 : 0.04) << light << " " << i;
        EXPECT_LT(delta_e_00(to_lab(own, white), theirs[i].lab), 0.07) << light << " " << i;
      }
    }
}

}  // namespace
}  // namespace metamer
