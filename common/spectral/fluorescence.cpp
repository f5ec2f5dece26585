#include "common/spectral/fluorescence.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "common/spectral/cells.h"
#include "common/spectral/lines.h"

namespace metamer {
namespace {

/// The union of rising lists, from `from` to `to` with both.
std::vector<double> joined(std::initializer_list<const std::vector<double>*> lists, double from,
                           double to) {
  std::vector<double> all{from, to};
  for (const std::vector<double>* list : lists)
    for (const double nm : *list)
      if (nm > from && nm < to) all.push_back(nm);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Gauss and Legendre's two points of each cell.
Wavelengths points_of(const std::vector<double>& edges) {
  std::vector<double> nm, widths;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double half = (edges[i + 1] - edges[i]) / 2, middle = edges[i] + half;
    for (const double sign : {-1, 1}) {
      nm.push_back(middle + sign * half / std::sqrt(3));
      widths.push_back(half);
    }
  }
  return Wavelengths::weighted(std::move(nm), std::move(widths));
}

/// Where light excites it, as far as its data go.
std::array<double, 2> data_range(const std::vector<double>& excitation) {
  return {std::max(excitation.front(), excitation_from_nm),
          std::min(excitation.back(), excitation_to_nm)};
}

std::vector<double> at(const Spectrum& spectrum, const std::vector<double>& nm) {
  return resample(spectrum, nm, Outside::zero).values;
}

/// ∫ emission(λ) λ dλ up to each of its samples: photons, but for a factor.
std::vector<double> photons_up_to(const Spectrum& emission) {
  std::vector<double> sums{0};
  for (std::size_t i = 1; i < emission.nm.size(); ++i) {
    const double a = emission.nm[i - 1], b = emission.nm[i];
    const double p = emission.values[i - 1], q = emission.values[i];
    sums.push_back(sums.back() + (b - a) * (2 * a * p + a * q + b * p + 2 * b * q) / 6);
  }
  return sums;
}

/// Each whole nanometre that is seen or excites.
std::vector<double> whole_nm() {
  std::vector<double> nm;
  for (double at = excitation_from_nm; at <= excitation_to_nm; ++at) nm.push_back(at);
  return nm;
}

/// Where E is a line between: the emission's samples, and where it overlaps the excitation whatever
/// changes there.
std::vector<double> emitted_nm(const Fluorophore& of, const Spectrum& light) {
  const auto [from, to] = data_range(of.excitation.nm);
  std::vector<double> inside;
  const std::vector<double> whole = whole_nm();
  for (const std::vector<double>* list : {&whole, &of.excitation.nm, &light.nm})
    for (const double nm : *list)
      if (nm >= from && nm <= to) inside.push_back(nm);
  std::sort(inside.begin(), inside.end());
  return joined({&of.emission.nm, &inside}, of.emission.nm.front(), of.emission.nm.back());
}

Spectrum reradiated_by(const Fluorophore& of, const Spectrum& light) {
  Spectrum out{emitted_nm(of, light), {}};
  out.values.assign(out.nm.size(), 0.0);
  const auto [from, to] = data_range(of.excitation.nm);
  if (!(to > from)) return out;

  // Sum what is absorbed at shorter wavelengths than each.
  const std::vector<double> edges = joined({&of.excitation.nm, &light.nm, &out.nm}, from, to);
  const Wavelengths points = points_of(edges);
  const std::vector<double> absorbed = at(of.excitation, points.nm()),
                            power = at(light, points.nm());
  const std::vector<double> emission = at(of.emission, out.nm);
  const double scale = of.quantum_yield / photons_up_to(of.emission).back();
  double sum = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < out.nm.size(); ++i) {
    for (; next < points.size() && points.nm()[next] < out.nm[i]; ++next)
      sum += absorbed[next] * power[next] * points.nm()[next] * points.widths()[next];
    out.values[i] = scale * emission[i] * sum;
  }
  return out;
}

/// A place among rising numbers, and the next one's share there; nothing outside.
struct Between {
  std::size_t first;
  double share;
};
std::optional<Between> between(const std::vector<double>& nm, double at) {
  if (at < nm.front() || at > nm.back()) return std::nullopt;
  const auto next = std::upper_bound(nm.begin(), nm.end() - 1, at) - nm.begin();
  const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - 1, 0));
  return Between{first, (at - nm[first]) / (nm[first + 1] - nm[first])};
}

/// M(λ, μ) of a table, on both sides of the diagonal.
double table_at(const BispectralMatrix& of, double emitted, double excited) {
  const auto row = between(of.excitation, excited), column = between(of.emission, emitted);
  if (!row || !column) return 0;
  const auto in_row = [&](std::size_t i) {
    const double* values = &of.values[i * of.emission.size() + column->first];
    return values[0] + column->share * (values[1] - values[0]);
  };
  return in_row(row->first) + row->share * (in_row(row->first + 1) - in_row(row->first));
}

