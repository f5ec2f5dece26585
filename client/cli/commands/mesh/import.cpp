// A scene made of a mesh file. No server is asked.
#include <fstream>

#include "client/cli/commands.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/tools/mesh/import_scene.h"
#include "client/tools/text/job_text.h"
#include "common/image/whole_file.h"

namespace metamer::cli {
namespace {

struct ImportOptions {
  std::string file, output;
  bool force = false, json = false;
};

struct Output {
  std::filesystem::path file;
  std::vector<unsigned char> bytes;
};

/// The pictures first: a scene is there when all is that it names.
std::vector<Output> outputs_of(const client::ImportedScene& scene, const ImportOptions& options) {
  const std::filesystem::path output = options.output;
  std::vector<Output> outputs;
  for (const client::NewFile& file : scene.files)
    outputs.push_back({output.parent_path() / file.name, {file.bytes.begin(), file.bytes.end()}});
  const std::string text = client::scene_text(scene, options.file);
  outputs.push_back({output, {text.begin(), text.end()}});
  return outputs;
}

ExitCode run(const ImportOptions& options) {
  Report report(options.json);
  const std::filesystem::path output = options.output;
  if (output.extension() != ".txtpb") {
    report.error(quoted(options.output) + " is no scene: a scene's name ends in .txtpb");
    return report.finish(ExitCode::bad_input);
  }
  const auto scene = client::import_scene(options.file, output.parent_path());
  if (!scene) {
    report.problem(scene.error());
    return report.finish(ExitCode::bad_input);
  }
  const std::vector<Output> outputs = outputs_of(*scene, options);
  for (const Output& one : outputs) {
    std::error_code none;
    if (options.force || !std::filesystem::exists(one.file, none)) continue;
    report.error(quoted(one.file.string()) + " is there already; --force writes over it");
    return report.finish(ExitCode::bad_input);
  }
  std::vector<std::string> files;
  for (const Output& one : outputs) {
    if (auto written = write_whole_file(one.file, one.bytes); !written) {
      report.error(quoted(one.file.string()) + " " + written.error().message);
      return report.finish(ExitCode::other);
    }
    if (&one != &outputs.back()) files.push_back(one.file.string());
  }
  for (const std::string& sentence : scene->left_out)
    report.note({.field = {}, .file = options.file, .message = sentence});
  report.document()["scene"] = options.output;
  report.document()["objects"] = scene->message.object_size();
  report.document()["materials"] = scene->message.material_size();
  report.document()["lights"] = scene->message.light_size();
  report.document()["files"] = files;
  report.document()["left_out"] = scene->left_out;
  const auto number = [](int count, const char* one, const char* many) {
    return client::counted(static_cast<std::uint64_t>(count), one, many);
  };
  report.line(options.output + ": " + number(scene->message.object_size(), "object", "objects") +
              ", " + number(scene->message.material_size(), "material", "materials") + ", " +
              number(scene->message.light_size(), "light", "lights"));
  return report.finish(ExitCode::done);
}

void declare(ImportOptions& values, Options& options) {
  options.push_back({.names = "file",
                     .target = &values.file,
                     .meaning = "a .ply, .obj, .gltf or .glb",
                     .required = true});
  options.push_back({.names = "-o,--output",
                     .target = &values.output,
                     .meaning = "the scene, .txtpb, in the mesh's folder or above it",
                     .required = true});
  options.push_back(
      {.names = "--force", .target = &values.force, .meaning = "write over a file that is there"});
  declare_json(values.json, options);
}

}  // namespace

Command commands::import_mesh() {
  return make_command<ImportOptions>(
      "import", "make a scene of a mesh file: objects, camera, lights, materials, textures",
      declare, run);
}

}  // namespace metamer::cli
