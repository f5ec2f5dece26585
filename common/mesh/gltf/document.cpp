#include "common/mesh/gltf/document.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

#include "common/mesh/gltf/buffers.h"
#include "common/mesh/text.h"

namespace metamer::gltf {
namespace {

constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;  // "JSON", "BIN"

std::uint32_t word_at(const Bytes& bytes, std::size_t at) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), bytes.data() + at, b.size());
  return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

Bytes part_of(const Bytes& bytes, std::size_t at, std::size_t length) {
  return {std::make_shared<Bytes>(bytes), {bytes.data() + at, length}};
}

struct Chunks {
  Bytes json, binary;
};

/// glTF 2.0 specification, 4.4: a header of 12 bytes, then chunks of a length, a type and bytes.
Result<Chunks> chunks_of(const Bytes& bytes) {
  if (bytes.size() < 20 || std::memcmp(bytes.data(), "glTF", 4) != 0)
    return problem("is not a .glb: it does not begin with \"glTF\"");
  if (const std::uint32_t version = word_at(bytes, 4); version != 2)
    return problem("is a .glb of version " + std::to_string(version) + "; version 2 is read");
  const std::size_t end = word_at(bytes, 8);
  if (end > bytes.size())
    return problem("is cut short: it says that it has " + std::to_string(end) + " bytes, and has " +
                   std::to_string(bytes.size()));
  Chunks chunks;
  for (std::size_t at = 12; at + 8 <= end;) {
    const std::size_t length = word_at(bytes, at);
    const std::uint32_t type = word_at(bytes, at + 4);
    at += 8;
    if (length > end - at) return problem("has a chunk that is cut short");
    if (type == json_chunk && chunks.json.empty()) chunks.json = part_of(bytes, at, length);
    if (type == binary_chunk && chunks.binary.empty()) chunks.binary = part_of(bytes, at, length);
    at += (length + 3) / 4 * 4;
  }
  if (chunks.json.empty()) return problem("is a .glb without JSON");
  return chunks;
}

/// What is behind the comma of "data:application/octet-stream;base64,AAAA".
Result<Bytes> decode_data_uri(const std::string& uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64"))
    return problem("has a data URI that is not base64");
  std::string text = uri.substr(comma + 1);
  const std::size_t length = text.find_last_not_of('=') + 1;
  text.resize(length);
  text.append((4 - length % 4) % 4, '=');
  std::vector<char> bytes(text.size() / 4 * 3);
  const int got = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                  reinterpret_cast<const unsigned char*>(text.data()),
                                  static_cast<int>(text.size()));
  if (got < 0 || length % 4 == 1) return problem("has a data URI that is not base64");
  bytes.resize(length * 3 / 4);
  return Bytes(std::move(bytes));
}

/// Whether triangles are right without it: it says how they look, or what is read.
bool is_known(const std::string& extension) {
  static constexpr std::array known = {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
                                       "KHR_texture_transform", "KHR_texture_basisu",
                                       "EXT_texture_webp",      "EXT_texture_avif",
                                       "KHR_lights_punctual",   "KHR_xmp_json_ld"};
  return extension.starts_with("KHR_materials_") ||
         std::any_of(known.begin(), known.end(), [&](const char* one) { return extension == one; });
}

/// "2.1" as its two numbers; nothing: it is no version.
std::optional<std::array<unsigned, 2>> version_of(std::string_view text) {
  std::array<unsigned, 2> version{};
  const char* const end = text.data() + text.size();
  const auto major = std::from_chars(text.data(), end, version[0]);
  if (major.ec != std::errc() || major.ptr == end || *major.ptr != '.') return std::nullopt;
  const auto minor = std::from_chars(major.ptr + 1, end, version[1]);
  if (minor.ec != std::errc() || minor.ptr != end) return std::nullopt;
  return version;
}

/// A file of 2.x is read, unless it says that a reader of 2.0 is not enough (glTF 2.0, 3.2).
Result<void> check_version(const Value& asset) {
  const std::string written = asset["version"].text();
  const auto version = version_of(written);
  if (!version || (*version)[0] != 2)
    return problem("is glTF " + mesh_text::cited(written) + "; version 2 is read");
  const Value least = asset["minVersion"];
  if (!least) return {};
  const auto needed = version_of(least.text());
  if (!needed || *needed > std::array<unsigned, 2>{2, 0})
    return problem("needs glTF " + mesh_text::cited(least.text()) +
                   " (asset.minVersion); version 2.0 is read");
  return {};
}

}  // namespace

