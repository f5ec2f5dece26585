#include "common/spectral/files/bispectral_file.h"

#include <gtest/gtest.h>

namespace metamer::test {
namespace {

std::string fault_of(const std::string& text) {
  const auto matrix = read_bispectral_file(text, "m.csv");
  if (matrix) return {};
  const Problem& problem = matrix.error();
  return problem.file + ":" + std::to_string(problem.line) + ":" + std::to_string(problem.column) +
         ": " + problem.message;
}

TEST(BispectralFile, IsATableInAnyOrderAndWriting) {
  const std::vector<double> values{0.001, 0.002, 0.003, 0.004, 0.005, 0.006};
  for (const std::string text :
       {"excitation,400,450,500\n300,.001,.002,.003\n350,.004,.005,.006\n",
        "# paper\nnm;450;400;500\n350;0,005;0,004;0,006\n300;0,002;0,001;0,003\n",
        "ex/em\t500\t450\t400\r\n300\t3e-3\t2e-3\t1e-3\r\n350\t6e-3\t5e-3\t4e-3"}) {
    const auto matrix = read_bispectral_file(text, "m.csv");
    ASSERT_TRUE(matrix) << text << matrix.error().message;
    EXPECT_EQ(matrix->excitation, (std::vector<double>{300, 350}));
    EXPECT_EQ(matrix->emission, (std::vector<double>{400, 450, 500}));
    EXPECT_EQ(matrix->values, values);
  }
}

TEST(BispectralFile, ItsFirstDecimalCommaMayComeLate) {
  const auto matrix = read_bispectral_file("x;540;550\n440;0;0\n450;0;0,05\n", "m.csv");
  ASSERT_TRUE(matrix) << matrix.error().message;
  EXPECT_EQ(matrix->values, (std::vector<double>{0, 0, 0, 0.05}));
  EXPECT_EQ(fault_of("x;540;550\n440;0,1;0,2\n450;0;0.05\n"),
            "m.csv:3:7: \"0.05\" is not a number: its decimal sign or what parts its thousands "
            "can't be told");
}

TEST(BispectralFile, IsKnownByItsFirstCell) {
  EXPECT_TRUE(is_bispectral("# by hand\nExcitation nm,400,450\n300,0,0\n"));
  EXPECT_FALSE(is_bispectral("nm,400,450\n300,0,0\n"));
  EXPECT_FALSE(is_bispectral(""));
}

TEST(BispectralFile, MayCrossTheDiagonalInItsCellAlone) {
  EXPECT_EQ(fault_of("ex,400,410,420\n410,0,.001,.001\n420,0,0,.001\n"), "");
  EXPECT_EQ(fault_of("ex,400,411,420\n410,.001,.001,.001\n420,0,0,.001\n"), "");
  EXPECT_EQ(fault_of("ex,400,410,420\n410,.001,.001,.001\n420,0,0,.001\n"),
            "m.csv:2:5: light of 410 nm is re-radiated at 400 nm: nothing re-radiates at a shorter "
            "wavelength");
}

TEST(BispectralFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(fault_of("300 nm\n"),
            "m.csv:1:1: expected a word, then the wavelengths of the emission");
  EXPECT_EQ(fault_of(""), "m.csv:1:1: expected a word, then the wavelengths of the emission");
  EXPECT_EQ(fault_of("ex,400,450\n300,0\n"),
            "m.csv:2:1: expected 3 cells as in the first line, not 2");
  EXPECT_EQ(fault_of("ex,400,450\n300,0,-1\n310,0,0\n"),
            "m.csv:2:7: a matrix must not be negative (it is -1)");
  EXPECT_NE(fault_of("ex,400,450\n300,0,nan\n310,0,0\n"), "");
  EXPECT_NE(fault_of("ex,400,450\n300,0,1e999\n310,0,0\n"), "");
  EXPECT_EQ(fault_of("ex,400,400\n300,0,0\n310,0,0\n"), "m.csv:1:8: 400 nm is there twice");
  EXPECT_EQ(fault_of("ex,400,450\n300,0,0\n300,0,0\n"), "m.csv:3:1: 300 nm is there twice");
  EXPECT_EQ(fault_of("ex,400,450\n254,0,0\n300,0,0\n"),
            "m.csv:2:1: a wavelength of excitation lies in 300..830 nm (it is 254)");
  EXPECT_EQ(fault_of("ex,0.4,0.45\n300,0,0\n310,0,0\n"),
            "m.csv:1:4: a wavelength of emission lies in 1..10000 nm (it is 0.4)");
  const std::string alone =
      "a matrix needs two wavelengths of excitation and two of emission at least";
  EXPECT_NE(fault_of("ex,400,450\n300,0,0\n").find(alone), std::string::npos);
  EXPECT_NE(fault_of("ex,400\n300,0\n310,0\n").find(alone), std::string::npos);
}

TEST(BispectralFile, IsBounded) {
  std::string text = "ex", row;
  for (int i = 0; i < 4000; ++i) {
    text += "," + std::to_string(900 + i);
    row += ",0";
  }
  for (int i = 0; i < 70; ++i) text += "\n" + std::to_string(300 + i) + row;
  EXPECT_EQ(fault_of(text), "m.csv:67:1: at most 262144 values are possible");
}

}  // namespace
}  // namespace metamer::test
