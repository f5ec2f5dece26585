#include "client/tools/scene/checked_scene.h"

#include <algorithm>
#include <set>
#include <utility>

#include "common/scene/files.h"
#include "common/scene/looks/validate_looks.h"
#include "common/scene/validate.h"
#include "common/spectral/files/spectrum_file.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

}  // namespace

CheckedScene CheckedScene::parse(std::string text, const fs::path& file, DigestCache& digests,
                                 const Change& change) {
  CheckedScene result(file);
  Result<SceneFile> parsed = SceneFile::parse(text, file.string());
  if (!parsed) {
    result.text_ = std::move(text);
    result.problems_.push_back(std::move(parsed.error()));
    return result;
  }
  result.parsed_.emplace(std::move(*parsed));
  if (change) {
    Result<std::vector<Replaced>> replaced = change(result.parsed_->scene());
    if (!replaced) {
      Problem& wrong = replaced.error();
      result.problems_.push_back(wrong.field.empty() ? wrong : result.locate(wrong));
      return result;
    }
    result.replaced_ = std::move(*replaced);
  }
  result.check(digests);
  return result;
}

CheckedScene CheckedScene::read(const fs::path& file, DigestCache& digests, const Change& change) {
  Result<std::string> text = read_file(file, max_scene_text);
  if (text) return parse(std::move(*text), file, digests, change);
  CheckedScene result(file);
  result.problems_.push_back(std::move(text.error()));
  return result;
}

fs::path CheckedScene::folder() const {
  const fs::path folder = file_.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

void CheckedScene::check(DigestCache& digests) {
  // Find what is wrong with the scene itself and with its files' names, all of it.
  std::vector<Problem> problems = validate_scene(scene());
  const std::vector<Problem> looks = validate_looks(scene());
  problems.insert(problems.end(), looks.begin(), looks.end());
  Elsewhere elsewhere;
  for (const Replaced& one : replaced_)
    if (!one.file.empty()) elsewhere[one.field] = one.file;
  auto assets = collect_assets(
      scene(), folder(),
      [&](const fs::path& file, std::uint64_t limit) { return digests.digest(file, limit); },
      elsewhere);
  if (assets) {
    assets_ = std::move(*assets);
  } else {
    problems.insert(problems.end(), assets.error().begin(), assets.error().end());
  }

  // Look into the spectra once they can be reached.
  if (problems.empty()) problems = check_spectra();
  problems_ = locate(problems);
}

std::vector<Problem> CheckedScene::check_spectra() const {
  return validate_spectra(scene(), [this](const std::string& name) { return read_asset(name); });
}

Result<std::string> CheckedScene::read_asset(const std::string& name) const {
  if (const Asset* asset = find_asset(name))
    if (Result<std::string> bytes = read_file(asset->path, asset->size)) return bytes;
  return problem("cannot read \"" + name + "\"");
}

const Asset* CheckedScene::find_asset(std::string_view name) const {
  const auto found = std::find_if(assets_.begin(), assets_.end(),
                                  [&](const Asset& asset) { return asset.name == name; });
  return found == assets_.end() ? nullptr : &*found;
}

const v1::Scene& CheckedScene::scene() const {
  return parsed_ ? parsed_->scene() : v1::Scene::default_instance();
}

std::vector<Problem> CheckedScene::locate(const std::vector<Problem>& problems) const {
  std::vector<Problem> located;
  std::set<std::pair<std::string, std::string>> told;
  for (const Problem& one : problems) {
    Problem placed = locate(one);
    if (told.emplace(placed.field, placed.message).second) located.push_back(std::move(placed));
  }
  return located;
}

Problem CheckedScene::locate(Problem problem) const {
  // Blame what took the field's place.
  if (const Replaced* one = find_replaced(replaced_, problem.field)) {
    if (one->from.empty()) {
      problem.message = one->by + ": " + problem.message;
      problem.field.clear();
      return problem;
    }
    problem.field = one->from + problem.field.substr(one->field.size());
  }
  // A fault inside a file, at a line that is known, is best shown there; name the file as the user
  // would: as seen from here, not from the scene's folder.
  if (problem.line > 0) {
    if (find_asset(problem.file) != nullptr)
      problem.file = (file_.parent_path() / problem.file).string();
    return problem;
  }
  // Else show where the scene names the file.
  if (!problem.file.empty() && problem.file != file_.string()) {
    problem.message = metamer::quoted(problem.file) + " " + problem.message;
    problem.file.clear();
  }
  return parsed_ ? parsed_->locate(std::move(problem)) : problem;
}

std::string CheckedScene::describe(const Problem& located) const {
  if (located.line <= 0) return format(located);
  if (located.file == file_.string()) return format(located, parsed_ ? parsed_->text() : text_);
  const Result<std::string> text = read_file(located.file, max_spectrum_file);
  return format(located, text ? std::string_view(*text) : std::string_view());
}

}  // namespace metamer::client
