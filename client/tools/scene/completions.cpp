#include "client/tools/scene/completions.h"

#include <google/protobuf/io/tokenizer.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "client/tools/scene/schema_path.h"
#include "common/scene/names.h"
#include "common/scene/text_tokens.h"
#include "common/spectral/cie.h"
#include "common/spectral/optical_constants.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;
using google::protobuf::FieldDescriptor;
using google::protobuf::io::Tokenizer;
using Kind = SchemaPath::Kind;

/// A folder of a scene is small; what someone opened from their home folder is not searched whole.
constexpr std::size_t max_files_seen = 5000;
constexpr int max_folders_deep = 4;

bool suits(const fs::path& file, const FieldDescriptor& field) {
  const std::string name = file.filename().string();
  const bool mesh = has_extension(name, ".ply") || has_extension(name, ".obj") ||
                    has_extension(name, ".gltf") || has_extension(name, ".glb");
  const bool other = has_extension(name, ".txtpb") || has_extension(name, ".png") ||
                     has_extension(name, ".exr") || has_extension(name, ".bin");
  return field.containing_type() == v1::Mesh::descriptor() ? mesh : !mesh && !other;
}

/// Files of a folder and the folders in it, as a scene there would name them.
std::vector<std::string> files_for(const fs::path& folder, const FieldDescriptor& field) {
  std::vector<std::string> names;
  std::error_code error;
  std::size_t seen = 0;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && at != end && seen < max_files_seen;
       at.increment(error), ++seen) {
    const std::string name = at->path().filename().string();
    if (at->is_directory(error)) {
      if (name.starts_with('.') || at.depth() >= max_folders_deep) at.disable_recursion_pending();
    } else if (!name.starts_with('.') && suits(at->path(), field)) {
      names.push_back(at->path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.emplace_back(one.name);
  return names;
}

std::vector<std::string> quoted_words(const FieldDescriptor& field, std::string_view text,
                                      const fs::path& folder) {
  const std::string& name = field.full_name();
  if (field.name() == "file" || field.name() == "observer_file") return files_for(folder, field);
  if (name == "metamer.v1.Object.material" || name == "metamer.v1.LookMaterial.name")
    return names_in_text(text, "material");
  if (name == "metamer.v1.LookLight.name") {
    std::vector<std::string> names = names_in_text(text, "light");
    names.insert(names.begin(), "*");
    return names;
  }
  if (name == "metamer.v1.Spectrum.standard") return cie::illuminant_names();
  if (name == "metamer.v1.Dielectric.medium") return names_of(media());
  if (name == "metamer.v1.Conductor.metal") return names_of(metals());
  return {};
}

/// The names of a message's fields, with what follows them where it does not stand there yet.
std::vector<std::string> field_words(const SchemaPath& path, std::string_view after) {
  const std::size_t next = after.find_first_not_of(" \t");
  const bool followed = next != std::string_view::npos &&
                        std::string_view(":{<[").find(after[next]) != std::string_view::npos;
  std::vector<std::string> words = candidates(path);
  std::sort(words.begin(), words.end());
  for (std::string& word : words) {
    const FieldDescriptor* field = path.message->FindFieldByName(word);
    if (!followed && field != nullptr)
      word += field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE ? " { " : ": ";
  }
  return words;
}

}  // namespace

std::vector<std::string> names_in_text(std::string_view text, std::string_view kind) {
  std::vector<std::string> names;
  std::set<std::string, std::less<>> told;
  TextTokens tokens(text);
  int depth = 0;
  bool of_kind = false, named = false;
  std::string word;
  while (tokens.next()) {
    if (tokens.is("{") || tokens.is("<")) {
      if (depth++ == 0) of_kind = word == kind;
    } else if (tokens.is("}") || tokens.is(">")) {
      depth = std::max(0, depth - 1);
    } else if (depth == 1 && of_kind && named && tokens.type() == Tokenizer::TYPE_STRING) {
      std::string name;
      Tokenizer::ParseString(tokens.text(), &name);
      if (told.insert(name).second) names.push_back(std::move(name));
    }
    named = tokens.is(":") && word == "name";
    if (!tokens.is(":")) word = tokens.is_identifier() ? tokens.text() : std::string();
  }
  return names;
}

Completions completions(std::string_view text, std::size_t at, const fs::path& folder) {
  const SchemaPath path = schema_path(text, at, *v1::Scene::descriptor());
  Completions found{path.begin, path.end, {}};
  if (path.kind == Kind::name) {
    found.words = field_words(path, text.substr(path.end));
  } else if (path.kind == Kind::value) {
    found.words = candidates(path);
    if (found.words.empty() && path.field != nullptr &&
        path.field->cpp_type() == FieldDescriptor::CPPTYPE_STRING)
      for (const std::string& word : quoted_words(*path.field, text, folder))
        found.words.push_back('"' + word + '"');
  } else if (path.kind == Kind::text && path.field != nullptr) {
    found.words = quoted_words(*path.field, text, folder);
  }
  if (found.words.size() > max_completions) found.words.resize(max_completions);
  return found;
}

}  // namespace metamer::client
