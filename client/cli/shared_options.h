#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/command.h"

/// Options that several subcommands have, and how each is declared.
namespace metamer::cli {

/// How to reach a server, and how to answer.
struct CommonOptions {
  std::string
      server;         ///< "unix:PATH" or "HOST:PORT"; empty: a private one, where that makes sense.
  bool json = false;  ///< One JSON document on stdout.
};

/// How X Y Z become a picture's numbers, as written.
struct DevelopmentOptions {
  std::optional<std::string> adaptation;  ///< "none", "von-kries", "bradford", …
  std::optional<std::string> rgb;         ///< "srgb", "display-p3", …
  bool linear = false;
  std::optional<double> exposure;  ///< Stops.
};

/// What the command line says instead of the scene's own, as written.
struct Overrides {
  std::optional<std::string> look;          ///< Of the scene: its name. Before all others.
  std::optional<std::string> backend;       ///< "cpu", "gl"
  std::optional<std::string> method;        ///< A name in v1::Method: "point", "rgb".
  std::optional<std::string> samples;       ///< "400:700:5"
  std::optional<std::string> wavelengths;   ///< "400,436,546,700"
  std::optional<std::uint32_t> fitted;      ///< Of point: so many wavelengths for the scene.
  bool multi_pass = false;                  ///< Of point, by the gl backend.
  std::optional<std::string> point_lights;  ///< Of point: "better", "samples", "cells"
  std::optional<std::string> size;          ///< "640x480"
  std::optional<std::string> observer;      ///< "cie-1931-2deg", "cie-1964-10deg", a file
  std::optional<std::string> shading;       ///< "phong", "constant", "gouraud", "quadratic"
  std::optional<std::uint32_t> bases;       ///< Of linear.
  std::optional<double> tolerance;          ///< Of auto: ΔE00.
  std::optional<std::string> deadline;      ///< Of auto: "2s", "2"
  bool verify = false;
  std::optional<std::uint32_t> spp;
  std::optional<std::uint32_t> depth;
  std::optional<std::uint32_t> threads;
  std::optional<std::uint32_t> tile_size;
  std::vector<std::string> lights;  ///< "ceiling=A", "*=D65"
  DevelopmentOptions development;
};

/// Where pictures go. An .exr holds linear RGB, or XYZ.
struct OutputOptions {
  std::vector<std::string> files;
  std::string png = "8";               ///< Bits of a .png's samples: "8", "16".
  std::string exr = "rgb";             ///< "rgb", "xyz", "spectral", "spectral:400:700:10"
  std::optional<std::string> factors;  ///< For relighting; "": beside the first picture.
};

using Options = std::vector<Option>;

/// Of --observer.
inline constexpr const char* observer_meaning =
    "cie-1931-2deg, cie-1964-10deg, or a file of wavelengths, x̄, ȳ and z̄";

/// Of options that take a light.
inline constexpr const char* light_words =
    "D65, D:6504K, 2856K, lines such as 436nm:0.6+546nm, FILE, FILE#ENTRY, or FILE@um@clamp, say: "
    "how it is read";

void declare_json(bool& json, Options& options);
/// --weights: a word of table_weights_words.
void declare_weights(std::string& word, Options& options);
void declare_common(CommonOptions& common, Options& options);
void declare_scene(std::string& scene, Options& options);
/// A handle or a number, for with_job.
void declare_job(std::string& job, Options& options);
/// The same, or a series, for with_jobs.
void declare_jobs(std::string& job, Options& options);
void declare_overrides(Overrides& overrides, Options& options);
void declare_development(DevelopmentOptions& development, const std::string& group,
                         Options& options);
/// -o and --exr.
void declare_picture_files(OutputOptions& output, Options& options);
/// The same and --keep-factors.
void declare_output(OutputOptions& output, Options& options);

}  // namespace metamer::cli
