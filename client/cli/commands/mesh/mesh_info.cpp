// What a mesh file holds, and by which names a scene takes its parts. No server is asked.
#include "client/cli/commands.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/tools/mesh/mesh_facts.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

using client::counted;
using client::MeshFacts;
using client::MeshPart;

struct MeshInfoOptions {
  std::string file;
  bool json = false;
};

constexpr std::size_t most_shown = 40;  ///< Parts on a screen; --json has all.

/// A name as a scene file spells it, on one line.
std::string spelled(const std::string& name) {
  return Json(name).dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json mesh_json(const MeshFacts& facts) {
  Json json = {{"format", facts.format},
               {"vertices", facts.vertices},
               {"triangles", facts.triangles},
               {"bounds", {{"low", facts.low}, {"high", facts.high}}},
               {"normals", facts.normals},
               {"uvs", facts.uvs},
               {"skipped_faces", facts.skipped_faces}};
  json["parts"] = Json::array();
  for (const MeshPart& part : facts.parts)
    json["parts"].push_back({{"object", part.object},
                             {"material", part.material},
                             {"triangles", part.triangles},
                             {"part", part.part}});
  json["left_out"] = facts.notes;
  return json;
}

/// "all", "none", "12 of 24".
std::string share(std::uint64_t some, std::uint64_t all) {
  if (some == all) return "of all vertices";
  if (some == 0) return "none";
  return "of " + counted(some, "vertex", "vertices");
}

std::string part_text(const MeshPart& part) {
  std::string text = "  " + counted(part.triangles, "triangle", "triangles");
  if (!part.object.empty()) text += ", object " + spelled(part.object);
  if (!part.material.empty()) text += ", material " + spelled(part.material);
  if (!part.part.empty()) text += "; part: " + spelled(part.part);
  return text;
}

void print_mesh(const std::string& file, const MeshFacts& facts, Report& report) {
  report.line(file + ": " + facts.format + ", " + counted(facts.vertices, "vertex", "vertices") +
              ", " + counted(facts.triangles, "triangle", "triangles"));
  std::string bounds;
  for (std::size_t k = 0; k < 3; ++k)
    bounds += std::string(k > 0 ? ", " : "") + "xyz"[k] + " " + number_text(facts.low[k]) + " to " +
              number_text(facts.high[k]);
  report.line("bounds: " + bounds);
  report.line("normals: " + share(facts.normals, facts.vertices) +
              "; UVs: " + share(facts.uvs, facts.vertices));
  if (facts.skipped_faces > 0) report.line("skipped: " + skipped_text(facts));
  for (const std::string& note : facts.notes) report.line("note: " + note);
  report.line("parts: " + std::to_string(facts.parts.size()));
  for (std::size_t i = 0; i < std::min(facts.parts.size(), most_shown); ++i)
    report.line(part_text(facts.parts[i]));
  if (facts.parts.size() > most_shown)
    report.line("  and " + std::to_string(facts.parts.size() - most_shown) + " more: --json");
}

ExitCode run(const MeshInfoOptions& options) {
  Report report(options.json);
  const auto mesh = client::load_mesh(options.file);
  if (!mesh) {
    report.problem(mesh.error());
    return report.finish(ExitCode::bad_input);
  }
  const MeshFacts facts = client::mesh_facts(*mesh, options.file);
  report.document()["mesh"] = mesh_json(facts);
  print_mesh(options.file, facts, report);
  return report.finish(ExitCode::done);
}

void declare(MeshInfoOptions& values, Options& options) {
  options.push_back({.names = "file",
                     .target = &values.file,
                     .meaning = "a .ply, .obj, .gltf or .glb of at most 1 GiB; what it becomes in "
                                "memory is bounded by its size",
                     .required = true});
  declare_json(values.json, options);
}

}  // namespace

Command commands::mesh_info() {
  return make_command<MeshInfoOptions>(
      "mesh info", "vertices, triangles, bounds, and parts by name", declare, run);
}

}  // namespace metamer::cli
