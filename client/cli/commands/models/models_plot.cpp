// Diagrams of the models, drawn by gnuplot from numbers that are kept beside them.
#include <filesystem>

#include "client/cli/commands.h"
#include "client/cli/commands/models/figure_script.h"
#include "client/cli/output/gnuplot.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/tools/figures/curves.h"
#include "client/tools/figures/source_figures.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;
using client::CatalogueItem;
using client::Figure;

struct PlotOptions {
  bool json = false;
  std::vector<std::string> names;
  std::vector<std::string> set;  ///< "shininess=120"
  std::string folder = ".";      ///< Made when it is not there.
  bool figures = false;          ///< Figs. 2-2 to 2-11 in place of names.
};

/// What the command line asks for.
Result<std::vector<Figure>> chosen_figures(const PlotOptions& options) {
  if (options.figures) {
    if (!options.names.empty() || !options.set.empty())
      return problem("--figures takes neither names nor --set");
    return client::source_figures();
  }
  if (options.names.empty())
    return problem(
        "name a model, such as blinn_phong, or say --figures; `metamer models` lists them");

  std::vector<CatalogueItem> items;
  for (const std::string& name : options.names) {
    const auto found = client::find_items(name);
    if (!found) return tl::unexpected(found.error());
    items.insert(items.end(), found->begin(), found->end());
  }
  const auto values = client::parse_values(options.set, items);
  if (!values) return problem("--set: " + values.error().message);
  std::vector<Figure> figures;
  for (const CatalogueItem& item : items) figures.push_back(client::figure_of(item, *values));
  return figures;
}

ExitCode run(const PlotOptions& options) {
  Report report(options.json);
  const auto figures = chosen_figures(options);
  if (!figures) {
    report.error(figures.error().message);
    return report.finish(ExitCode::bad_input);
  }
  const fs::path folder = options.folder;
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) {
    report.error(quoted(options.folder) + ": no such folder can be made: " + failure.message());
    return report.finish(ExitCode::other);
  }

  // The numbers need no gnuplot: all of them are written, whatever becomes of the pictures.
  ExitCode code = ExitCode::done;
  const auto keep = [&](const fs::path& file, const Result<void>& written) {
    if (written) {
      report.document()["files"].push_back(file.string());
      report.line(file.string());
    } else {
      code = ExitCode::other;
      report.problem(written.error(), {});
    }
    return written.has_value();
  };
  for (const Figure& figure : *figures) {
    const fs::path file = folder / (figure.name + ".csv");
    keep(file, write_text_file(file, client::csv_text(figure)));
  }
  for (const Figure& figure : *figures) {
    const fs::path file = folder / (figure.name + ".png");
    // What keeps one from being drawn keeps all.
    if (!keep(file, draw_png(gnuplot_script(figure), file))) break;
  }
  return report.finish(code);
}

void declare(PlotOptions& values, Options& options) {
  options.push_back({.names = "names",
                     .target = &values.names,
                     .meaning = "such as blinn_phong beckmann conductor"});
  options.push_back({.names = "--figures",
                     .target = &values.figures,
                     .meaning = "all the diagrams among Figs. 2-2 to 2-11 instead"});
  options.push_back({.names = "-o,--output",
                     .target = &values.folder,
                     .meaning = "the folder to write into",
                     .shows_default = true});
  options.push_back({.names = "--set",
                     .target = &values.set,
                     .meaning = "a parameter's value; may be given several times",
                     .type = "PARAMETER=VALUE"});
  declare_json(values.json, options);
}

}  // namespace

Command commands::models_plot() {
  return make_command<PlotOptions>("models plot", "draw diagrams: a .png and its numbers as a .csv",
                                   declare, run);
}

}  // namespace metamer::cli
