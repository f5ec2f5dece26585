// The scene reader against any bytes: as text, as a message on the wire, and as the files that a
// scene names. The input's part up to the first NUL is the scene, the rest its every file.

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "check.h"
#include "common/mesh/gltf/buffers.h"
#include "common/scene/looks/validate_looks.h"
#include "common/scene/scene_file.h"
#include "common/scene/settings.h"
#include "common/scene/validate.h"
#include "common/spectral/files/encoding.h"

namespace {

using metamer::Problem;
using metamer::SceneFile;
using metamer::fuzz::check;
namespace v1 = metamer::v1;

constexpr const char* name = "fuzz.txtpb";

/// Line `number` of `text`, from 1; nothing where there is none.
const char* const no_line = nullptr;
std::string_view line_of(std::string_view text, int number) {
  for (int i = 1; i < number; ++i) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {no_line, 0};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

void check_place(const Problem& problem, const std::string& text) {
  check(problem.line > 0 && problem.column > 0, "a place counts from 1");
  const std::string_view line = line_of(text, problem.line);
  check(line.data() != no_line, "the line exists");
  check(static_cast<std::size_t>(problem.column) <= line.size() + 1, "the column exists");
}

void check_message(const Problem& problem, const std::string& text) {
  check(!problem.message.empty(), "a problem says something");
  const std::string shown = metamer::format(problem, text);
  const auto is_control = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
  };
  check(std::none_of(shown.begin(), shown.end(), is_control), "no control character is shown");
}

bool same(const std::vector<Problem>& a, const std::vector<Problem>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.field == y.field && x.message == y.message;
  });
}

/// What is known only when a file has been read: the file, its entry, how its samples are joined.
bool is_of_a_file(const std::string& field) {
  return field.ends_with(".observer_file") || field.ends_with(".file") ||
         field.ends_with(".entry") || field.ends_with(".interpolation");
}

/// What follows from a scene without findings.
void check_sound(const v1::Scene& scene, const std::string& files) {
  const v1::Settings settings = metamer::with_defaults(scene.settings());
  if (settings.method().has_point()) {
    check(metamer::point_wavelengths(settings.method().point()).has_value(),
          "a sound scene has wavelengths");
  }
  const auto problems = metamer::validate_spectra(
      scene, [&](const std::string&) -> metamer::Result<std::string> { return files; });
  for (const Problem& problem : problems) {
    check(is_of_a_file(problem.field), "only files are wrong in a sound scene's spectra");
    if (!problem.file.empty() && problem.line > 0)
      check_place(problem, metamer::utf8_text(files, name).value_or(files));
  }

  // Its text reads back as the same scene.
  std::string text;
  google::protobuf::TextFormat::PrintToString(scene, &text);
  const auto again = SceneFile::parse(text, name);
  check(again.has_value(), "a sound scene's text can be read");
  check(again->scene().SerializeAsString() == scene.SerializeAsString(),
        "a sound scene's text reads back as the scene");
}

/// All that is wrong with a scene and its looks.
std::vector<Problem> all_wrong(const v1::Scene& scene) {
  std::vector<Problem> problems = metamer::validate_scene(scene);
  const std::vector<Problem> looks = metamer::validate_looks(scene);
  problems.insert(problems.end(), looks.begin(), looks.end());
  return problems;
}

void check_scene(const v1::Scene& scene, const std::string& files) {
  const auto problems = all_wrong(scene);
  check(same(problems, all_wrong(scene)), "validation is deterministic");
  for (const Problem& problem : problems) {
    check(!problem.field.empty(), "a finding has a field");
    check_message(problem, {});
  }
  if (problems.empty()) check_sound(scene, files);
}

void check_text(const std::string& text, const std::string& files) {
  const auto file = SceneFile::parse(text, name);
  if (!file) {
    check_place(file.error(), text);
    check_message(file.error(), text);
    return;
  }
  for (const Problem& problem : all_wrong(file->scene())) {
    const Problem located = file->locate(problem);
    check(located.file == name, "a located problem names the file");
    if (located.line > 0) check_place(located, text);
    check_message(located, text);
  }
  check_scene(file->scene(), files);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static google::protobuf::LogSilencer silence;  // Its log is no error channel of ours.
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(input.find('\0'), input.size());
  const std::string files = input.substr(std::min(end + 1, input.size()));
  check_text(input.substr(0, end), files);

  v1::Scene scene;
  if (scene.ParseFromString(input)) check_scene(scene, files);

  const auto buffers = metamer::gltf_buffers(files, "mesh/fuzz.gltf");
  if (!buffers) check_message(buffers.error(), {});
  return 0;
}
