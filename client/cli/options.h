#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace metamer::cli {

/// How to reach a server, and how to answer. Every subcommand has these.
struct CommonOptions {
  std::string
      server;         ///< "unix:PATH" or "HOST:PORT"; empty: a private one, where that makes sense.
  bool json = false;  ///< One JSON document on stdout.
};

/// What the command line says instead of the scene's own settings, as written.
struct Overrides {
  std::optional<std::string> method;       ///< "point", "rgb", "exact"
  std::optional<std::string> samples;      ///< "400:700:5"
  std::optional<std::string> wavelengths;  ///< "400,436,546,700"
  std::optional<std::string> size;         ///< "640x480"
  std::optional<std::string> observer;     ///< "cie-1931-2deg", "cie-1964-10deg"
  std::optional<std::string> shading;      ///< "phong", "constant", "gouraud", "quadratic"
  std::optional<std::uint32_t> bases;      ///< Of linear.
  std::optional<double> tolerance;         ///< Of auto: ΔE00.
  std::optional<std::string> deadline;     ///< Of auto: "2s", "2"
  std::optional<std::uint32_t> spp;
  std::optional<std::uint32_t> depth;
  std::optional<std::uint32_t> threads;
  std::optional<std::uint32_t> tile_size;
  std::vector<std::string> lights;  ///< "ceiling=A", "*=D65"
};

/// Where pictures go. An .exr holds linear sRGB, or XYZ.
struct OutputOptions {
  std::vector<std::string> files;
  std::string exr = "rgb";             ///< "rgb", "xyz"
  std::optional<std::string> factors;  ///< For relighting; "": beside the first picture.
};

struct RenderOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
  OutputOptions output;
};

struct SubmitOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
  bool keep_factors = false;
};

struct CheckOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
};

struct ExplainOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
};

struct JobsOptions {
  CommonOptions common;
};

struct WatchOptions {
  CommonOptions common;
  std::uint64_t job_id = 0;
  std::uint64_t from = 0;
  std::string preview;  ///< A .png that is kept up to date; empty: none.
};

struct FetchOptions {
  CommonOptions common;
  std::uint64_t job_id = 0;
  OutputOptions output;
};

/// cancel, pause, resume.
struct ControlOptions {
  CommonOptions common;
  std::uint64_t job_id = 0;
};

struct InfoOptions {
  CommonOptions common;
};

// The models need no server, so these have no CommonOptions.

struct ModelsOptions {
  bool json = false;
};

struct ShowModelOptions {
  bool json = false;
  std::string name;
};

struct PlotOptions {
  bool json = false;
  std::vector<std::string> names;
  std::vector<std::string> set;  ///< "shininess=120"
  std::string folder = ".";      ///< Made when it is not there.
  bool figures = false;          ///< Figs. 2-2 to 2-11 in place of names.
};

struct BenchOptions {
  CommonOptions common;
  Overrides overrides;
  std::uint32_t rounds = 5;
};

struct TradeoffOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;  ///< But for the method.
  std::string folder;   ///< Made when it is not there.
  std::uint32_t rounds = 3;
};

/// Two picture files; no server.
struct CompareOptions {
  bool json = false;
  std::string a, b;
  std::string metric = "de00";             ///< "de00", "deuv", "deab"
  std::optional<double> max;               ///< More than this anywhere is a failure.
  std::string output;                      ///< A .png of the differences; empty: none.
  std::optional<double> scale;             ///< The difference that is drawn white.
  std::string white;                       ///< "0.95,1,1.09" or "D50"
  std::string under;                       ///< What lights reflectances: "F11"
  std::string observer = "cie-1931-2deg";  ///< or "cie-1964-10deg"
};

}  // namespace metamer::cli
