// What the models are, from the table that the renderer is made from: no server is asked.
#include "client/cli/commands.h"
#include "client/cli/commands/models/models_text.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

using client::CatalogueItem;

struct ModelsOptions {
  bool json = false;
};

ExitCode run(const ModelsOptions& options) {
  Report report(options.json);
  const std::vector<CatalogueItem> items = client::catalogue();
  for (const CatalogueItem& item : items) report.document()["models"].push_back(item_json(item));
  std::string text = list_text(items);
  text.pop_back();
  report.line(text);
  return report.finish(ExitCode::done);
}

void declare(ModelsOptions& values, Options& options) { declare_json(values.json, options); }

}  // namespace

Command commands::models() {
  return make_command<ModelsOptions>("models", "list, explain and plot the illumination models",
                                     declare, run);
}

}  // namespace metamer::cli
