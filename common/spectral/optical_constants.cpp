#include "common/spectral/optical_constants.h"

#include <cstddef>

namespace metamer {
namespace {

// As collected in refractiveindex.info's database (CC0 1.0).
constexpr const char* johnson_christy =
    "P. B. Johnson and R. W. Christy, Optical constants of the noble metals, Phys. Rev. B 6, 4370 "
    "(1972)";
constexpr const char* mcpeak =
    "K. M. McPeak et al., Plasmonic films can easily be better, ACS Photonics 2, 326 (2015)";

// clang-format off
const std::vector<double> johnson_christy_nm = {
    292.4, 300.9, 310.7, 320.4, 331.5, 342.5, 354.2, 367.9, 381.5, 397.4, 413.3, 430.5, 450.9,
    471.4, 495.9, 520.9, 548.6, 582.1, 616.8, 659.5, 704.5, 756.0, 821.1, 892.0};

const std::vector<double> aluminium_nm = {
    300, 320, 340, 360, 380, 400, 420, 440, 460, 480, 500, 520, 540, 560, 580, 600, 620, 640,
    660, 680, 700, 720, 740, 760, 780, 800};

std::vector<Metal> make_metals() {
  return {
      {"Ag", johnson_christy,
       {johnson_christy_nm, {
    1.39, 1.34, 1.13, 0.81, 0.17, 0.14, 0.10, 0.07, 0.05, 0.05, 0.05, 0.04, 0.04, 0.05, 0.05,
    0.05, 0.06, 0.05, 0.06, 0.05, 0.04, 0.03, 0.04, 0.04}},
       {johnson_christy_nm, {
    1.161, 0.964, 0.616, 0.392, 0.829, 1.142, 1.419, 1.657, 1.864, 2.070, 2.275, 2.462, 2.657,
    2.869, 3.093, 3.324, 3.586, 3.858, 4.152, 4.483, 4.838, 5.242, 5.727, 6.312}}},
      {"Al", mcpeak,
       {aluminium_nm, {
    0.2050, 0.2377, 0.2675, 0.3001, 0.3360, 0.3752, 0.4176, 0.4642, 0.5148, 0.5680, 0.6257,
    0.6883, 0.7545, 0.8292, 0.9086, 0.9925, 1.0882, 1.1903, 1.3044, 1.4260, 1.5598, 1.7068,
    1.8722, 2.0542, 2.2315, 2.3737}},
       {aluminium_nm, {
    3.1009, 3.3238, 3.5501, 3.7763, 4.0026, 4.2264, 4.4474, 4.6691, 4.8879, 5.1059, 5.3205,
    5.5360, 5.7465, 5.9582, 6.1652, 6.3690, 6.5666, 6.7594, 6.9424, 7.1163, 7.2739, 7.4142,
    7.5284, 7.5995, 7.6039, 7.5226}}},
      {"Au", johnson_christy,
       {johnson_christy_nm, {
    1.49, 1.53, 1.53, 1.54, 1.48, 1.48, 1.50, 1.48, 1.46, 1.47, 1.46, 1.45, 1.38, 1.31, 1.04,
    0.62, 0.43, 0.29, 0.21, 0.14, 0.13, 0.14, 0.16, 0.17}},
       {johnson_christy_nm, {
    1.878, 1.889, 1.893, 1.898, 1.883, 1.871, 1.866, 1.895, 1.933, 1.952, 1.958, 1.948, 1.914,
    1.849, 1.833, 2.081, 2.455, 2.863, 3.272, 3.697, 4.103, 4.542, 5.083, 5.663}}},
      {"Cu", johnson_christy,
       {johnson_christy_nm, {
    1.42, 1.40, 1.38, 1.38, 1.34, 1.36, 1.37, 1.36, 1.33, 1.32, 1.28, 1.25, 1.24, 1.25, 1.22,
    1.18, 1.02, 0.70, 0.30, 0.22, 0.21, 0.24, 0.26, 0.30}},
       {johnson_christy_nm, {
    1.633, 1.679, 1.729, 1.783, 1.821, 1.864, 1.916, 1.975, 2.045, 2.116, 2.207, 2.305, 2.397,
    2.483, 2.564, 2.608, 2.577, 2.704, 3.205, 3.747, 4.205, 4.665, 5.180, 5.768}}},
  };
}
// clang-format on

std::vector<Medium> make_media() {
  return {
      {"N-BK7",
       "SCHOTT optical glass catalogue (2017)",
       {{1.03961212, 0.00600069867}, {0.231792344, 0.0200179144}, {1.01046945, 103.560653}},
       300,
       2500},
      {"N-SF11",
       "SCHOTT optical glass catalogue (2017)",
       {{1.73759695, 0.013188707}, {0.313747346, 0.0623068142}, {1.89878101, 155.23629}},
       370,
       2500},
      {"diamond",
       "F. Peter, Z. Phys. 15, 358 (1923)",
       {{0.3306, 0.1750 * 0.1750}, {4.3356, 0.1060 * 0.1060}},
       226,
       760},
      {"water",
       "M. Daimon and A. Masumura, Appl. Opt. 46, 3811 (2007), at 20 °C",
       {{0.5684027565, 0.005101829712},
        {0.1726177391, 0.01821153936},
        {0.02086189578, 0.02620722293},
        {0.1130748688, 10.69792721}},
       182,
       1129},
  };
}

}  // namespace

const std::vector<Metal>& metals() {
  static const std::vector<Metal> all = make_metals();
  return all;
}

const std::vector<Medium>& media() {
  static const std::vector<Medium> all = make_media();
  return all;
}

double sellmeier_squared(std::span<const SellmeierTerm> terms, double nm) {
  const double squared = nm * nm * 1e-6;
  double sum = 1;
  for (const SellmeierTerm& term : terms) sum += term.b * squared / (squared - term.c);
  return sum;
}

double cauchy(double a, double b, double c, double nm) {
  const double squared = nm * nm * 1e-6;
  return a + b / squared + c / (squared * squared);
}

}  // namespace metamer
