#include "client/cli/words.h"

#include <algorithm>
#include <iostream>

#include "common/models/registry.h"

namespace metamer::cli {
namespace {

/// All the subcommands' options; the one that was chosen reads its own.
struct AllOptions {
  RenderOptions render;
  SubmitOptions submit;
  CheckOptions check;
  ExplainOptions explain;
  RelightOptions relight;
  JobsOptions jobs;
  WatchOptions watch;
  FetchOptions fetch;
  ControlOptions cancel, pause, resume;
  InfoOptions info;
  ModelsOptions models;
  ShowModelOptions show_model;
  PlotOptions plot;
  SpectraCommands spectra;
  BenchOptions bench;
  BenchShadingOptions bench_shading;
  TradeoffOptions tradeoff;
  ViewOptions view;
  CompareOptions compare;
};

void add_scene_commands(CLI::App& app, AllOptions& all, Action& chosen) {
  CLI::App& render_command = add_command(app, "render", "render a scene into picture files", chosen,
                                         [&] { return render(all.render); });
  add_scene(render_command, all.render.scene);
  add_output(render_command, all.render.output);
  add_overrides(render_command, all.render.overrides);
  add_common(render_command, all.render.common);

  CLI::App& submit_command = add_command(app, "submit", "queue a scene; prints the job's number",
                                         chosen, [&] { return submit(all.submit); });
  add_scene(submit_command, all.submit.scene);
  add_overrides(submit_command, all.submit.overrides);
  submit_command.add_flag("--keep-factors", all.submit.keep_factors,
                          "keep what relighting needs: fetch it by the same word");
  add_common(submit_command, all.submit.common);

  CLI::App& check_command =
      add_command(app, "check", "say what is wrong with a scene, or what would be rendered", chosen,
                  [&] { return check(all.check); });
  add_scene(check_command, all.check.scene);
  add_overrides(check_command, all.check.overrides);
  add_common(check_command, all.check.common);

  CLI::App& view_command =
      add_command(app, "view", "look at a scene while the camera moves, and measure the frames",
                  chosen, [&] { return view(all.view); });
  add_scene(view_command, all.view.scene);
  view_command.add_option("--record", all.view.frames, "so many frames")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  view_command
      .add_option("--swing", all.view.degrees, "of the camera around its target, to each side")
      ->type_name("DEGREES")
      ->capture_default_str();
  view_command.add_option("--rate", all.view.rate, "frames a second, at most");
  view_command.add_option("-o,--output", all.view.output,
                          "a .png of the last frame, once it has all its samples");
  add_overrides(view_command, all.view.overrides);
  add_common(view_command, all.view.common);

  CLI::App& explain_command = add_command(
      app, "explain", "say what a scene needs, and what each method would cost and miss", chosen,
      [&] { return explain(all.explain); });
  add_scene(explain_command, all.explain.scene);
  add_overrides(explain_command, all.explain.overrides);
  add_common(explain_command, all.explain.common);
}

void add_job_commands(CLI::App& app, AllOptions& all, Action& chosen) {
  CLI::App& jobs_command =
      add_command(app, "jobs", "list the jobs", chosen, [&] { return jobs(all.jobs); });
  add_common(jobs_command, all.jobs.common);

  CLI::App& watch_command = add_command(app, "watch", "print a job's events until it ends", chosen,
                                        [&] { return watch(all.watch); });
  add_job(watch_command, all.watch.job_id);
  watch_command.add_option("--from", all.watch.from, "the first event's number");
  watch_command.add_option("--preview", all.watch.preview, "a .png that is kept up to date");
  add_common(watch_command, all.watch.common);

  CLI::App& fetch_command = add_command(app, "fetch", "wait for a job and write its picture",
                                        chosen, [&] { return fetch(all.fetch); });
  add_job(fetch_command, all.fetch.job_id);
  add_output(fetch_command, all.fetch.output);
  add_development(fetch_command, all.fetch.development, "In place of what the job says");
  add_common(fetch_command, all.fetch.common);

  const auto add_control = [&](const char* name, const char* meaning, ControlOptions& options,
                               ExitCode (*command)(const ControlOptions&)) {
    CLI::App& added =
        add_command(app, name, meaning, chosen, [command, &options] { return command(options); });
    add_job(added, options.job_id);
    add_common(added, options.common);
  };
  add_control("cancel", "end a job and drop what it rendered", all.cancel, cancel);
  add_control("pause", "stop a job and keep what it rendered", all.pause, pause);
  add_control("resume", "go on with a paused job", all.resume, resume);

  CLI::App& info_command = add_command(app, "info", "what a server can do and how it is", chosen,
                                       [&] { return info(all.info); });
  add_common(info_command, all.info.common);
}

void add_models_commands(CLI::App& app, AllOptions& all, Action& chosen) {
  CLI::App* models = app.add_subcommand("models", "list, explain and plot the illumination models");
  // A parent's callback comes after its subcommand's.
  models->callback([&all, &chosen, models] {
    if (models->get_subcommands().empty()) chosen = [&all] { return list_models(all.models); };
  });
  models->require_subcommand(0, 1);
  add_json(*models, all.models.json);
  models->footer(footer);

  CLI::App& show =
      add_command(*models, "show", "print equation, paper and parameters", chosen, [&] {
        all.show_model.json |= all.models.json;
        return show_model(all.show_model);
      });
  show.add_option("name", all.show_model.name, "such as blinn_phong")->required();
  add_json(show, all.show_model.json);

  CLI::App& plot =
      add_command(*models, "plot", "draw diagrams: a .png and its numbers as a .csv", chosen, [&] {
        all.plot.json |= all.models.json;
        return plot_models(all.plot);
      });
  plot.add_option("names", all.plot.names, "such as blinn_phong beckmann conductor");
  plot.add_flag("--figures", all.plot.figures, "all the diagrams among Figs. 2-2 to 2-11 instead");
  plot.add_option("-o,--output", all.plot.folder, "the folder to write into")
      ->capture_default_str();
  plot.add_option("--set", all.plot.set, "a parameter's value; may be given several times")
      ->type_name("PARAMETER=VALUE")
      ->allow_extra_args(false);
  add_json(plot, all.plot.json);
}

void add_bench_commands(CLI::App& app, AllOptions& all, Action& chosen) {
  CLI::App* bench = app.add_subcommand("bench", "measure a server; prints ratios of one run");
  bench->require_subcommand(1);
  bench->footer(footer);
  CLI::App& models =
      add_command(*bench, "models", "the time of one scene with each model, next to Blinn–Phong's",
                  chosen, [&] { return bench_models(all.bench); });
  CLI::App& methods =
      add_command(*bench, "methods", "the time of one scene by each method, next to rgb's", chosen,
                  [&] { return bench_methods(all.bench); });
  BenchShadingOptions& options = all.bench_shading;
  CLI::App& shading = add_command(
      *bench, "shading", "point sampling next to rgb, with each model per vertex and per pixel",
      chosen, [&options] { return bench_shading(options); });
  std::vector<std::string> names;
  for (const models::Entry& model : models::registry(models::Kind::model))
    names.emplace_back(model.name);
  shading.add_option("--models", options.models, "these alone")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  shading.add_option("--counts", options.counts, "of wavelengths")
      ->delimiter(',')
      ->check(CLI::Range(2, 4001))
      ->capture_default_str();
  const auto add_rounds = [](CLI::App& command, BenchOptions& bench) {
    command.add_option("--rounds", bench.rounds, "renderings of each")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    add_overrides(command, bench.overrides);
    add_common(command, bench.common);
  };
  add_rounds(models, all.bench);
  add_rounds(methods, all.bench);
  add_rounds(shading, options.bench);
}

/// Also where the words make no sense otherwise.
bool asks_for_json(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
}

int run(int argc, char** argv) {
  CLI::App app("Metamer renders scenes spectrally, on this machine or on a server.");
  app.set_version_flag("--version", std::string("metamer ") + METAMER_VERSION);
  app.require_subcommand(1);
  app.footer(footer);

  AllOptions all;
  Action chosen;
  add_scene_commands(app, all, chosen);
  add_job_commands(app, all, chosen);
  add_models_commands(app, all, chosen);
  add_spectra_commands(app, all.spectra, chosen);
  add_bench_commands(app, all, chosen);
  add_tradeoff(app, all.tradeoff, chosen);
  add_relight(app, all.relight, chosen);
  add_compare(app, all.compare, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0 && asks_for_json(argc, argv))
      return static_cast<int>(refuse_words(error.what()));
    return app.exit(error) == 0 ? static_cast<int>(ExitCode::done)
                                : static_cast<int>(ExitCode::bad_input);
  }
  try {
    return static_cast<int>(chosen());
  } catch (const std::exception& error) {
    // Out of memory, most likely: a picture's size is known only when its plan comes.
    std::cerr << "error: " << error.what() << '\n';
    return static_cast<int>(ExitCode::other);
  }
}

}  // namespace
}  // namespace metamer::cli

int main(int argc, char** argv) { return metamer::cli::run(argc, argv); }
