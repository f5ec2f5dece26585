#include "client/cli/scene_input.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <utility>

#include "common/scene/validate.h"
#include "common/spectral/spectrum_file.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;

/// At most `limit` bytes of a file; nothing when it can't be read.
std::optional<std::string> read_up_to(const fs::path& path, std::size_t limit) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  std::string bytes;
  constexpr std::size_t block = 1u << 20;
  while (stream && bytes.size() < limit) {
    const std::size_t begin = bytes.size();
    bytes.resize(std::min(limit, begin + block));
    stream.read(bytes.data() + begin, static_cast<std::streamsize>(bytes.size() - begin));
    bytes.resize(begin + static_cast<std::size_t>(stream.gcount()));
  }
  return bytes;
}

const Asset* find(const std::vector<Asset>& assets, const std::string& name) {
  const auto found = std::find_if(assets.begin(), assets.end(),
                                  [&](const Asset& asset) { return asset.name == name; });
  return found == assets.end() ? nullptr : &*found;
}

}  // namespace

std::optional<SceneInput> SceneInput::load(const std::string& file, const Overrides& overrides,
                                           Report& report) {
  Result<SceneFile> parsed = SceneFile::read(file);
  if (!parsed) {
    const Problem& problem = parsed.error();
    std::optional<std::string> text;
    if (problem.line > 0) text = read_up_to(file, max_scene_text);
    report.problem(problem, text.value_or(std::string()));
    return std::nullopt;
  }

  SceneInput input(std::move(*parsed), fs::path(file).parent_path());
  Result<std::vector<Replaced>> replaced = apply(overrides, input.file_.scene());
  if (!replaced) {
    report.problem(replaced.error(), {});
    return std::nullopt;
  }
  input.replaced_ = std::move(*replaced);
  if (!input.check(report)) return std::nullopt;
  return input;
}

bool SceneInput::check(Report& report) {
  // Find what is wrong with the scene itself and with its files' names, all of it.
  std::vector<Problem> problems = validate_scene(scene());
  auto assets = collect_assets(scene(), folder_.empty() ? fs::path(".") : folder_);
  if (assets) {
    assets_ = std::move(*assets);
  } else {
    problems.insert(problems.end(), assets.error().begin(), assets.error().end());
  }

  // Look into the spectra once they can be reached. A byte over the bound is enough for the
  // parser to refuse a file that is too large.
  if (problems.empty()) {
    problems = validate_spectra(scene(), [this](const std::string& name) -> Result<std::string> {
      const Asset* asset = find(assets_, name);
      auto bytes = asset ? read_up_to(asset->path, max_spectrum_file + 1) : std::nullopt;
      if (!bytes) return metamer::problem("cannot read \"" + name + "\"");
      return std::move(*bytes);
    });
  }
  print_all(problems, report);
  return problems.empty();
}

void SceneInput::print_all(const std::vector<Problem>& problems, Report& report) const {
  // An option that went into several fields is wrong once.
  std::set<std::string> told;
  for (const Problem& problem : problems) {
    const bool optional = !option_of(replaced_, problem.field).empty();
    if (!optional || told.insert(problem.message).second) print(problem, report);
  }
}

std::string SceneInput::name() const { return fs::path(file_.file()).filename().string(); }

Problem SceneInput::locate(Problem problem) const {
  // Blame the option where one is to blame.
  const std::string option = option_of(replaced_, problem.field);
  if (!option.empty()) {
    problem.message = option + ": " + problem.message;
    problem.field.clear();
    return problem;
  }
  // A fault inside a file, at a line that is known, is best shown there; name the file as the user
  // would: as seen from here, not from the scene's folder.
  if (problem.line > 0) {
    if (find(assets_, problem.file) != nullptr) problem.file = (folder_ / problem.file).string();
    return problem;
  }
  // Else show where the scene names the file.
  if (!problem.file.empty() && problem.file != file_.file()) {
    problem.message = metamer::quoted(problem.file) + " " + problem.message;
    problem.file.clear();
  }
  return file_.locate(std::move(problem));
}

void SceneInput::print(Problem problem, Report& report) const {
  problem = locate(std::move(problem));
  if (problem.file == file_.file()) {
    report.problem(problem, file_.text());
  } else if (problem.line > 0) {
    const auto text = read_up_to(problem.file, max_spectrum_file);
    report.problem(problem, text.value_or(std::string()));
  } else {
    report.problem(problem, {});
  }
}

void SceneInput::print(const v1::Notice& notice, Report& report) const {
  Problem note;
  note.field = notice.field();
  note.message = notice.message();
  report.note(locate(std::move(note)));
}

}  // namespace metamer::cli
