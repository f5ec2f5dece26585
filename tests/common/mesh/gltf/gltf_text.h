#pragma once

#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "common/mesh/gltf/gltf_mesh.h"
#include "tests/common/mesh/mesh_text.h"

namespace metamer {

/// glTF documents that a test puts together: an accessor a call, all in one buffer.
class GltfText {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};

  GltfText() { json["scenes"] = {{{"nodes", {0}}}}; }

  /// An accessor of tight elements; returns its number.
  template <class T>
  int accessor(const std::vector<T>& numbers, const char* type, std::size_t components,
               bool normalized = false) {
    while (binary_.size() % 4 != 0) binary_ += '\0';
    json["bufferViews"].push_back({{"buffer", 0},
                                   {"byteOffset", binary_.size()},
                                   {"byteLength", numbers.size() * sizeof(T)}});
    binary_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    nlohmann::json one = {{"bufferView", json["bufferViews"].size() - 1},
                          {"componentType", code<T>()},
                          {"count", numbers.size() / components},
                          {"type", type}};
    if (normalized) one["normalized"] = true;
    json["accessors"].push_back(one);
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  int vec3(const std::vector<float>& numbers) { return accessor(numbers, "VEC3", 3); }

  /// A node of a mesh of one primitive; returns the node.
  nlohmann::json& node_of(const nlohmann::json& primitive) {
    json["meshes"].push_back({{"primitives", {primitive}}});
    json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
    return json["nodes"].back();
  }

  std::string gltf() const {
    nlohmann::json whole = json;
    whole["buffers"] = {{{"byteLength", binary_.size()}, {"uri", "a.bin"}}};
    return whole.dump();
  }
  std::string glb() const {
    nlohmann::json whole = json;
    whole["buffers"] = {{{"byteLength", binary_.size()}}};
    std::string text = whole.dump(), binary = binary_;
    while (text.size() % 4 != 0) text += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    std::string all =
        "glTF" + word(2) + word(static_cast<std::uint32_t>(28 + text.size() + binary.size()));
    return all + word(static_cast<std::uint32_t>(text.size())) + "JSON" + text +
           word(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
  }
  const std::string& binary() const { return binary_; }

  static std::string word(std::uint32_t value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
  }

 private:
  template <class T>
  static int code() {
    if (std::is_same_v<T, std::int8_t>) return 5120;
    if (std::is_same_v<T, std::uint8_t>) return 5121;
    if (std::is_same_v<T, std::int16_t>) return 5122;
    if (std::is_same_v<T, std::uint16_t>) return 5123;
    if (std::is_same_v<T, std::uint32_t>) return 5125;
    return 5126;
  }
  std::string binary_;
};

inline const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
inline const std::vector<std::uint16_t> order = {0, 1, 2};

/// One triangle in the plane z = 0.
inline GltfText triangle() {
  GltfText text;
  const int positions = text.vec3(corners), indices = text.accessor(order, "SCALAR", 1);
  text.node_of({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  return text;
}

/// A .gltf with the files that it may name.
inline Result<MeshFile> gltf_of(const std::string& text,
                                const std::map<std::string, std::string>& files = {}) {
  const MeshBytes bytes = [&](const std::string& name) -> Result<Bytes> {
    const auto found = files.find(name);
    if (found == files.end()) return problem("was not sent along");
    return bytes_of(found->second);
  };
  return read_gltf(bytes_of(text), "a.gltf", bytes);
}
inline Result<MeshFile> gltf_of(const GltfText& text) {
  return gltf_of(text.gltf(), {{"a.bin", text.binary()}});
}
inline Result<MeshFile> gltf_case(const std::string& name) { return gltf_of(case_text(name)); }

}  // namespace metamer
