#include "common/spectral/observer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/spectral/sprague.h"

namespace metamer {
namespace {

constexpr std::array<const char*, 3> function_names = {"x̄", "ȳ", "z̄"};
constexpr double largest_size = 1e6, faintest = 1e-6;
constexpr double least_share = -0.01;  ///< Of the largest value of x̄ or z̄.

bool is_seen_at(double nm) { return nm >= observer_from_nm && nm <= observer_to_nm; }

double largest_of(const Spectrum& function) {
  return *std::max_element(function.values.begin(), function.values.end());
}

/// What is wrong with a sample of a function of that number; empty: nothing.
std::string sample_fault(std::size_t function, double value, double largest) {
  const std::string name = function_names[function];
  if (!(std::abs(value) <= largest_size)) return name + " must not be above 1e6 in size";
  if (function == 1 && value < 0) return name + " must not be negative";
  if (value < std::min(0.0, least_share * largest))
    return name + " must not be below -1 % of its largest value: is this no x̄ ȳ z̄?";
  return {};
}

/// Between 360 and 830 nm; 0 where the table has nothing there.
Spectrum seen_part(const Spectrum& function) {
  Spectrum result;
  for (const double end : {observer_from_nm, observer_to_nm})
    if (function.nm.front() < end && end < function.nm.back()) result.nm.push_back(end);
  std::copy_if(function.nm.begin(), function.nm.end(), std::back_inserter(result.nm), is_seen_at);
  std::sort(result.nm.begin(), result.nm.end());
  result.nm.erase(std::unique(result.nm.begin(), result.nm.end()), result.nm.end());
  if (result.nm.size() < 2) return {{observer_from_nm, observer_to_nm}, {0, 0}};
  result.values = resample(function, result.nm, Outside::zero).values;
  return result;
}

bool sees_beyond(const Spectrum& function) {
  for (std::size_t i = 0; i < function.nm.size(); ++i)
    if (!is_seen_at(function.nm[i]) && function.values[i] != 0) return true;
  return false;
}

}  // namespace

Observer::Observer(std::string name, Functions functions, bool is_cut)
    : data_(std::make_shared<const Data>(Data{std::move(name), std::move(functions), is_cut})) {}

Spectrum matching_function(const Spectrum& table) {
  // The samples are kept: they are at whole steps of the finer grid.
  const double count = static_cast<double>(table.nm.size()),
               step = count > 1 ? (table.nm.back() - table.nm.front()) / (count - 1) : 0;
  if (!(step > 1 + 1e-6)) return table;
  const auto positions =
      Wavelengths::uniform(table.nm.front(), table.nm.back(), step / std::ceil(step));
  if (!positions || sprague_fault(table)) return table;
  Spectrum fine{positions->nm(), *sprague(table, positions->nm())};

  // The polynomial goes below 0 beside zeros, the function does not.
  const double least = std::min(0.0, *std::min_element(table.values.begin(), table.values.end()));
  for (double& value : fine.values) value = std::max(value, least);
  return fine;
}

std::optional<std::string> observer_fault(const Observer::Functions& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Spectrum& table = tables[i];
    if (table.nm.size() < 2) return "an observer needs two wavelengths at least";
    for (std::size_t k = 0; k < table.nm.size(); ++k)
      if (std::string wrong = sample_fault(i, table.values[k], largest_of(table)); !wrong.empty())
        return std::move(wrong) + " (it is " + number_text(table.values[k]) + " at " +
               number_text(table.nm[k]) + " nm)";
  }
  if (largest_of(seen_part(tables[1])) < faintest)
    return "ȳ must be above 1e-6 somewhere between 360 and 830 nm";
  return std::nullopt;
}

Result<Observer> make_observer(std::string name, const Observer::Functions& tables) {
  if (auto fault = observer_fault(tables)) return problem(std::move(*fault));
  Observer::Functions functions;
  for (std::size_t i = 0; i < tables.size(); ++i)
    functions[i] = seen_part(matching_function(tables[i]));
  return Observer(std::move(name), std::move(functions),
                  std::any_of(tables.begin(), tables.end(), sees_beyond));
}

}  // namespace metamer
