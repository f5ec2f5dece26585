#include "client/session/submission.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <set>

namespace metamer::client {
namespace {

std::string serialise_without_looks(const v1::Scene& scene) {
  if (scene.look().empty()) return serialise(scene);
  v1::Scene sent = scene;
  sent.clear_look();
  return serialise(sent);
}

}  // namespace

std::string serialise(const v1::Scene& scene) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    scene.SerializeToCodedStream(&coded);
  }
  return bytes;
}

Submission make_submission(const v1::Scene& scene, const std::vector<Asset>& assets,
                           std::string name, bool check_only) {
  Submission submission;

  // The scene itself is the first asset.
  Upload scene_upload;
  scene_upload.name = name;
  scene_upload.bytes = serialise_without_looks(scene);
  scene_upload.size = scene_upload.bytes.size();
  scene_upload.sha256 = sha256(scene_upload.bytes);

  v1::Submit& request = submission.request;
  request.set_name(std::move(name));
  request.set_scene_sha256(std::string(to_bytes(scene_upload.sha256)));
  request.set_check_only(check_only);
  request.set_backend(scene.settings().backend());

  // Name every asset in the request, and send files of equal content once.
  std::set<Digest> known = {scene_upload.sha256};
  submission.uploads.push_back(std::move(scene_upload));
  for (const Asset& asset : assets) {
    v1::AssetName* entry = request.add_asset();
    entry->set_name(asset.name);
    entry->set_sha256(std::string(to_bytes(asset.sha256)));
    if (!known.insert(asset.sha256).second) continue;
    Upload upload;
    upload.sha256 = asset.sha256;
    upload.size = asset.size;
    upload.name = asset.name;
    upload.path = asset.path;
    submission.uploads.push_back(std::move(upload));
  }
  return submission;
}

Answer<Chunks> Chunks::open(const Upload& upload, std::uint64_t chunk) {
  Chunks chunks(upload, chunk);
  if (!upload.path.empty()) {
    chunks.file_.open(upload.path, std::ios::binary);
    if (!chunks.file_)
      return session_error(SessionError::Kind::input, "cannot read " + upload.path.string());
  }
  return chunks;
}

Answer<v1::AssetChunk> Chunks::next() {
  const std::uint64_t length = std::min(chunk_, upload_->size - offset_);

  v1::AssetChunk piece;
  piece.set_sha256(std::string(to_bytes(upload_->sha256)));
  piece.set_size(upload_->size);
  piece.set_offset(offset_);
  if (upload_->path.empty()) {
    piece.set_data(upload_->bytes.substr(offset_, length));
  } else {
    std::string* data = piece.mutable_data();
    data->resize(length);
    file_.read(data->data(), static_cast<std::streamsize>(length));
    if (static_cast<std::uint64_t>(file_.gcount()) != length)
      return session_error(SessionError::Kind::input,
                           upload_->path.string() + " changed while it was being sent");
  }
  offset_ += length;
  begun_ = true;
  return piece;
}

}  // namespace metamer::client
