#include "common/color/chain_panels.h"

#include <algorithm>
#include <cmath>

#include "common/color/seen_shares.h"

namespace metamer {
namespace {

/// Of what is seen, the error of a panel, or between two edges, may be this share. Errors are of
/// either sign, and those of a scene's longest chains stay below 1e-5.
constexpr double tolerance = 5e-7;
/// A value is off relative to itself, or to this share of its panel's largest.
constexpr double darkest = 1e-3;
/// No panel is cut below it, nm.
constexpr double narrowest = 1e-3;

double power(double value, unsigned exponent) {
  double result = 1;
  for (; exponent > 0; exponent >>= 1, value *= value)
    if (exponent & 1) result *= value;
  return result;
}

/// Chooses panels from the left: of each the degree that has the fewest nodes for its length.
class PanelChoice {
 public:
  PanelChoice(const std::vector<const Spectrum*>& curves, unsigned times,
              const std::vector<SeenLight>& lights, std::size_t axis,
              const std::vector<const Spectrum*>& once);

  Panels choose();

 private:
  /// A power of one of the curves, by itself: other products bend no more.
  struct Probe {
    std::size_t curve;
    unsigned power;
    SeenShares seen;
  };

  std::vector<double> probes_at(double nm) const;
  std::vector<double> check_points(const std::vector<double>& nodes) const;
  bool fits(std::size_t first, std::size_t last, std::size_t degree) const;
  std::size_t farthest(std::size_t first, std::size_t start, std::size_t degree) const;
  bool extend(std::size_t& first, Panels& panels) const;