double longest_step(const std::vector<double>& nm) {
  double longest = 0;
  for (std::size_t i = 1; i < nm.size(); ++i) longest = std::max(longest, nm[i] - nm[i - 1]);
  return longest;
}

/// How far below the diagonal lines between a table's values may reach; 0: they do not.
double reach_below(const BispectralMatrix& of) {
  const auto& [excitation, emission, values] = of;
  for (std::size_t i = 0; i < excitation.size(); ++i)
    for (std::size_t j = 0; j < emission.size(); ++j)
      if (values[i * emission.size() + j] > 0 &&
          emission[j > 0 ? j - 1 : 0] < excitation[std::min(i + 1, excitation.size() - 1)])
        return longest_step(excitation) + 2 * longest_step(emission);
  return 0;
}

/// Nothing is re-radiated at a shorter wavelength (G. G. Stokes, Phil. Trans. 142, 463 (1852)), but
/// the lines m between values beside the diagonal, which are means over what lies above it, go on
/// below it. That is added above, as far from the diagonal,
///
///     M(λ, μ) = m(λ, μ) + m(2μ − λ, μ)   where λ ≥ μ,   0 where λ < μ
///
/// so that light of each wavelength sends out as much as the table says. `lines`: E by m.
Spectrum turned_up(const BispectralMatrix& of, const Spectrum& light, const Spectrum& lines,
                   double reach) {
  const auto [from, to] = data_range(of.excitation);
  const std::vector<double> whole = whole_nm();
  Spectrum out{joined({&whole, &of.excitation, &light.nm, &lines.nm},
                      std::min(from - reach, lines.nm.front()),
                      std::max(std::min(to, lines.nm.back()) + reach, lines.nm.back())),
               {}};
  std::erase_if(out.nm, [&](double nm) {
    const bool near = nm >= from - reach && nm <= to + reach && nm >= lines.nm.front();
    return !near && !std::binary_search(lines.nm.begin(), lines.nm.end(), nm);
  });
  out.values = at(lines, out.nm);
  const Wavelengths points = points_of(joined({&of.excitation, &light.nm, &out.nm}, from, to));
  const std::vector<double> power = at(light, points.nm());
  for (std::size_t i = 0; i < out.nm.size(); ++i) {
    const double nm = out.nm[i];
    const auto begin = std::lower_bound(points.nm().begin(), points.nm().end(), nm - reach);
    for (auto k = static_cast<std::size_t>(begin - points.nm().begin());
         k < points.size() && points.nm()[k] <= nm + reach; ++k) {
      const double excited = points.nm()[k];
      const double moved =
          nm < excited ? -table_at(of, nm, excited) : table_at(of, 2 * excited - nm, excited);
      out.values[i] += moved * power[k] * points.widths()[k];
    }
    out.values[i] = std::max(out.values[i], 0.0);
  }
  return out;
}

Spectrum reradiated_by(const BispectralMatrix& of, const Spectrum& light) {
  const auto [from, to] = data_range(of.excitation);
  const Wavelengths points = points_of(joined({&of.excitation, &light.nm}, from, to));
  const std::vector<double> power =
      shares(at(light, points.nm()), points, of.excitation, Outside::zero);
  Spectrum out{of.emission, std::vector<double>(of.emission.size())};
  for (std::size_t i = 0; i < power.size(); ++i)
    for (std::size_t j = 0; j < out.values.size(); ++j)
      out.values[j] += power[i] * of.values[i * out.values.size() + j];
  const double reach = reach_below(of);
  return reach > 0 && to > from ? turned_up(of, light, out, reach) : out;
}

/// The share of the emission's photons at `nm` and beyond.
double photons_beyond(const Spectrum& emission, const std::vector<double>& up_to, double nm) {
  if (nm <= emission.nm.front()) return 1;
  if (nm >= emission.nm.back()) return 0;
  const auto right = static_cast<std::size_t>(
      std::upper_bound(emission.nm.begin(), emission.nm.end(), nm) - emission.nm.begin());
  const double a = emission.nm[right - 1], p = emission.values[right - 1];
  const double q = resample(emission, {nm}, Outside::zero).values.front();
  const double sum = up_to[right - 1] + (nm - a) * (2 * a * p + a * q + nm * p + 2 * nm * q) / 6;
  return 1 - sum / up_to.back();
}

/// ∫ emission(λ) dλ from `nm` on.
double power_beyond(const Spectrum& emission, double nm) {
  double sum = 0;
  for (std::size_t i = 1; i < emission.nm.size(); ++i) {
    if (emission.nm[i] <= nm) continue;
    const double a = std::max(nm, emission.nm[i - 1]), b = emission.nm[i];
    const double p = resample(emission, {a}, Outside::zero).values.front();
    sum += (b - a) * (p + emission.values[i]) / 2;
  }
  return sum;
}

