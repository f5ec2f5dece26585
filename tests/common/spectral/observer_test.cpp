#include "common/spectral/observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/spectral/cie.h"

namespace metamer {
namespace {

/// The same table thrice, of ȳ alone or of all.
Observer::Functions tables(Spectrum table) { return {table, table, table}; }

std::string fault_of(const Observer::Functions& functions) {
  const auto fault = observer_fault(functions);
  return fault.value_or("none");
}

/// Every fifth value, from 360 nm on.
Spectrum every_fifth(const Spectrum& by_1_nm) {
  Spectrum table;
  for (std::size_t i = 0; i < by_1_nm.nm.size(); i += 5) {
    table.nm.push_back(by_1_nm.nm[i]);
    table.values.push_back(by_1_nm.values[i]);
  }
  return table;
}

TEST(Observer, OfTheCiesTablesBy5NmIsTheCiesToTheBit) {
  for (const Observer& cie : {cie::observer_1931(), cie::observer_1964()}) {
    Observer::Functions by_5;
    for (std::size_t i = 0; i < 3; ++i) by_5[i] = every_fifth(cie.functions()[i]);
    const Result<Observer> own = make_observer("own", by_5);
    ASSERT_TRUE(own) << own.error().message;
    EXPECT_EQ(own->functions(), cie.functions());
    EXPECT_TRUE(*own == cie);
    EXPECT_EQ(own->name(), "own");
    EXPECT_FALSE(own->is_cut());
  }
  EXPECT_FALSE(cie::observer_1931() == cie::observer_1964());
}

TEST(Observer, KeepsItsSamplesWhateverTheStep) {
  for (const double step : {1.5, 2.0, 2.5, 5.0, 10.0, 7.0}) {
    Spectrum table;
    for (double nm = 400; nm <= 700; nm += step) {
      table.nm.push_back(nm);
      table.values.push_back(std::exp(-std::pow((nm - 550) / 60, 2)));
    }
    const Spectrum fine = matching_function(table);
    EXPECT_GT(fine.nm.size(), table.nm.size());
    const Resampled at = resample(fine, table.nm, Outside::zero);
    for (std::size_t i = 0; i < table.nm.size(); ++i)
      EXPECT_NEAR(at.values[i], table.values[i], 1e-12) << step;
    for (std::size_t i = 0; i < fine.nm.size(); ++i)
      EXPECT_NEAR(fine.values[i], std::exp(-std::pow((fine.nm[i] - 550) / 60, 2)), 2e-4) << step;
  }
}

TEST(Observer, OfAFineUnevenOrShortTableIsStraightLines) {
  const Spectrum by_1{{500, 501, 502, 503, 504, 505, 506}, {0, 1, 0, 3, 0, 1, 0}};
  EXPECT_EQ(matching_function(by_1), by_1);
  const Spectrum uneven{{500, 510, 520, 530, 540, 551, 560}, {0, 1, 0, 3, 0, 1, 0}};
  EXPECT_EQ(matching_function(uneven), uneven);
  const Spectrum five{{500, 510, 520, 530, 540}, {0, 1, 0, 3, 0}};
  EXPECT_EQ(matching_function(five), five);
}

TEST(Observer, DoesNotFallBelowZeroOrItsTable) {
  const Spectrum peak{{500, 510, 520, 530, 540, 550, 560}, {0, 0, 0, 1, 0, 0, 0}};
  for (const double value : matching_function(peak).values) EXPECT_GE(value, 0);
  const Spectrum dip{{500, 510, 520, 530, 540, 550, 560}, {1, 1, -0.01, 1, 1, 1, 1}};
  for (const double value : matching_function(dip).values) EXPECT_GE(value, -0.01);
}

TEST(Observer, SeesFrom360To830NmAlone) {
  const auto wide = make_observer("wide", tables({{300, 400, 800, 900}, {1, 2, 2, 1}}));
  ASSERT_TRUE(wide);
  EXPECT_TRUE(wide->is_cut());
  const Spectrum seen{{360, 400, 800, 830}, {1.6, 2, 2, 1.7}};
  for (const Spectrum& function : wide->functions()) {
    EXPECT_EQ(function.nm, seen.nm);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(function.values[i], seen.values[i], 1e-12);
  }
  // Zeros beyond are no loss.
  const auto dark = make_observer("dark", tables({{300, 359, 400, 900}, {0, 0, 2, 0}}));
  ASSERT_TRUE(dark);
  EXPECT_FALSE(dark->is_cut());
  // A function of which nothing is left is 0.
  const auto two = make_observer(
      "two", {Spectrum{{900, 1000}, {1, 1}}, {{500, 600}, {1, 1}}, Spectrum{{900, 1000}, {1, 1}}});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->functions()[0].values, (std::vector<double>{0, 0}));
}

TEST(Observer, NamesWhatIsNone) {
  const Spectrum good{{500, 600}, {1, 1}};
  EXPECT_EQ(fault_of(tables(good)), "none");
  EXPECT_EQ(fault_of({good, Spectrum{{500}, {1}}, good}),
            "an observer needs two wavelengths at least");
  EXPECT_EQ(fault_of({good, Spectrum{{500, 600}, {1, -1e-9}}, good}),
            "ȳ must not be negative (it is -1e-09 at 600 nm)");
  EXPECT_EQ(fault_of({good, Spectrum{{500, 600}, {0, 0}}, good}),
            "ȳ must be above 1e-6 somewhere between 360 and 830 nm");
  EXPECT_EQ(fault_of({good, Spectrum{{900, 1000}, {1, 1}}, good}),
            "ȳ must be above 1e-6 somewhere between 360 and 830 nm");
  EXPECT_EQ(fault_of({good, good, Spectrum{{500, 600}, {1, 2e6}}}),
            "z̄ must not be above 1e6 in size (it is 2e+06 at 600 nm)");
  EXPECT_EQ(fault_of({Spectrum{{500, 600}, {1, -0.02}}, good, good}),
            "x̄ must not be below -1 % of its largest value: is this no x̄ ȳ z̄? (it is -0.02 at "
            "600 nm)");
  // What rounded transformations of cone fundamentals have.
  EXPECT_EQ(fault_of({Spectrum{{500, 600}, {1, -0.01}}, good, good}), "none");
  EXPECT_EQ(fault_of({Spectrum{{500, 600}, {-1, -1}}, good, good}).substr(0, 21),
            "x̄ must not be below");
}

}  // namespace
}  // namespace metamer
