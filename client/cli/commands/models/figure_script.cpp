// How a figure looks. gnuplot's own polar mode draws full discs and labels them badly, so polar
// panels are drawn by hand: the values relative to the outermost ring, which has radius 1.
#include "client/cli/commands/models/figure_script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "client/cli/output/gnuplot.h"
#include "common/problem.h"

namespace metamer::cli {
namespace {

using client::Curve;
using client::Figure;
using client::Panel;
using client::radians;
using client::Scale;

// Pixels.
constexpr double panel_width = 660, polar_height = 430, straight_height = 460;
constexpr double top_margin = 60, bottom_margin = 20, line_height = 17;
constexpr double letter_width = 6.4;  ///< Of the last lines, on the safe side of the average.

/// Okabe's and Ito's colours, which the colour-blind tell apart; the yellow left out, pale on
/// white.
constexpr std::array colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr const char* grid_color = "#CCCCCC";
constexpr const char* grey = "#666666";

std::string text(double value) {
  // Shorter than the shortest exact form; a picture needs no more.
  return number_text(std::round(value * 1e6) / 1e6);
}

std::string color_of(std::size_t curve) { return gnuplot_quote(colors[curve % colors.size()]); }

std::string point(double degrees, double radius) {
  return text(radius * std::sin(radians(degrees))) + "," +
         text(radius * std::cos(radians(degrees)));
}

std::string degrees_text(double degrees) {
  return degrees < 0 ? "−" + text(-degrees) + "°" : text(degrees) + "°";
}

std::string polar_grid(const Scale& scale) {
  std::string script;
  const auto rings = static_cast<int>(std::lround(scale.top / scale.step));
  for (int ring = 1; ring <= rings; ++ring) {
    const double radius = static_cast<double>(ring) / rings;
    script += "set object circle at 0,0 size " + text(radius) +
              " arc [0:180] nowedge back fc rgb '" + (ring == rings ? "#888888" : grid_color) +
              "' lw 1\n";
    script += "set label " + gnuplot_quote(text(ring * scale.step)) + " at " + text(radius) +
              ",-0.05 center font ',9' tc rgb '" + grey + "'\n";
  }
  for (int degrees = -90; degrees <= 90; degrees += 15) {
    script += "set arrow from 0,0 to " + point(degrees, 1) + " nohead back lc rgb '" +
              (degrees == 0 ? "#888888" : grid_color) + "' lw 1\n";
    if (degrees % 30 == 0)
      script += "set label " + gnuplot_quote(degrees_text(degrees)) + " at " +
                point(degrees, 1.085) + " center font ',10' tc rgb '" + grey + "'\n";
  }
  return script;
}

/// An arrow along the way in of each curve's light; one for lights that are alike.
std::string incidence_arrows(const Panel& panel) {
  std::string script;
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    const auto& incidence = panel.curves[c].incidence;
    if (!incidence || (c > 0 && panel.curves[c - 1].incidence == incidence)) continue;
    const bool shared = c + 1 < panel.curves.size() && panel.curves[c + 1].incidence == incidence;
    const std::string color = shared ? "'#333333'" : color_of(c);
    script += "set arrow from " + point(-*incidence, 1.0) + " to " + point(-*incidence, 0.86) +
              " head filled size 0.045,20 front lc rgb " + color + " lw 1.8\n";
    script += "set arrow from " + point(-*incidence, 0.86) + " to 0,0 nohead lc rgb " + color +
              " lw 1 dt 3\n";
  }
  return script;
}

/// Where a panel stands, in pixels from the picture's lower left.
struct Frame {
  double left, bottom, height, picture_width, picture_height;