std::vector<double> shares_of(const Fluorophore& of, const std::vector<double>& nm) {
  const double photons = photons_up_to(of.emission).back();
  const auto [from, to] = data_range(of.excitation.nm);
  std::vector<double> shares = at(of.excitation, nm);
  for (std::size_t i = 0; i < nm.size(); ++i)
    shares[i] *= nm[i] >= from && nm[i] <= to
                     ? of.quantum_yield * nm[i] * power_beyond(of.emission, nm[i]) / photons
                     : 0;
  return shares;
}

std::vector<double> shares_of(const BispectralMatrix& of, const std::vector<double>& nm) {
  const std::vector<double> widths = hat_widths(of.emission);
  Spectrum sums{of.excitation, {}};
  for (std::size_t i = 0; i < of.excitation.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < widths.size(); ++j)
      sum += widths[j] * of.values[i * widths.size() + j];
    sums.values.push_back(sum);
  }
  return at(sums, nm);
}

const std::vector<double>& excitation_nm(const Fluorophore& of) { return of.excitation.nm; }
const std::vector<double>& excitation_nm(const BispectralMatrix& of) { return of.excitation; }

}  // namespace

Spectrum reradiated(const Fluorescence& fluorescence, const Spectrum& light) {
  return std::visit([own = as_emission(light)](const auto& of) { return reradiated_by(of, own); },
                    fluorescence);
}

std::vector<double> reradiated_shares(const Fluorescence& fluorescence,
                                      const std::vector<double>& nm) {
  return std::visit([&](const auto& of) { return shares_of(of, nm); }, fluorescence);
}

std::optional<std::array<double, 2>> excited_range(const Fluorescence& fluorescence) {
  const std::vector<double>& nm = std::visit(
      [](const auto& of) -> const std::vector<double>& { return excitation_nm(of); }, fluorescence);
  const auto [from, to] = data_range(nm);
  if (!(to > from)) return std::nullopt;
  const std::vector<double> positions = joined({&nm}, from, to);
  const std::vector<double> shares = reradiated_shares(fluorescence, positions);
  const auto excites = [](double share) { return share > 0; };
  const auto first = std::find_if(shares.begin(), shares.end(), excites) - shares.begin();
  const auto last = shares.rend() - std::find_if(shares.rbegin(), shares.rend(), excites);
  if (last == 0) return std::nullopt;
  // A line rises from the sample before the first that is not 0.
  const auto before = static_cast<std::size_t>(std::max<std::ptrdiff_t>(first - 1, 0));
  const auto behind = std::min(static_cast<std::size_t>(last), positions.size() - 1);
  return std::array{positions[before], positions[behind]};
}

std::optional<std::string> energy_fault(const Fluorescence& fluorescence, const Spectrum& diffuse) {
  constexpr double rounding = 1e-6;
  std::vector<double> nm = whole_nm();
  for (const double one :
       std::visit([](const auto& of) -> const std::vector<double>& { return excitation_nm(of); },
                  fluorescence))
    nm.push_back(one);
  nm.insert(nm.end(), diffuse.nm.begin(), diffuse.nm.end());
  std::sort(nm.begin(), nm.end());
  const std::vector<double> shares = reradiated_shares(fluorescence, nm);
  const std::vector<double> reflected = resample(diffuse, nm, Outside::hold).values;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < nm.size(); ++i)
    if (shares[i] > 0 && shares[i] + reflected[i] > shares[worst] + reflected[worst]) worst = i;
  if (!(shares[worst] > 0) || shares[worst] + reflected[worst] <= 1 + rounding) return std::nullopt;
  char text[200];
  std::snprintf(text, sizeof text,
                "more light comes out than in at %g nm: %.4g is reflected and %.4g re-radiated, in "
                "sum at most 1",
                nm[worst], reflected[worst], shares[worst]);
  return text;
}

double left_out_share(const Fluorophore& of) {
  const auto [from, to] = data_range(of.excitation.nm);
  if (!(to > from)) return 0;
  const std::vector<double> whole = whole_nm(), up_to = photons_up_to(of.emission);
  const Wavelengths points = points_of(joined({&of.excitation.nm, &whole}, from, to));
  const std::vector<double> absorbed = at(of.excitation, points.nm());
  double all = 0, left_out = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double photons = absorbed[i] * points.nm()[i] * points.widths()[i];
    all += photons;
    left_out += photons * (1 - photons_beyond(of.emission, up_to, points.nm()[i]));
  }
  return all > 0 ? left_out / all : 0;
}

}  // namespace metamer