  std::vector<double> grid_;  ///< Of the curves' values.
  std::vector<std::vector<double>> curves_;
  std::vector<Probe> probes_;
  std::vector<double> ends_;  ///< Where panels may end.
};

std::vector<const Spectrum*> together(std::vector<const Spectrum*> some,
                                      const std::vector<const Spectrum*>& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

PanelChoice::PanelChoice(const std::vector<const Spectrum*>& curves, unsigned times,
                         const std::vector<SeenLight>& lights, std::size_t axis,
                         const std::vector<const Spectrum*>& once)
    : grid_(dense_nm(together(curves, once))), ends_(cell_edges(together(curves, once))) {
  const SeenAmounts amounts(lights, grid_);
  std::vector<unsigned> powers{1};
  for (const unsigned more : {static_cast<unsigned>(std::lround(std::sqrt(times))), times})
    if (more > powers.back()) powers.push_back(more);
  for (const Spectrum* spectrum : together(curves, once)) {
    const bool is_once = curves_.size() >= curves.size();
    curves_.push_back(resample(*spectrum, grid_, Outside::hold).values);
    for (const unsigned one : is_once ? std::vector<unsigned>{1} : powers) {
      std::vector<double> values = curves_.back();
      for (double& value : values) value = power(value, one);
      probes_.push_back({curves_.size() - 1, one, amounts.shares(values, {axis})});
    }
  }
}

std::vector<double> PanelChoice::probes_at(double nm) const {
  const std::size_t i = place_in(grid_, nm);
  const double t = (nm - grid_[i]) / (grid_[i + 1] - grid_[i]);
  std::vector<double> values;
  values.reserve(probes_.size());
  for (const Probe& probe : probes_) {
    const std::vector<double>& curve = curves_[probe.curve];
    values.push_back(power((1 - t) * curve[i] + t * curve[i + 1], probe.power));
  }
  return values;
}

/// Half way between nodes, and where the curves may bend.
std::vector<double> PanelChoice::check_points(const std::vector<double>& nodes) const {
  std::vector<double> points;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    points.push_back((nodes[i] + nodes[i + 1]) / 2);
  for (std::size_t i = place_in(grid_, nodes.front()) + 1; grid_[i] < nodes.back(); ++i)
    points.push_back(grid_[i]);
  return points;
}

bool PanelChoice::fits(std::size_t first, std::size_t last, std::size_t degree) const {
  const double from = ends_[first], to = ends_[last];
  const std::vector<double> nodes = panel_nodes(from, to, degree);
  std::vector<std::vector<double>> at_node;
  std::vector<double> largest(probes_.size()), allowed;
  for (const double nm : nodes) {
    at_node.push_back(probes_at(nm));
    for (std::size_t p = 0; p < probes_.size(); ++p)
      largest[p] = std::max(largest[p], at_node.back()[p]);
  }
  for (const Probe& probe : probes_) allowed.push_back(tolerance / probe.seen.between(from, to));

  for (const double nm : check_points(nodes)) {
    const Lagrange worth = lagrange(nm, nodes);
    const std::vector<double> truth = probes_at(nm);
    for (std::size_t p = 0; p < probes_.size(); ++p) {
      double value = 0;
      for (std::size_t i = 0; i <= degree; ++i) value += worth[i] * at_node[i][p];
      if (std::abs(value - truth[p]) > allowed[p] * std::max(truth[p], darkest * largest[p]))
        return false;
    }
  }
  return true;
}

/// The last end that a panel from `first` may have, which is at least `start`; else `first`.
std::size_t PanelChoice::farthest(std::size_t first, std::size_t start, std::size_t degree) const {
  if (start >= ends_.size() || !fits(first, start, degree)) return first;
  std::size_t good = start, step = 1;
  for (; good + step < ends_.size() && fits(first, good + step, degree); step *= 2) good += step;
  for (; step > 0; step /= 2)
    if (good + step < ends_.size() && fits(first, good + step, degree)) good += step;
  return good;
}

bool PanelChoice::extend(std::size_t& first, Panels& panels) const {
  std::size_t best = first, best_degree = 1;
  for (const std::size_t degree : {1u, 2u, 3u, 4u, 6u, 8u}) {
    const double least = ends_[first] + (ends_[best] - ends_[first]) /
                                            static_cast<double>(best_degree) *
                                            static_cast<double>(degree);
    const auto start = std::upper_bound(ends_.begin(), ends_.end(), least) - ends_.begin();
    const std::size_t last = farthest(first, static_cast<std::size_t>(start), degree);
    if (last == first) continue;
    best = last;
    best_degree = degree;
  }
  if (best == first) return false;
  panels.edges.push_back(ends_[best]);
  panels.degree.push_back(best_degree);
  first = best;
  return true;
}

Panels PanelChoice::choose() {
  Panels panels;
  panels.edges.push_back(ends_.front());
  for (std::size_t first = 0; first + 1 < ends_.size();) {
    if (extend(first, panels)) continue;
    // Not even the next cell fits: halve it.
    const double width = ends_[first + 1] - ends_[first];
    if (width > narrowest) {
      ends_.insert(ends_.begin() + static_cast<std::ptrdiff_t>(first + 1),
                   ends_[first] + width / 2);
      continue;
    }
    panels.edges.push_back(ends_[++first]);
    panels.degree.push_back(Panels::max_degree);
  }
  return panels;
}

/// By edge: the largest change of slope there, relative to the values about it, 1/nm.
std::vector<double> relative_bends(const std::vector<const Spectrum*>& spectra,
                                   const std::vector<double>& edges) {
  std::vector<double> bends(edges.size());
  for (const Spectrum* spectrum : spectra) {
    const auto& [nm, values] = *spectrum;
    std::size_t at = 0;
    double before = 0;  // the slope
    for (std::size_t i = 0; i < nm.size(); ++i) {
      const bool is_last = i + 1 == nm.size();
      const double after = is_last ? 0 : (values[i + 1] - values[i]) / (nm[i + 1] - nm[i]);
      const double scale = std::max(
          {std::abs(values[i]), std::abs(values[i - (i > 0)]), std::abs(values[i + !is_last])});
      while (at + 1 < edges.size() && edges[at] < nm[i]) ++at;
      if (after != before && nm[i] > edges.front() && nm[i] < edges.back())
        bends[at] = std::max(bends[at], std::abs(after - before) / scale);
      before = after;
    }
  }
  return bends;
}

}  // namespace

Panels chain_panels(const std::vector<const Spectrum*>& curves, unsigned times,
                    const std::vector<SeenLight>& lights, std::size_t axis,
                    const std::vector<const Spectrum*>& once) {
  if ((curves.empty() && once.empty()) || times == 0)
    return {{observer_from_nm, observer_to_nm}, {1}};
  return PanelChoice(curves, times, lights, axis, once).choose();
}

std::vector<double> bend_edges(const std::vector<const Spectrum*>& spectra,
                               const std::vector<SeenLight>& lights) {
  const std::vector<double> all = cell_edges(spectra), bends = relative_bends(spectra, all);
  const SeenShares seen =
      SeenAmounts(lights, all).shares(std::vector<double>(all.size(), 1.0), {0, 1, 2});
  std::vector<double> edges{all.front()};
  for (std::size_t first = 0; first + 1 < all.size();) {
    // How far they are from the line to `last`, at most: each bend by itself.
    double sum = 0, moment = 0;
    std::size_t last = first + 1;
    for (; last + 1 < all.size(); ++last) {
      sum += bends[last] * (all[last] - all[first]);
      moment += bends[last] * (all[last] - all[first]) * all[last];
      const double to = all[last + 1], off = (sum * to - moment) / (to - all[first]);
      if (off * seen.between(all[first], to) > tolerance) break;
    }
    edges.push_back(all[last]);
    first = last;
  }
  return edges;
}

std::vector<double> dense_nm(const std::vector<const Spectrum*>& spectra) {
  const std::vector<double> edges = cell_edges(spectra);
  std::vector<double> dense;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    dense.push_back(edges[i]);
    if (edges[i + 1] - edges[i] > 0.5) dense.push_back((edges[i] + edges[i + 1]) / 2);
  }
  dense.push_back(edges.back());
  return dense;
}

}  // namespace metamer
