#include "common/mesh/gltf/buffers.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace metamer {

namespace {

using nlohmann::json;

/// True for "http:…": a letter, then letters, digits, + - . up to a colon (RFC 3986, 3.1).
bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find_first_of(":/?#");
  return colon != std::string_view::npos && colon > 0 && uri[colon] == ':';
}

}  // namespace

std::optional<std::string> percent_decode(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const std::string_view digits = uri.substr(i + 1, 2);
    unsigned byte = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    if (error != std::errc() || digits.size() != 2 || end != digits.data() + 2) {
      return std::nullopt;
    }
    text += static_cast<char>(byte);
    i += 2;
  }
  return text;
}

Result<std::string> file_of_uri(const std::string& uri, const std::string& name, const char* what) {
  const std::string begin = std::string("names the ") + what + " " + quoted(uri);
  if (has_scheme(uri)) return problem(begin + ", which is not a file");
  const auto decoded = percent_decode(uri);
  if (!decoded || decoded->empty()) return problem(begin + ", which is not a URI");
  const auto path = std::filesystem::path(name).parent_path() / *decoded;
  return path.lexically_normal().string();
}

Result<std::vector<std::string>> gltf_buffers(std::string_view text, const std::string& name) {
  const std::string file = "file " + quoted(name) + " ";
  const json document = json::parse(text, nullptr, false);
  if (document.is_discarded()) return problem(file + "is not JSON");
  if (!document.is_object() || !document.contains("asset"))
    return problem(file + "is not glTF 2.0");
  const auto buffers = document.find("buffers");
  if (buffers == document.end()) return std::vector<std::string>();
  if (!buffers->is_array()) return problem(file + "is not glTF 2.0: buffers is not a list");
  if (buffers->size() > max_gltf_buffers) {
    return problem(file + "has too many buffers (" + std::to_string(buffers->size()) +
                   "; at most " + std::to_string(max_gltf_buffers) + ")");
  }

  std::vector<std::string> names;
  for (const json& buffer : *buffers) {
    const auto uri = buffer.is_object() ? buffer.find("uri") : buffer.end();
    if (!buffer.is_object() || uri == buffer.end() || !uri->is_string()) {
      return problem(file + "has a buffer without a URI");
    }
    const auto& written = uri->get_ref<const std::string&>();
    if (written.starts_with("data:")) continue;
    auto resolved = file_of_uri(written, name);
    if (!resolved) return problem(file + resolved.error().message);
    if (std::find(names.begin(), names.end(), *resolved) == names.end())
      names.push_back(*std::move(resolved));
  }
  return names;
}

}  // namespace metamer
