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

/// How X Y Z become a picture's numbers, as written.
struct DevelopmentOptions {
  std::optional<std::string> adaptation;  ///< "none", "von-kries", "bradford", …
  std::optional<std::string> rgb;         ///< "srgb", "display-p3", …
  bool linear = false;
};

/// What the command line says instead of the scene's own settings, as written.
struct Overrides {
  std::optional<std::string> backend;      ///< "cpu", "gl"
  std::optional<std::string> method;       ///< A name in v1::Method: "point", "rgb".
  std::optional<std::string> samples;      ///< "400:700:5"
  std::optional<std::string> wavelengths;  ///< "400,436,546,700"
  std::optional<std::uint32_t> fitted;     ///< Of point: so many wavelengths for the scene.
  bool multi_pass = false;                 ///< Of point, by the gl backend.
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
  DevelopmentOptions development;
};

/// Where pictures go. An .exr holds linear RGB, or XYZ.
struct OutputOptions {
  std::vector<std::string> files;
  std::string exr = "rgb";             ///< "rgb", "xyz", "spectral", "spectral:400:700:10"
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
  DevelopmentOptions development;  ///< In place of what the job was submitted with.
};

/// cancel, pause, resume.
struct ControlOptions {
  CommonOptions common;
  std::uint64_t job_id = 0;
};

struct InfoOptions {
  CommonOptions common;
};

struct RelightOptions {
  bool json = false;
  std::string file;                    ///< What --keep-factors wrote.
  std::vector<std::string> lights;     ///< "ceiling=F11", "*=lamp.txt", "key=lamps.sp#warm"
  std::vector<std::string> materials;  ///< "door=red.sp", "door.specular=gloss.txt"
  std::optional<std::string> observer;
  DevelopmentOptions development;
  OutputOptions output;
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

/// What `metamer spectra` reads: files, or names of CIE illuminants and test colours.
struct SpectraOptions {
  bool json = false;
  std::vector<std::string> files;
  std::optional<std::string> entry;        ///< Of files with several spectra: this one.
  std::optional<std::string> kind;         ///< "emission", "reflectance"
  std::string observer = "cie-1931-2deg";  ///< Or "cie-1964-10deg".
  std::string under = "D65";               ///< The light of reflectances.
};

struct SpectraOutputOptions {
  std::string file;                   ///< Empty: the text is printed.
  std::optional<std::string> format;  ///< "pairs", "uniform", "cgats"
};

struct PlotSpectraOptions {
  SpectraOptions input;
  std::string file;  ///< A .png.
};

struct ResampleOptions {
  SpectraOptions input;
  std::optional<std::string> samples, wavelengths;  ///< As in Overrides.
  SpectraOutputOptions output;
};

struct NormalizeOptions {
  SpectraOptions input;
  double luminance = 1;
  SpectraOutputOptions output;
};

struct SpectraRgbOptions {
  SpectraOptions input;
  DevelopmentOptions development;
  double luminance = 1;  ///< Of the light: an emission, or the one that reflectances are under.
};

struct ConvertOptions {
  SpectraOptions input;
  SpectraOutputOptions output;
};

struct MetamerOptions {
  SpectraOptions input;
  std::string against;          ///< Empty: A, or D65 where that is the light.
  SpectraOutputOptions output;  ///< Its file is not empty.
};

/// One for each `metamer spectra` command.
struct SpectraCommands {
  SpectraOptions info;
  PlotSpectraOptions plot;
  ResampleOptions resample;
  NormalizeOptions normalize;
  SpectraRgbOptions rgb;
  ConvertOptions convert;
  MetamerOptions metamer;
};

struct BenchOptions {
  CommonOptions common;
  Overrides overrides;
  std::uint32_t rounds = 5;
};

struct BenchShadingOptions {
  BenchOptions bench;
  std::vector<std::string> models;                    ///< Empty: all.
  std::vector<std::uint32_t> counts{7, 16, 61, 301};  ///< Of wavelengths, 2 or more.
};

struct TradeoffOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;  ///< But for the method.
  std::string folder;   ///< Made when it is not there.
  std::uint32_t rounds = 3;
};

struct ViewOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
  std::uint32_t frames = 60;
  double degrees = 10;                ///< That the camera swings to both sides of its place.
  std::optional<double> rate;         ///< Frames a second, at most.
  std::optional<std::string> output;  ///< A .png of the complete picture.
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