Result<Document> Document::open(const Bytes& bytes, const std::string& name,
                                const MeshBytes& files) {
  Document document;
  document.name_ = name;
  document.files_ = &files;
  Bytes text = bytes;
  if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) {
    auto chunks = chunks_of(bytes);
    if (!chunks) return tl::unexpected(chunks.error());
    text = chunks->json;
    document.binary_ = chunks->binary;
  }
  if (text.size() > max_gltf_text)
    return problem("has " + std::to_string(text.size()) + " bytes of JSON; at most " +
                   std::to_string(max_gltf_text) + " are read");
  document.json_ = std::make_unique<nlohmann::json>(
      nlohmann::json::parse(text.begin(), text.end(), nullptr, false));
  if (document.json_->is_discarded()) return problem("is neither JSON nor a .glb");
  if (!document.json_->is_object() || !document.json_->contains("asset"))
    return problem("is not glTF 2.0");

  const Value root = document.root(), required = root["extensionsRequired"];
  if (auto right = check_version(root["asset"]); !right) return tl::unexpected(right.error());
  std::string unknown;
  for (std::size_t i = 0; i < required.size(); ++i)
    if (const std::string extension = required[i].text(); !is_known(extension))
      unknown += (unknown.empty() ? "" : ", ") + mesh_text::cited(extension);
  if (!unknown.empty()) return problem("requires an extension that is not read: " + unknown);
  document.buffers_.resize(root["buffers"].size());
  document.size_ = bytes.size();
  if (document.buffers_.size() > max_gltf_buffers)
    return problem("has too many buffers (" + std::to_string(document.buffers_.size()) +
                   "; at most " + std::to_string(max_gltf_buffers) + ")");
  return document;
}

Result<Bytes> Document::read(std::size_t buffer) {
  const Value uri = root()["buffers"][buffer]["uri"];
  if (!uri) {
    if (buffer == 0 && !binary_.empty()) return binary_;
    return problem("has a buffer without bytes: " + uri.place() + " is missing");
  }
  const std::string written = uri.text();
  if (written.starts_with("data:")) return decode_data_uri(written);
  const auto file = file_of_uri(written, name_);
  if (!file) return tl::unexpected(file.error());
  return (*files_)(*file);
}

std::span<const char> Document::bytes(const Value& buffer, std::uint64_t offset,
                                      std::uint64_t length) {
  const auto which = buffer.index(buffers_.size());
  if (!which) {
    buffer.fault("is missing");
    return {};
  }
  auto& read_before = buffers_[*which];
  if (!read_before) {
    read_before = read(*which);
    if (*read_before) size_ += (*read_before)->size();
  }
  if (!*read_before) {
    const Problem& why = read_before->error();
    buffer.fault("can't be read: " + (why.file.empty() ? "" : quoted(why.file) + " ") +
                 why.message);
    return {};
  }
  const Bytes& all = **read_before;
  if (offset > all.size() || length > all.size() - offset) {
    buffer.fault("has " + std::to_string(all.size()) + " bytes; " + std::to_string(length) +
                 " are wanted from " + std::to_string(offset) + " on");
    return {};
  }
  return {all.data() + offset, length};
}

Result<Document::Image> Document::image(const Value& image) {
  if (const Value uri = image["uri"]) {
    const std::string written = uri.text();
    if (written.starts_with("data:"))
      return decode_data_uri(written).map([](Bytes&& bytes) {
        return Image{{}, std::move(bytes)};
      });
    return file_of_uri(written, name_, "image").map([](std::string&& file) {
      return Image{std::move(file), {}};
    });
  }
  const Value views = root()["bufferViews"];
  const auto index = image["bufferView"].index(views.size());
  if (!index) return problem("has neither a URI nor a view");
  const Value view = views[*index];
  constexpr auto most = std::uint64_t{1} << 40;
  const std::span<const char> bytes = this->bytes(view["buffer"], view["byteOffset"].whole(most, 0),
                                                  view["byteLength"].whole(most));
  if (bytes.empty()) return problem("has an empty view");
  const Bytes& owner = **buffers_[*view["buffer"].index(buffers_.size())];
  return Image{{}, Bytes(std::make_shared<Bytes>(owner), bytes)};
}

}  // namespace metamer::gltf
