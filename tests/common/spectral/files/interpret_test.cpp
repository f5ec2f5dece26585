#include "common/spectral/files/interpret.h"

#include <gtest/gtest.h>

namespace metamer {
namespace {

Spectrum of(std::vector<double> values) {
  std::vector<double> nm;
  for (std::size_t i = 0; i < values.size(); ++i) nm.push_back(400 + 10 * static_cast<double>(i));
  return {nm, std::move(values)};
}

std::string fault_of(const SpectrumFile& file, std::vector<double> values, const Reading& reading,
                     Use use) {
  const auto taken = interpret(file, of(std::move(values)), reading, use);
  return taken ? "no error" : taken.error().message;
}

Interpreted taken(const SpectrumFile& file, std::vector<double> values, const Reading& reading,
                  Use use) {
  auto result = interpret(file, of(std::move(values)), reading, use);
  if (!result) ADD_FAILURE() << result.error().message;
  return result ? std::move(*result) : Interpreted{.spectrum = of({0}), .quantity = {}};
}

using Notes = std::vector<std::string>;

TEST(Interpret, GuessesWhatNobodySays) {
  const SpectrumFile silent{.format = "pairs"};
  const Interpreted paint = taken(silent, {0, 0.5, 1}, {}, Use::any);
  EXPECT_EQ(paint.quantity, Quantity::reflectance);
  EXPECT_EQ(paint.notes, Notes{"taken for a reflectance, as its values lie in 0..1"});
  const Interpreted lamp = taken(silent, {-0.1, 20}, {}, Use::any);
  EXPECT_EQ(lamp.quantity, Quantity::emission);
  EXPECT_EQ(lamp.notes.front(), "taken for an emission, as its values go from -0.1 to 20");
  const SpectrumFile percent{.format = "pairs", .scale = Scale::percent};
  EXPECT_EQ(taken(percent, {4, 50}, {}, Use::any).spectrum.values,
            (std::vector<double>{0.04, 0.5}));
}

TEST(Interpret, BelievesTheUserThenTheFileThenTheUse) {
  const SpectrumFile silent{.format = "pairs"},
      lamp{.format = "CGATS", .quantity = Quantity::emission},
      paper{.format = "CGATS", .quantity = Quantity::reflectance};
  EXPECT_EQ(taken(lamp, {0.1}, {}, Use::any).quantity, Quantity::emission);
  EXPECT_EQ(taken(lamp, {0.1}, {}, Use::any).notes, Notes{});
  EXPECT_EQ(taken(lamp, {0.1}, {.as = Quantity::transmittance}, Use::property).quantity,
            Quantity::transmittance);
  EXPECT_EQ(taken(silent, {0.1}, {}, Use::emission).quantity, Quantity::emission);
  EXPECT_EQ(taken(silent, {0.1}, {}, Use::property).notes, Notes{});
  EXPECT_EQ(fault_of(lamp, {0.1}, {}, Use::property),
            "it is an emission by its own words, and a reflectance or transmittance is needed");
  EXPECT_EQ(fault_of(paper, {0.1}, {}, Use::emission),
            "it is a reflectance by its own words, and an emission is needed");
  EXPECT_EQ(fault_of(paper, {0.1}, {.as = Quantity::emission}, Use::property),
            "it is an emission, and a reflectance or transmittance is needed");
}

TEST(Interpret, NeverTakesPercentsForOneInSilence) {
  const SpectrumFile silent{.format = "pairs"};
  const Interpreted guessed = taken(silent, {4, 80}, {}, Use::property);
  EXPECT_EQ(guessed.spectrum.values, (std::vector<double>{0.04, 0.8}));
  EXPECT_EQ(guessed.notes, Notes{"taken for percents, as the file's values reach 80"});
  EXPECT_EQ(taken(silent, {0.5, 0.8}, {.scale = Scale::percent}, Use::property).spectrum.values,
            (std::vector<double>{0.005, 0.008}));
  const SpectrumFile normed{.format = "CGATS", .scale = Scale::one};
  EXPECT_EQ(
      fault_of(normed, {0.5, 7}, {}, Use::property),
      "a reflectance must lie in 0..1 (it is 7 at 410 nm): above 1 is fluorescence, which clamp "
      "leaves out and Material.fluorescence models, or another scale");
  EXPECT_EQ(taken(silent, {4, 80}, {}, Use::emission).spectrum.values,
            (std::vector<double>{4, 80}));
}

TEST(Interpret, TakesAllSpectraOfAFileByOneScale) {
  const SpectrumFile file{.format = "pairs",
                          .spectra = {{"black", of({0.5, 0.8})}, {"white", of({85, 86})}},
                          .largest = 86};
  EXPECT_EQ(taken(file, {0.5, 0.8}, {}, Use::property).spectrum.values,
            (std::vector<double>{0.005, 0.008}));
  EXPECT_EQ(taken(file, {0.5, 0.8}, {}, Use::property).notes,
            Notes{"taken for percents, as the file's values reach 86"});
}

TEST(Interpret, ClampsOnRequestAndCounts) {
  const SpectrumFile silent{.format = "pairs"};
  EXPECT_EQ(fault_of(silent, {0.5, 1.1}, {}, Use::property),
            "a reflectance must lie in 0..1 (it is 1.1 at 410 nm): above 1 is fluorescence, which "
            "clamp leaves out and Material.fluorescence models, or another scale");
  const Interpreted paper = taken(silent, {0.5, 1.1, -0.01}, {.clamp = true}, Use::property);
  EXPECT_EQ(paper.spectrum.values, (std::vector<double>{0.5, 1, 0}));
  EXPECT_EQ(paper.notes, Notes{"2 of 3 values were outside 0..1 and are clamped"});
  EXPECT_EQ(
      fault_of(silent, {5, -0.01}, {}, Use::emission),
      "an emission must not be negative (it is -0.01 at 410 nm); clamp makes noise below 0 to 0");
  const Interpreted lamp = taken(silent, {5, -0.01}, {.clamp = true}, Use::emission);
  EXPECT_EQ(lamp.spectrum.values, (std::vector<double>{5, 0}));
  EXPECT_EQ(lamp.notes, Notes{"1 of 2 values were below 0 and are clamped"});
  EXPECT_EQ(taken(silent, {0.5, 1}, {.clamp = true}, Use::property).notes, Notes{});
}

TEST(Interpret, WhatNoEyeSeesIsOfNoUse) {
  const SpectrumFile silent{.format = "pairs"};
  const std::string why = "its wavelengths, 900 to 2500 nm, are none that an eye sees";
  const Spectrum infrared{{900, 2500}, {0.1, 0.2}};
  const auto far = interpret(silent, infrared, {}, Use::any);
  ASSERT_TRUE(far);
  EXPECT_EQ(far->notes.back(), why);
  for (const Use use : {Use::emission, Use::property}) {
    const auto used = interpret(silent, infrared, {}, use);
    ASSERT_FALSE(used);
    EXPECT_EQ(used.error().message, why + "; are they in another unit?");
  }
}

TEST(Interpret, ALampThatLooksLikeAReflectanceIsNoted) {
  const SpectrumFile silent{.format = "pairs"};
  const auto notes = [&](std::vector<double> nm, std::vector<double> values) {
    const auto lamp = interpret(silent, Spectrum{nm, values}, {}, Use::emission);
    return lamp ? lamp->notes : Notes{lamp.error().message};
  };
  EXPECT_EQ(notes({400, 700}, {0.2, 0.9}),
            Notes{"taken for an emission, though its values lie in 0..1, as a reflectance's"});
  EXPECT_EQ(notes({400, 700}, {0.2, 1}), Notes{}) << "normalised";
  EXPECT_EQ(notes({400, 700}, {0, 0.9}), Notes{}) << "no paint is black all over";
  EXPECT_EQ(notes({400, 700}, {0.2, 9}), Notes{});
  EXPECT_EQ(notes({546}, {0.2}), Notes{}) << "a line";
  const auto said = interpret(silent, Spectrum{{400, 700}, {0.2, 0.9}}, {.as = Quantity::emission},
                              Use::emission);
  EXPECT_EQ(said->notes, Notes{});
}

TEST(Interpret, ALampInPercentsIsNoted) {
  const SpectrumFile percents{.format = "table", .scale = Scale::percent, .largest = 90};
  const auto lamp = interpret(percents, Spectrum{{400, 700}, {90, 10}}, {}, Use::emission);
  ASSERT_TRUE(lamp);
  EXPECT_EQ(lamp->notes, Notes{"taken for an emission, though the file is in percents"});
}

}  // namespace
}  // namespace metamer
