#include "tests/server/methods/lamps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "common/spectral/spectrum.h"

namespace metamer::test {
namespace {

constexpr double sum_step = 0.005;  // nm

double lamp_power(const Lamp& lamp, double nm) {
  double sum = lamp.continuum;
  for (const GaussianLine& line : lamp.lines)
    sum += line.power / line.width * std::exp(-0.5 * std::pow((nm - line.nm) / line.width, 2));
  return sum;
}

}  // namespace

const std::vector<Lamp>& lamps() {
  static const std::vector<Lamp> all = {
      {"RGB LED", 1, 0, {{460, 10, 1}, {525, 15, 1.1}, {625, 8, 0.9}}},
      {"phosphor LED", 5, 0, {{455, 11, 1}, {570, 55, 3}}},
      {"LED by 20 nm", 20, 0, {{450, 14, 1}, {580, 60, 3}}},
      {"laser phosphor", 0.1, 0.3, {{445.5, 0.13, 20}, {560, 50, 60}}},
      {"mercury",
       0.05,
       0,
       {{404.66, 0.085, 6},
        {435.83, 0.085, 20},
        {546.07, 0.085, 30},
        {576.96, 0.085, 5},
        {579.07, 0.085, 5}}},
      {"metal halide",
       0.2,
       0.05,
       {{435.83, 0.17, 8},
        {535.05, 0.17, 25},
        {588.99, 0.17, 15},
        {589.59, 0.17, 15},
        {671, 0.3, 3}}},
      {"three lasers", 0.05, 0, {{450.3, 0.05, 10}, {532.1, 0.05, 12}, {638.4, 0.05, 14}}},
      {"helium-neon", 0.02, 0, {{632.8, 0.04, 1}}},
      {"sodium", 0, 0, {{588.995, 0.02, 2}, {589.59, 0.02, 1}}},
      {"uneven grid",
       0,
       0.01,
       {{405.3, 0.05, 1}, {487.7, 0.4, 3}, {543.9, 1.1, 6}, {611.6, 0.9, 6}, {690, 6, 2}}}};
  return all;
}

Spectrum samples_of(const Lamp& lamp) {
  const GaussianLine &first = lamp.lines.front(), &last = lamp.lines.back();
  const double from = std::floor(first.nm - 5 - 3 * first.width);
  const double to = last.nm + 5 + 3 * last.width;
  std::set<long> places;  // in steps
  const auto add = [&](double low, double high, double by) {
    const int count = static_cast<int>((high - low) / by);
    for (int i = 0; i <= count; ++i) places.insert(std::lround((low + i * by) / sum_step));
  };
  add(from, to, lamp.step > 0 ? lamp.step : 7.3);
  if (lamp.step == 0)
    for (const GaussianLine& line : lamp.lines)
      add(line.nm - 6 * line.width, line.nm + 6 * line.width, line.width / 4);
  Spectrum spectrum;
  for (const long place : places) {
    const double nm = std::round(static_cast<double>(place) * sum_step * 1e3) / 1e3;
    spectrum.nm.push_back(nm);
    spectrum.values.push_back(lamp_power(lamp, nm));
  }
  return spectrum;
}

std::string text_of(const Spectrum& spectrum) {
  std::string nm, values;
  char number[40];
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i) {
    std::snprintf(number, sizeof number, "%s%.10g", i ? ", " : "", spectrum.nm[i]);
    nm += number;
    std::snprintf(number, sizeof number, "%s%.10g", i ? ", " : "", spectrum.values[i]);
    values += number;
  }
  return "samples { wavelength: [" + nm + "] value: [" + values + "] } interpolation: LINEAR";
}

const std::vector<double>& PlainSum::wavelengths() {
  static const std::vector<double> nm = [] {
    std::vector<double> all(94000);
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = 360 + sum_step * (static_cast<double>(i) + 0.5);
    return all;
  }();
  return nm;
}

PlainSum::PlainSum(const Spectrum& light, const Observer& observer) {
  std::vector<double> power = resample(light, wavelengths(), Outside::zero).values;
  if (light.nm.back() - light.nm.front() < sum_step) {
    const double at = (light.nm[1] - wavelengths().front()) / sum_step;
    const auto below = static_cast<std::size_t>(at);
    power.assign(power.size(), 0);
    power[below] = 1 - (at - std::floor(at));
    power[below + 1] = 1 - power[below];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    seen_[axis] = resample(observer.functions()[axis], wavelengths(), Outside::zero).values;
    for (std::size_t i = 0; i < power.size(); ++i) seen_[axis][i] *= power[i];
  }
  const double luminance = std::accumulate(seen_[1].begin(), seen_[1].end(), 0.0);
  for (std::vector<double>& axis : seen_)
    for (double& value : axis) value /= luminance;
}

std::vector<double> PlainSum::reflectance(const Spectrum& surface) {
  return resample(surface, wavelengths(), Outside::hold).values;
}

Xyz PlainSum::operator()(const std::vector<double>& reflectance) const {
  Xyz xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    xyz[axis] =
        std::inner_product(reflectance.begin(), reflectance.end(), seen_[axis].begin(), 0.0);
  return xyz;
}

Xyz PlainSum::white() const { return (*this)(std::vector<double>(wavelengths().size(), 1.0)); }

}  // namespace metamer::test
