#pragma once

#include <memory>
#include <vector>

#include "common/mesh/gltf/value.h"
#include "common/mesh/mesh_file.h"

namespace metamer::gltf {

/// A .gltf or a .glb: its JSON, and its buffers, read when they are first asked for.
class Document {
 public:
  /// Errors: neither glTF nor a whole .glb of version 2; JSON of more than max_gltf_text; an
  /// extension that is required and unknown. `files` has to outlive it.
  static Result<Document> open(const Bytes& bytes, const std::string& name, const MeshBytes& files);

  /// The JSON's top.
  Value root() const { return {&*json_, {}, *faults_}; }
  const std::optional<std::string>& fault() const { return faults_->first(); }

  /// Bytes of the file, and of its buffers as far as they were read.
  std::uint64_t size() const { return size_; }
  /// How many elements without bytes, which are all 0, a file of its size may name.
  std::uint64_t most_zeros() const { return size_; }

  /// `length` bytes of a buffer from `offset` on; a fault and none: there are not so many.
  std::span<const char> bytes(const Value& buffer, std::uint64_t offset, std::uint64_t length);

  /// Where an image is (5.18): a file, relative to the folder that the document's name is relative
  /// to, or its bytes, which are not copied. Errors: a URI that is neither. A view that is not
  /// there, or not sound, is a fault.
  struct Image {
    std::string file;
    Bytes bytes;
  };
  Result<Image> image(const Value& image);

 private:
  Document() = default;
  Result<Bytes> read(std::size_t buffer);

  std::string name_;
  std::uint64_t size_ = 0;  ///< Of the file, and of the buffers that were read.
  const MeshBytes* files_ = nullptr;
  std::unique_ptr<nlohmann::json> json_;
  std::unique_ptr<Faults> faults_ = std::make_unique<Faults>();
  Bytes binary_;  ///< A .glb's own.
  std::vector<std::optional<Result<Bytes>>> buffers_;
};

}  // namespace metamer::gltf
