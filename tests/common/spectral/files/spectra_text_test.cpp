#include "common/spectral/files/spectra_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/spectral/cie.h"

namespace metamer {
namespace {

NamedSpectrum named(const std::string& name, std::vector<double> nm, std::vector<double> values) {
  return {.name = name, .spectrum = {std::move(nm), std::move(values)}};
}

void expect_same_when_read(const std::vector<NamedSpectrum>& spectra, SpectrumFormat format) {
  const auto text = spectra_text(spectra, format);
  ASSERT_TRUE(text) << text.error().message;
  const auto back = parse_spectra(*text, "x");
  ASSERT_TRUE(back) << metamer::format(back.error(), *text);
  ASSERT_EQ(back->size(), spectra.size());
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    EXPECT_EQ((*back)[i].spectrum, spectra[i].spectrum);
    EXPECT_EQ((*back)[i].name, format == SpectrumFormat::cgats ? spectra[i].name : "");
  }
}

TEST(SpectraText, ReadsBackAsTheSameDoubles) {
  const auto uneven = named("a b", {1.5, 380.0625, 400, 10000}, {0.1 + 0.2, 1e-300, -1e100, 5});
  const auto tenths =
      named("t", Wavelengths::uniform(400, 410, 0.1)->nm(), std::vector<double>(101, 1 / 3.0));
  const auto single = named("s", {555}, {0.25});
  for (const NamedSpectrum& one :
       {uneven, tenths, single,
        named("D65", cie::illuminant("D65")->nm, cie::illuminant("D65")->values)}) {
    expect_same_when_read({one}, SpectrumFormat::pairs);
    expect_same_when_read({one}, SpectrumFormat::cgats);
    if (one.name != uneven.name) expect_same_when_read({one}, SpectrumFormat::uniform);
  }
  std::vector<NamedSpectrum> paints;
  for (const std::string& name : cie::test_color_names())
    paints.push_back({.name = name, .spectrum = *cie::test_color(name)});
  expect_same_when_read(paints, SpectrumFormat::cgats);
}

TEST(SpectraText, IsThatOfTheSourcesFigure) {
  // Fig. 4-4.
  const auto one = named("", {400, 500, 600, 700}, {0.2, 0.3, 0.6, 0.8});
  EXPECT_EQ(*spectra_text({one}, SpectrumFormat::uniform), "400 700 100\n0.2\n0.3\n0.6\n0.8\n");
  EXPECT_EQ(*spectra_text({one}, SpectrumFormat::pairs), "400 0.2\n500 0.3\n600 0.6\n700 0.8\n");
}

TEST(SpectraText, NamesCannotBreakTheFile) {
  const auto text = spectra_text({named("a\"\nEND_DATA", {400}, {1})}, SpectrumFormat::cgats);
  ASSERT_TRUE(text);
  const auto back = parse_spectra(*text, "x");
  ASSERT_TRUE(back) << *text;
  EXPECT_EQ(back->front().name, "a'?END_DATA");
}

std::string error_of(const std::vector<NamedSpectrum>& spectra, SpectrumFormat format) {
  const auto text = spectra_text(spectra, format);
  return text ? "" : text.error().message;
}

TEST(SpectraText, RefusesWhatAFormatCannotHold) {
  const auto one = named("a", {400, 500}, {1, 1}), other = named("b", {400, 501}, {1, 1});
  EXPECT_EQ(error_of({one, other}, SpectrumFormat::cgats),
            "spectra of one file need the same wavelengths: resample them first");
  EXPECT_EQ(error_of({one, one}, SpectrumFormat::pairs),
            "a plain file holds one spectrum, not 2: write CGATS, or choose one");
  EXPECT_EQ(error_of({named("a", {400, 500, 501}, {1, 1, 1})}, SpectrumFormat::uniform),
            "its steps are not equal: resample it, or write pairs or CGATS");
}

EnergyCheck energy(const Spectrum& original, const std::vector<double>& nm,
                   Outside outside = Outside::zero) {
  return check_energy(original, {nm, resample(original, nm, outside).values}, outside);
}

TEST(CheckEnergy, TellsASpikeBetweenTheSamples) {
  // A triangle of area 10 on a floor of 1.
  const Spectrum spike = {{400, 546, 547, 548, 700}, {1, 1, 11, 1, 1}};
  const EnergyCheck check = energy(spike, {400, 500, 600, 700});
  EXPECT_DOUBLE_EQ(check.before, 310);
  EXPECT_DOUBLE_EQ(check.after, 300);
  EXPECT_DOUBLE_EQ(check.worst, -10);
  EXPECT_EQ(check.worst_from, 500);
  EXPECT_EQ(check.worst_to, 600);
  EXPECT_EQ(check.outside, 0);
}

TEST(CheckEnergy, TellsASpikeThatASampleWidens) {
  const Spectrum spike = {{400, 546, 547, 548, 700}, {0, 0, 10, 0, 0}};
  const EnergyCheck check = energy(spike, {447, 547, 647});
  EXPECT_DOUBLE_EQ(check.before, 10);
  EXPECT_DOUBLE_EQ(check.after, 1000);
  EXPECT_DOUBLE_EQ(std::abs(check.worst), 495);
}

TEST(CheckEnergy, OfTheSameOrFinerSamplesChangesNothing) {
  const Spectrum& light = *cie::illuminant("F11");
  const EnergyCheck same = energy(light, light.nm);
  EXPECT_DOUBLE_EQ(same.after, same.before);
  const EnergyCheck finer = energy(light, Wavelengths::uniform(380, 780, 1)->nm());
  EXPECT_NEAR(finer.after, same.before, 1e-12 * same.before);
  EXPECT_NEAR(finer.worst, 0, 1e-12);
}

TEST(CheckEnergy, CountsWhatLiesOutside) {
  const Spectrum flat = {{400, 700}, {2, 2}};
  const EnergyCheck inside = energy(flat, {450, 500});
  EXPECT_DOUBLE_EQ(inside.before, 100);
  EXPECT_DOUBLE_EQ(inside.after, 100);
  EXPECT_DOUBLE_EQ(inside.outside, 500);
  EXPECT_DOUBLE_EQ(energy(flat, {500}).outside, 600) << "one sample has no width";
  // Beyond its data an emission is 0 and a property holds its end value.
  EXPECT_DOUBLE_EQ(energy(flat, {400, 700, 800}).after, 700);
  EXPECT_DOUBLE_EQ(energy(flat, {400, 700, 800}).before, 600);
  EXPECT_DOUBLE_EQ(energy(flat, {400, 700, 800}, Outside::hold).before, 800);
}

TEST(SpectraText, OfCgatsSaysWhatTheSpectraAre) {
  for (const Quantity quantity :
       {Quantity::reflectance, Quantity::transmittance, Quantity::emission}) {
    const auto text =
        spectra_text({named("a", {400, 500}, {0.1, 0.2})}, SpectrumFormat::cgats, quantity);
    ASSERT_TRUE(text);
    const auto read = read_spectrum_file(*text, "a.sp");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->quantity, quantity);
  }
  const auto silent = spectra_text({named("a", {400, 500}, {0.1, 0.2})}, SpectrumFormat::cgats);
  EXPECT_EQ(silent->find("MEAS_TYPE"), silent->npos);
}

}  // namespace
}  // namespace metamer
