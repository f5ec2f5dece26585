// What one model is: no server is asked.
#include "client/cli/commands.h"
#include "client/cli/commands/models/models_text.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

using client::CatalogueItem;

struct ShowModelOptions {
  bool json = false;
  std::string name;
};

ExitCode run(const ShowModelOptions& options) {
  Report report(options.json);
  const auto items = client::find_items(options.name);
  if (!items) {
    report.error(items.error().message);
    return report.finish(ExitCode::bad_input);
  }
  std::string text;
  for (const CatalogueItem& item : *items) {
    report.document()["models"].push_back(item_json(item));
    text += (text.empty() ? "" : "\n") + show_text(item);
  }
  text.pop_back();
  report.line(text);
  return report.finish(ExitCode::done);
}

void declare(ShowModelOptions& values, Options& options) {
  options.push_back({.names = "name",
                     .target = &values.name,
                     .meaning = "such as blinn_phong",
                     .required = true});
  declare_json(values.json, options);
}

}  // namespace

Command commands::models_show() {
  return make_command<ShowModelOptions>("models show", "print equation, paper and parameters",
                                        declare, run);
}

}  // namespace metamer::cli