  std::string x(double pixels) const { return "screen " + text((left + pixels) / picture_width); }
  std::string y(double pixels) const {
    return "screen " + text((bottom + pixels) / picture_height);
  }
};

/// The title and the curves' names, and the room that they leave: the axis stands at `below`, the
/// names that much lower.
std::string margins(const Panel& panel, const Frame& frame, double below, double key_gap) {
  return "set label " + gnuplot_quote(panel.title) + " at " + frame.x(panel_width / 2) + "," +
         frame.y(frame.height - 20) + " center font ',12'\nset lmargin at " + frame.x(74) +
         "\nset rmargin at " + frame.x(panel_width - 36) + "\nset tmargin at " +
         frame.y(frame.height - 44) + "\nset bmargin at " + frame.y(below) + "\nset key at " +
         frame.x(panel_width / 2) + "," + frame.y(below - key_gap) +
         " center top horizontal maxrows 2 samplen 2.2 font ',10'\n";
}

std::string polar_panel(const Panel& panel, const Scale& scale, const Frame& frame) {
  std::string script = margins(panel, frame, 75, 46);
  script +=
      "set size ratio -1\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset grid\n"
      "set xrange [-1.16:1.16]\nset yrange [-0.06:1.14]\n";
  script += polar_grid(scale) + incidence_arrows(panel);
  script += "set label " + gnuplot_quote(panel.value) + " at 1,-0.13 center font ',10' tc rgb '" +
            grey + "'\n";
  return script;
}

std::string straight_panel(const Panel& panel, const Scale& scale, const Frame& frame) {
  const double from = panel.curves[0].angle.front(), to = panel.curves[0].angle.back();
  return margins(panel, frame, 105, 66) + "set size noratio\nset border 3 lc rgb '#888888'\n" +
         "set xtics nomirror out 15 format '%g°' font ',10' tc rgb '" + grey +
         "'\nset ytics nomirror out " + text(scale.step) + " format '%g' font ',10' tc rgb '" +
         grey + "'\nset grid back lc rgb '" + grid_color + "' lw 1 lt 1\nset xrange [" +
         text(from) + ":" + text(to) + "]\nset yrange [0:" + text(scale.top * 1.02) +
         "]\nset xlabel " + gnuplot_quote(panel.angle) + " font ',11' tc rgb '" + grey +
         "'\nset ylabel " + gnuplot_quote(panel.value) + " font ',11' tc rgb '" + grey + "'\n";
}

/// The numbers of one panel as data blocks $d0, $d1, …, and the command that draws them.
std::string plot_command(const Panel& panel, const Scale& scale) {
  std::string data, plots;
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    const Curve& curve = panel.curves[c];
    const std::string block = "$d" + std::to_string(c);
    data += block + " << EOD\n";
    for (std::size_t i = 0; i < curve.angle.size(); ++i) {
      const double radius = curve.value[i] / scale.top;
      const double x = panel.polar ? radius * std::sin(radians(curve.angle[i])) : curve.angle[i];
      const double y = panel.polar ? radius * std::cos(radians(curve.angle[i])) : curve.value[i];
      data += number_text(x) + " " + number_text(y) + "\n";
    }
    data += "EOD\n";
    plots += (c == 0 ? "plot " : ", ") + block + " using 1:2 with lines lw 2.4 lc rgb " +
             color_of(c) + " dt " + (c < colors.size() ? "1" : "2") + " title " +
             gnuplot_quote(curve.label);
  }
  return data + plots + "\n";
}

/// Lines of at most `limit` characters, broken at spaces.
std::vector<std::string> wrapped(const std::string& words, double limit) {
  std::vector<std::string> lines;
  std::istringstream stream(words);
  std::string word;
  double length = 0;
  while (stream >> word) {
    // In UTF-8 every byte but these begins a character.
    const auto letters = static_cast<double>(
        std::count_if(word.begin(), word.end(), [](char c) { return (c & 0xC0) != 0x80; }));
    if (lines.empty() || length + 1 + letters > limit) {
      lines.push_back(word);
      length = letters;
    } else {
      lines.back() += " " + word;
      length += 1 + letters;
    }
  }
  return lines;
}

/// What a figure's last lines are: those of its citation, each as long as the picture is wide.
std::vector<std::string> last_lines(const Figure& figure) {
  std::vector<std::string> lines;
  std::istringstream stream(figure.citation);
  for (std::string line; std::getline(stream, line);)
    for (const std::string& part : wrapped(line, panel_width * figure.columns / letter_width))
      lines.push_back(part);
  return lines;
}

double height_of(const Panel& panel) { return panel.polar ? polar_height : straight_height; }

}  // namespace

std::string gnuplot_script(const Figure& figure) {
  // Lay out the rows: a row is as high as its panels' shape wants.
  const auto columns = static_cast<std::size_t>(figure.columns);
  const std::vector<std::string> lines = last_lines(figure);
  const double foot = bottom_margin + line_height * static_cast<double>(lines.size());
  double height = top_margin + foot;
  for (std::size_t first = 0; first < figure.panels.size(); first += columns)
    height += height_of(figure.panels[first]);
  const double width = panel_width * figure.columns;

  // Title and last lines.
  const Frame picture{0, 0, height, width, height};
  std::string script =
      "set encoding utf8\nset minussign\nset terminal pngcairo noenhanced rounded size " +
      text(width) + "," + text(height) +
      " font 'DejaVu Sans,11' background '#FFFFFF'\nset multiplot\n";
  script += "set label " + gnuplot_quote(figure.title) + " at " + picture.x(width / 2) + "," +
            picture.y(height - 32) + " center font ',15'\n";
  for (std::size_t i = 0; i < lines.size(); ++i)
    script += "set label " + gnuplot_quote(lines[i]) + " at " + picture.x(width / 2) + "," +
              picture.y(foot - line_height * (static_cast<double>(i) + 0.5)) +
              " center font ',9' tc rgb '" + grey + "'\n";

  // The panels, row by row.
  Frame frame{0, height - top_margin, 0, width, height};
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const Panel& panel = figure.panels[p];
    frame.left = panel_width * static_cast<double>(p % columns);
    frame.height = height_of(panel);
    if (p % columns == 0) frame.bottom -= frame.height;
    const Scale scale = client::scale_of(figure, panel.polar);
    script += panel.polar ? polar_panel(panel, scale, frame) : straight_panel(panel, scale, frame);
    script += plot_command(panel, scale) + "unset label\nunset arrow\nunset object\n";
  }
  return script + "unset multiplot\n";
}

}  // namespace metamer::cli
