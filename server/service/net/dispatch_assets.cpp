// Assets: what is missing, their bytes, and what a request holds of them.
#include "server/service/net/dispatch.h"

#include "server/service/limits.h"
#include "server/service/store/durable_file.h"

namespace metamer::service {

namespace {

tl::expected<Digest, Refusal> to_digest(const std::string& bytes) {
  if (const auto digest = digest_from_bytes(bytes)) return *digest;
  return refuse(v1::Error::LIMIT, "a digest has 32 bytes, not " + std::to_string(bytes.size()));
}

}  // namespace

/// Whether the store's having an asset is something that this client has caused, or sees anyhow.
bool Dispatch::may_know(const Digest& digest) const {
  return identity_->is_admin() || context_.known_assets.knows(identity_->user, digest);
}

/// What has to be in the store for a request, as far as this client may know of it: how long
/// others' files take is theirs. What is no digest is refused by itself.
std::vector<Digest> Dispatch::named_assets(const v1::Envelope& request) const {
  std::vector<Digest> all;
  const auto add = [&](const std::string& bytes) {
    const auto digest = digest_from_bytes(bytes);
    if (digest && may_know(*digest)) all.push_back(*digest);
  };
  const auto add_scene = [&](const auto& message) {
    add(message.scene_sha256());
    for (const v1::AssetName& asset : message.asset()) add(asset.sha256());
  };
  for (const std::string& bytes : request.offer_assets().sha256()) add(bytes);
  if (request.has_submit()) add_scene(request.submit());
  if (request.has_open_view()) add_scene(request.open_view());
  if (request.has_update_view()) add_scene(request.update_view());
  return all;
}

Dispatch::Answer Dispatch::offer(const v1::OfferAssets& offer) {
  v1::Envelope envelope;
  v1::MissingAssets& missing = *envelope.mutable_missing_assets();
  for (const std::string& bytes : offer.sha256()) {
    const auto digest = to_digest(bytes);
    if (!digest) return tl::unexpected(digest.error());
    if (holds_->size() >= context_.limits.held_assets) {
      return refuse(v1::Error::LIMIT,
                    "a client may hold " + std::to_string(context_.limits.held_assets) + " assets");
    }
    if (may_know(*digest) && holds_->add(*digest)) continue;
    context_.known_assets.forget(identity_->user, *digest);
    missing.add_sha256(bytes);
  }
  return envelope;
}

asio::awaitable<Dispatch::Answer> Dispatch::chunk(const v1::AssetChunk& chunk) {
  const auto digest = to_digest(chunk.sha256());
  if (!digest) co_return tl::unexpected(digest.error());
  if (auto taken = take_chunk(*digest, chunk); !taken) {
    upload_.reset();
    co_return tl::unexpected(taken.error());
  }
  if (!upload_->complete()) co_return std::nullopt;
  AssetUpload upload = *std::exchange(upload_, std::nullopt);
  if (const auto stored = co_await store(std::move(upload)); !stored)
    co_return tl::unexpected(stored.error());
  context_.known_assets.add(identity_->user, *digest);
  holds_->add(*digest);
  v1::Envelope envelope;
  envelope.mutable_asset_stored()->set_sha256(chunk.sha256());
  co_return envelope;
}

tl::expected<void, Refusal> Dispatch::take_chunk(const Digest& digest,
                                                 const v1::AssetChunk& chunk) {
  if (chunk.data().size() > wire::max_chunk) {
    return refuse(v1::Error::LIMIT, "a chunk of " + std::to_string(chunk.data().size()) +
                                        " bytes is over the limit of " +
                                        std::to_string(wire::max_chunk));
  }
  if (upload_ && (upload_->digest() != digest || upload_->size() != chunk.size())) {
    return refuse(v1::Error::ORDER, "a chunk of another asset came before this one was complete");
  }
  if (!upload_) {
    if (chunk.offset() != 0) {
      return refuse(v1::Error::ORDER, "an asset's first chunk has to be at offset 0, not " +
                                          std::to_string(chunk.offset()));
    }
    if (holds_->size() >= context_.limits.held_assets) {
      return refuse(v1::Error::LIMIT,
                    "a client may hold " + std::to_string(context_.limits.held_assets) + " assets");
    }
    auto upload = AssetUpload::begin(context_.store, account_, digest, chunk.size());
    if (!upload) return tl::unexpected(upload.error());
    upload_.emplace(*std::move(upload));
  }
  return upload_->add(chunk.offset(), chunk.data());
}

/// Puts an asset into the store: where that is kept its bytes are on the disk before its name, and
/// that before the answer.
asio::awaitable<tl::expected<void, Refusal>> Dispatch::store(AssetUpload upload) {
  if (!context_.state) co_return upload.commit();
  // With names: GCC 12 destroys some temporaries of a co_await twice.
  Journal::Work write = [file = upload.temporary()](Database&) { sync_file(file); };
  auto trouble = co_await context_.state->carry_out(std::move(write));
  if (!trouble) {
    if (auto stored = upload.commit(); !stored) co_return stored;
    Journal::Work name = [folder = context_.store.folder()](Database&) { sync_folder(folder); };
    trouble = co_await context_.state->carry_out(std::move(name));
  }
  if (!trouble) co_return tl::expected<void, Refusal>();
  context_.store.disk().refused(trouble->message);
  co_return refuse(v1::Error::INTERNAL, "an asset can't be kept: " + trouble->message);
}

/// Keeps a scene's assets from eviction, before anything else may need room.
tl::expected<AssetHolds, Refusal> Dispatch::hold(const std::string& scene, const AssetNames& assets,
                                                 v1::Backend backend) {
  if (static_cast<std::size_t>(assets.size()) > limits::max_assets) {
    return refuse(v1::Error::LIMIT, "a scene with " + std::to_string(assets.size()) +
                                        " assets is over the limit of " +
                                        std::to_string(limits::max_assets));
  }
  if (!v1::Backend_IsValid(backend))
    return refuse(v1::Error::LIMIT, "there is no backend of number " + std::to_string(backend));
  AssetHolds holds(context_.store, account_);
  const auto add = [&](const std::string& bytes,
                       const std::string& name) -> tl::expected<void, Refusal> {
    const auto digest = to_digest(bytes);
    if (!digest) return tl::unexpected(digest.error());
    if (may_know(*digest) && holds.add(*digest)) return {};
    if (may_know(*digest) && context_.store.damaged(*digest))
      return refuse(v1::Error::MISSING_ASSET, holds.describe_damage(*digest, name));
    return refuse(v1::Error::MISSING_ASSET,
                  "the store lacks " + name + " (" + to_hex(*digest) + ")");
  };
  if (auto held = add(scene, "the scene"); !held) return tl::unexpected(held.error());
  for (const v1::AssetName& asset : assets)
    if (auto held = add(asset.sha256(), asset.name()); !held) return tl::unexpected(held.error());
  return holds;
}

}  // namespace metamer::service
