#include "common/spectral/files/observer_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "common/spectral/cie.h"
#include "common/spectral/files/spectrum_file.h"

namespace metamer {
namespace {

std::string fault_in(std::string_view text) {
  const auto observer = parse_observer(text, "eye.csv");
  return observer ? "none" : format(observer.error());
}

const Observer::Functions wanted_functions = {Spectrum{{400, 500, 650}, {0.1, 0.2, 0.3}},
                                              Spectrum{{400, 500, 650}, {0.5, 1, 0.5}},
                                              Spectrum{{400, 500, 650}, {0.7, 0.25, 0}}};

TEST(ObserverFile, IsReadWithAnySeparatorAndALineOfHeadings) {
  for (const char* text :
       {"400,0.1,0.5,0.7\n500,0.2,1,0.25\n650,0.3,0.5,0\n",
        "400;0.1;0.5;0.7\r\n500;.2;1;0.25\r\n650;0.3;5e-1;0.0",
        "400;0,1;0,5;0,7\r\n500;0,2;1;0,25\r\n650;0,3;0,5;0",
        "400\t0.1\t0.5\t0.7\n500\t0.2\t1\t0.25\n\n650\t0.3\t0.5\t0\n",
        "  400 0.1 0.5 0.7\n500   0.2 1 +0.25\n650 0.3 0.5 0",
        "\xEF\xBB\xBFWavelength (nm), x-bar, y-bar, z-bar\n400, 0.1, 0.5, 0.7\n500, 0.2, 1, "
        "0.25\n650, 0.3, 0.5, 0",
        "nm,z,y,x\n400,0.7,0.5,0.1\n500,0.25,1,0.2\n650,0,0.5,0.3",
        "# 2015\nλ,x̄10,ȳ10,z̄10\n400,0.1,0.5,0.7\n500,0.2,1,0.25\n650,0.3,0.5,0",
        "nm,a,b,c\n650,0.3,0.5,0\n500,0.2,1,0.25\n400,0.1,0.5,0.7\n"}) {
    const auto observer = parse_observer(text, "eye.csv");
    ASSERT_TRUE(observer) << format(observer.error(), text);
    EXPECT_EQ(observer->functions(), wanted_functions) << text;
    EXPECT_EQ(observer->name(), "eye.csv");
  }
}

TEST(ObserverFile, IsReadAsCgatsByNamesOrInOrder) {
  const std::string head =
      "CMF\nSPECTRAL_START_NM 400\nSPECTRAL_END_NM 420\nSPECTRAL_BANDS 3\nSPECTRAL_NORM 1\n"
      "NUMBER_OF_SETS 3\n";
  const std::string fields = "SPEC_400 SPEC_410 SPEC_420\nEND_DATA_FORMAT\nBEGIN_DATA\n";
  const auto named = parse_observer(head + "NUMBER_OF_FIELDS 4\nBEGIN_DATA_FORMAT\nSAMPLE_ID " +
                                        fields + "Z 7 8 9\nx 1 2 3\ny 4 5 6\nEND_DATA\n",
                                    "eye.cmf");
  ASSERT_TRUE(named) << format(named.error());
  EXPECT_EQ(named->functions()[0].values, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(named->functions()[2].values, (std::vector<double>{7, 8, 9}));
  const auto in_order = parse_observer(
      head + "NUMBER_OF_FIELDS 3\nBEGIN_DATA_FORMAT\n" + fields + "1 2 3\n4 5 6\n7 8 9\nEND_DATA\n",
      "eye.cmf");
  ASSERT_TRUE(in_order) << format(in_order.error());
  EXPECT_EQ(in_order->functions(), named->functions());
}

TEST(ObserverFile, SaysWhatIsWrong) {
  EXPECT_EQ(fault_in("400,1,2\n410,1,2\n"),
            "eye.csv: error: is no observer: that has three spectra, x, y and z, and not 2");
  EXPECT_EQ(fault_in("400,1,2,3\n410,1,-2,3\n"),
            "eye.csv: error: is no observer: ȳ must not be negative (it is -2 at 410 nm)");
  EXPECT_EQ(fault_in("400,1,2,3\n410,-1,2,3\n"),
            "eye.csv: error: is no observer: x̄ must not be below -1 % of its largest value: is "
            "this no x̄ ȳ z̄? (it is -1 at 410 nm)");
  EXPECT_EQ(fault_in("400,1,2,3\n"),
            "eye.csv: error: is no observer: an observer needs two wavelengths at least");
}

TEST(ObserverFile, OfConesOrPrimariesIsToldByName) {
  const std::string rows = "400,1,2,3\n410,1,2,3\n";
  for (const char* cones : {"nm,L,M,S\n", "nm,s,m,l\n", "nm,l-bar,m-bar,s-bar\n"})
    EXPECT_NE(fault_in(cones + rows).find("l, m and s, cone fundamentals"), std::string::npos)
        << fault_in(cones + rows);
  for (const char* primaries : {"nm,R,G,B\n", "nm,r10,g10,b10\n", "nm,blue,green,red\n"})
    EXPECT_NE(fault_in(primaries + rows).find("r, g and b"), std::string::npos);
  for (const char* good : {"nm,x,y,z\n", "nm,a,b,c\n", "nm,l,m,x\n"})
    EXPECT_EQ(fault_in(good + rows), "none");
}

TEST(ObserverFile, OfAnythingIsALocatedErrorOrAnObserver) {
  EXPECT_EQ(fault_in("400,1,2,3\n410,1,nan,3\n").substr(0, 13), "eye.csv:2:7: ");
  EXPECT_EQ(fault_in("400,1,2,1e999\n410,1,2,3\n").substr(0, 13), "eye.csv:1:9: ");
  EXPECT_EQ(fault_in("400,1,2,3\n400,1,2,3\n").substr(0, 13), "eye.csv:2:1: ");
  EXPECT_EQ(fault_in("400,1,2,3,4\n410,1,2,3\n").substr(0, 10), "eye.csv:2:");
  EXPECT_EQ(fault_in("").substr(0, 13), "eye.csv:1:1: ");
  std::string rows;
  for (int i = 0; i <= 4001; ++i) rows += std::to_string(400 + i) + ",1,1,1\n";
  EXPECT_EQ(fault_in(rows), "eye.csv:4002:1: error: at most 4001 samples are possible");
  EXPECT_NE(fault_in(std::string(max_spectrum_file + 1, ' ')).find("a spectrum file may have"),
            std::string::npos);
}

TEST(ObserverFile, OfColordsTablesIsTheBuiltInObserver) {
  for (const auto& [name, cie] : {std::pair{"CIE1931-2deg-XYZ", cie::observer_1931()},
                                  std::pair{"CIE1964-10deg-XYZ", cie::observer_1964()}}) {
    std::ifstream stream("/usr/share/colord/cmf/" + std::string(name) + ".cmf", std::ios::binary);
    ASSERT_TRUE(stream) << "colord-data, which the build needs";
    const auto own = parse_observer(std::string(std::istreambuf_iterator<char>(stream), {}), name);
    ASSERT_TRUE(own) << format(own.error());
    EXPECT_EQ(own->functions(), cie.functions());
  }
}

}  // namespace
}  // namespace metamer
