// The picture of a trade: cost against error, both logarithmic.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "client/cli/commands/tradeoff/tradeoff_texts.h"
#include "client/cli/output/gnuplot.h"
#include "common/problem.h"
#include "common/scene/methods.h"

namespace metamer::cli {
namespace {

using client::Tradeoff;
using client::TradeoffRow;

/// ΔE00 that nobody can see and f32 hardly tells; smaller ones are drawn here, because a logarithm
/// has no zero.
constexpr double floor_of_errors = 1e-4;

/// The cases that share a mark, and how it looks; Okabe's and Ito's colours.
struct Family {
  std::string method, ending, title, color;
  int mark;  ///< gnuplot's point type.
};

std::vector<Family> families_of(const Tradeoff& tradeoff) {
  std::vector<Family> families = {
      {"rgb", "", "rgb", "#000000", 5},
      {"prefilter", "", "prefilter", "#CC79A7", 13},
      {"exact", "", "exact", "#D55E00", 11},
      {"linear", "bases", "linear", "#0072B2", 6},
      {"linear", "observer", "linear, weighted by the observer", "#56B4E9", 7},
      {"point", "uniform", "point, uniform", "#009E73", 8},
      {"point", "fitted", "point, fitted", "#E69F00", 9}};
  int mark = 0;  // of those that have no look of their own
  for (const TradeoffRow& row : tradeoff.rows)
    if (std::none_of(families.begin(), families.end(),
                     [&](const Family& family) { return family.method == row.what.method; }))
      families.push_back({row.what.method, "", row.what.method, "#F0E442", ++mark});
  return families;
}

bool belongs(const TradeoffRow& row, const Family& family) {
  return row.failure.empty() && row.what.method == family.method &&
         row.what.parameters.ends_with(family.ending);
}

double shown(double error) { return std::max(error, floor_of_errors); }

/// seconds, 95th percentile, and the line from the mean to the maximum.
std::string data_line(const TradeoffRow& row) {
  const ErrorStatistics& error = row.error;
  std::string line = number_text(row.seconds());
  for (const double value : {error.percentile_95, std::min(error.mean, error.percentile_95),
                             std::max(error.maximum, error.percentile_95)})
    line += " " + number_text(shown(value));
  return line + "\n";
}

std::string label(const TradeoffRow& row) {
  return "set label " + gnuplot_quote(method_text(row.what.settings)) + " at " +
         number_text(row.seconds()) + "," + number_text(shown(row.error.percentile_95)) +
         " left rotate by 25 offset 0.6,0.5 front font ',10'\n";
}

std::string heading(const Tradeoff& tradeoff) {
  const v1::Plan& plan = tradeoff.plan;
  std::array<char, 300> text{};
  std::snprintf(text.data(), text.size(),
                "%u × %u pixels, %u samples each, %u threads; the quickest of %u round%s; "
                "white X %.4f Y %.4f Z %.4f; reference: exact",
                plan.width(), plan.height(), plan.spp(), plan.threads(), tradeoff.rounds,
                tradeoff.rounds == 1 ? "" : "s", tradeoff.white[0], tradeoff.white[1],
                tradeoff.white[2]);
  return "set title " + gnuplot_quote("Cost and error of every method: " + tradeoff.scene) +
         " font ',15' offset 0,1\nset label " + gnuplot_quote(text.data()) +
         " at graph 0.5,1.025 center font ',9' tc rgb '#666666'\n";
}

/// All of the marks, and room for the names on the right.
std::string seconds_range(const Tradeoff& tradeoff) {
  double least = HUGE_VAL, most = 0;
  for (const TradeoffRow& row : tradeoff.rows) {
    if (!row.failure.empty()) continue;
    least = std::min(least, row.seconds());
    most = std::max(most, row.seconds());
  }
  const double room = std::pow(most / least, 0.15);
  const double from = least / room / 1.05, to = most * room * 1.25;

  // By itself gnuplot labels powers of ten alone, of which there may be none.
  std::string tics;
  for (double power = std::pow(10, std::floor(std::log10(from))); power < to; power *= 10)
    for (const double nice : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0})
      if (const double tic = nice * power; tic >= from && tic <= to)
        tics += (tics.empty() ? "" : ",") + number_text(tic);
  return "set xrange [" + number_text(from) + ":" + number_text(to) + "]\nset xtics (" + tics +
         ")\n";
}

constexpr const char* axes =
    "set encoding utf8\nset minussign\n"
    "set terminal pngcairo noenhanced rounded size 1000,760 font 'DejaVu Sans,11' background "
    "'#FFFFFF'\n"
    "set logscale xy\nset border 3 lc rgb '#888888'\n"
    "set lmargin at screen 0.12\nset rmargin at screen 0.97\nset tmargin at screen 0.91\n"
    "set bmargin at screen 0.18\n"
    "set grid back lc rgb '#DDDDDD' lw 1 lt 1\n"
    "set xtics nomirror out format '%g'\nset ytics nomirror out format '%g'\n"
    "set xlabel 'seconds for the tables and the picture'\n"
    "set ytics add ('≤ 0.0001' 0.0001)\n"
    "set ylabel 'ΔE00: 95th percentile (line: mean to maximum)' offset 1,0\n"
    "set key at screen 0.53,0.1 center top horizontal maxrows 2 samplen 1.5 font ',10'\n";

}  // namespace

std::string tradeoff_script(const Tradeoff& tradeoff) {
  std::string script = axes + seconds_range(tradeoff) + heading(tradeoff), data, plots;

  // The front, from the cheapest on.
  std::vector<const TradeoffRow*> front;
  for (const TradeoffRow& row : tradeoff.rows)
    if (row.front) front.push_back(&row);
  std::sort(front.begin(), front.end(),
            [](const TradeoffRow* a, const TradeoffRow* b) { return a->seconds() < b->seconds(); });
  data += "$front << EOD\n";
  for (const TradeoffRow* row : front) {
    data += data_line(*row);
    script += label(*row);
  }
  data += "EOD\n";
  plots = "plot $front using 1:2 with lines lw 3 lc rgb '#BBBBBB' title 'Pareto front'";

  // The marks.
  const std::vector<Family> families = families_of(tradeoff);
  for (std::size_t f = 0; f < families.size(); ++f) {
    std::string lines;
    for (const TradeoffRow& row : tradeoff.rows)
      if (belongs(row, families[f])) lines += data_line(row);
    if (lines.empty()) continue;
    const std::string block = "$d" + std::to_string(f);
    data += block + " << EOD\n" + lines + "EOD\n";
    const std::string color = " lc rgb '" + families[f].color + "'";
    plots += ", " + block + " using 1:2:3:4 with yerrorbars pt -1 lw 0.7" + color + " notitle, " +
             block + " using 1:2 with points ps 1.5 pt " + std::to_string(families[f].mark) +
             color + " title " + gnuplot_quote(families[f].title);
  }
  return script + data + plots + "\n";
}

}  // namespace metamer::cli
