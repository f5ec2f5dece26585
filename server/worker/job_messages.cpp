#include "server/worker/job_messages.h"

#include "common/wire/frame.h"
#include "server/worker/problems.h"

namespace metamer::worker {
namespace {

v1::TileRect to_message(const Rect& rect) {
  v1::TileRect tile;
  tile.set_x(rect.x);
  tile.set_y(rect.y);
  tile.set_width(rect.width);
  tile.set_height(rect.height);
  return tile;
}

}  // namespace

v1::WorkerEnvelope JobMessages::envelope() const {
  v1::WorkerEnvelope message;
  message.set_job_id(id_);
  return message;
}

void JobMessages::preparing(v1::Preparing::Stage stage) {
  v1::WorkerEnvelope message = envelope();
  message.mutable_preparing()->set_stage(stage);
  link_.send(message);
}

void JobMessages::prepared(const v1::Timing& timing) {
  v1::WorkerEnvelope message = envelope();
  *message.mutable_prepared()->mutable_timing() = timing;
  link_.send(message);
}

void JobMessages::planned(const v1::Plan& plan) {
  v1::WorkerEnvelope message = envelope();
  *message.mutable_planned()->mutable_plan() = plan;
  link_.send(message);
}

void JobMessages::tile(const Rect& rect, std::uint64_t rays) {
  v1::WorkerEnvelope message = envelope();
  *message.mutable_tile_done()->mutable_tile() = to_message(rect);
  message.mutable_tile_done()->set_rays(rays);
  link_.send_with_others(message);
}

void JobMessages::tiles_verified(std::uint32_t tiles) {
  v1::WorkerEnvelope message = envelope();
  message.mutable_tiles_verified()->set_tiles(tiles);
  link_.send(message);
}

bool JobMessages::factors(const Rect* rect, const std::string& bytes) {
  constexpr std::size_t piece_size = 128u << 10;
  if (bytes.empty() || bytes.size() > wire::max_factors) return false;
  for (std::size_t at = 0; at < bytes.size(); at += piece_size) {
    v1::WorkerEnvelope message = envelope();
    v1::FactorsPiece& piece = *message.mutable_factors_piece();
    if (rect) *piece.mutable_tile() = to_message(*rect);
    piece.set_data(bytes.substr(at, piece_size));
    link_.send(message);
  }
  return true;
}

void JobMessages::done(v1::JobDone done) {
  v1::WorkerEnvelope message = envelope();
  *message.mutable_done() = std::move(done);
  send_last(message);
}

void JobMessages::stopped(v1::RunRecord record) {
  v1::WorkerEnvelope message = envelope();
  *message.mutable_stopped()->mutable_record() = std::move(record);
  send_last(message);
}

void JobMessages::failed(v1::Failed::Kind kind, const std::string& reason) {
  v1::WorkerEnvelope message = envelope();
  *message.mutable_failed() = failed_for(kind, reason);
  send_last(message);
}

void JobMessages::failed(const std::vector<Problem>& problems) {
  v1::WorkerEnvelope message = envelope();
  *message.mutable_failed() = failed_for(problems);
  send_last(message);
}

void JobMessages::send_last(const v1::WorkerEnvelope& message) {
  ended_ = true;
  link_.send(message);
}

}  // namespace metamer::worker
