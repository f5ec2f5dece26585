#pragma once

#include "client/cli/exit_code.h"
#include "client/cli/options.h"

/// The subcommands, one a file. Each does all that the word says, prints what there is to print,
/// and returns the program's exit code.
namespace metamer::cli {

ExitCode render(const RenderOptions& options);
ExitCode submit(const SubmitOptions& options);
ExitCode check(const CheckOptions& options);
ExitCode explain(const ExplainOptions& options);
ExitCode relight(const RelightOptions& options);
ExitCode jobs(const JobsOptions& options);
ExitCode watch(const WatchOptions& options);
ExitCode fetch(const FetchOptions& options);
ExitCode cancel(const ControlOptions& options);
ExitCode pause(const ControlOptions& options);
ExitCode resume(const ControlOptions& options);
ExitCode info(const InfoOptions& options);
ExitCode list_models(const ModelsOptions& options);
ExitCode show_model(const ShowModelOptions& options);
ExitCode plot_models(const PlotOptions& options);

ExitCode spectra_info(const SpectraOptions& options);
ExitCode plot_spectra(const PlotSpectraOptions& options);
ExitCode resample_spectra(const ResampleOptions& options);
ExitCode normalize_spectra(const NormalizeOptions& options);
ExitCode spectra_rgb(const SpectraRgbOptions& options);
ExitCode convert_spectra(const ConvertOptions& options);
ExitCode find_metamer(const MetamerOptions& options);

ExitCode bench_models(const BenchOptions& options);
ExitCode bench_methods(const BenchOptions& options);
ExitCode bench_shading(const BenchShadingOptions& options);
ExitCode view(const ViewOptions& options);
ExitCode tradeoff(const TradeoffOptions& options);
ExitCode compare(const CompareOptions& options);

/// What words that make no sense come to with --json: a document that says why.
ExitCode refuse_words(const std::string& why);

}  // namespace metamer::cli
