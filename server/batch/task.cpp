#include "server/batch/task.h"

#include <algorithm>
#include <utility>

#include "common/scene/limits.h"
#include "common/wire/batch_file.h"
#include "common/wire/frame.h"

namespace metamer::batch {
namespace {

using Body = v1::WorkerEnvelope;

constexpr std::size_t pixel_bytes = 3 * sizeof(float);
/// Its work may not stand still for longer.
constexpr std::chrono::seconds most_stall{120};
/// A result that has so much is enough for one task.
constexpr std::size_t enough_bytes = wire::max_batch_file / 4;

Body envelope_of(const v1::BatchOrder& order) {
  Body message;
  message.set_job_id(order.job_id());
  return message;
}

/// A worker's numbers decide how much memory is taken here.
bool can_be(const v1::Plan& plan) {
  return plan.width() > 0 && plan.height() > 0 && plan.width() <= limits::max_side &&
         plan.height() <= limits::max_side &&
         std::uint64_t{plan.width()} * plan.height() <= limits::max_pixels &&
         plan.tile_size() >= 8 && plan.tile_size() <= 256 && plan.tile_size() % 8 == 0;
}

std::string pixels_of(const v1::TileRect& tile, const v1::Plan& plan, const char* film) {
  std::string xyz;
  xyz.reserve(std::size_t{tile.width()} * tile.height() * pixel_bytes);
  for (std::uint32_t y = tile.y(); y < tile.y() + tile.height(); ++y)
    xyz.append(film + (std::size_t{y} * plan.width() + tile.x()) * pixel_bytes,
               tile.width() * pixel_bytes);
  return xyz;
}

}  // namespace

bool same_picture(const v1::Plan& a, const v1::Plan& b) {
  const auto bare = [](v1::Plan plan) {
    plan.clear_threads();
    plan.clear_prediction();
    plan.clear_notice();
    plan.clear_need();
    plan.clear_unneeded();
    plan.clear_verify_cost();
    return plan.SerializeAsString();
  };
  return bare(a) == bare(b);
}

v1::BatchResult Task::run(unsigned threads) {
  result_.set_job_id(order_.job_id());
  result_.set_attempt(order_.attempt());
  result_.set_first(order_.first());
  if (auto carried = carry_out(threads); !carried) {
    result_.set_lost(carried.error().message);
    result_.clear_tile();
  }
  return std::move(result_);
}

Result<void> Task::carry_out(unsigned threads) {
  // Have the scene compiled and planned.
  if (auto ready = hear_until(Body::kReady); !ready) return ready;
  if (failed()) return problem(std::exchange(*result_.mutable_failed(), {}).reason());
  Body compile = envelope_of(order_);
  *compile.mutable_compile_job() = order_.compile();
  worker_.send(compile);
  if (auto planned = hear_until(Body::kPlanned); !planned || failed()) return planned;
  const bool prepares = order_.compile().prepare();
  if (prepares) return hear_until(Body::kPrepared);
  if (order_.count() == 0 && order_.seconds() <= 0 && !order_.conclude()) return {};

  // Render what was asked for.
  const std::size_t film = std::size_t{plan_->width()} * plan_->height() * pixel_bytes;
  if (!worker_.size_film(film)) return problem("no memory for the picture");
  if (!order_.picture().empty())
    if (auto filled = worker_.fill_film(order_.picture()); !filled) return filled;
  const auto begun = Clock::now();
  Result<void> rendered;
  if (order_.conclude())
    rendered = render(0, 0, true);
  else if (order_.count() > 0)
    rendered = render(order_.first(), order_.count(), false);
  else
    rendered = render_for_a_while(threads);
  result_.set_seconds(std::chrono::duration<double>(Clock::now() - begun).count() -
                      result_.done().setup());
  return rendered;
}

/// OpenGL's last bits depend on the tiles that are drawn together, so it draws all that it can, as
/// on one machine. And it goes through the whole scene for each batch, however few its tiles are.
std::uint32_t Task::most_in_a_result() const {
  const std::size_t tile = std::size_t{plan_->tile_size()} * plan_->tile_size() * pixel_bytes;
  return static_cast<std::uint32_t>(std::max<std::size_t>(1, enough_bytes / tile));
}

/// In batches of twice as many tiles each, until the time is over, the result large enough, or the
/// picture whole.
Result<void> Task::render_for_a_while(unsigned threads) {
  const auto begun = Clock::now();
  const std::uint32_t end = grid_.size();
  std::uint32_t next = order_.first();
  const std::uint32_t most = order_.compile().keep_factors() ? 16 : 4096;
  std::uint32_t first_batch = std::clamp(4 * threads, 1u, most);
  if (plan_->backend() == "gl") first_batch = most_in_a_result();
  for (std::uint32_t batch = first_batch; next < end;
       batch = std::min(2 * batch, std::max(most, first_batch))) {
    const std::uint32_t count = std::min(batch, end - next);
    if (auto rendered = render(next, count, next + count == end); !rendered || failed())
      return rendered;
    next += count;
    const std::chrono::duration<double> spent = Clock::now() - begun;
    if (spent.count() - result_.done().setup() >= order_.seconds() || bytes_ >= enough_bytes) break;
  }
  return {};
}

Result<void> Task::render(std::uint32_t first, std::uint32_t count, bool last) {
  if (first < order_.first() && count > 0) return problem("an order that can't be");
  if (first > grid_.size() || count > grid_.size() - first)
    return problem("an order of tiles that the plan has not");
  Body message = envelope_of(order_);
  v1::RenderTiles& tiles = *message.mutable_render_tiles();
  for (std::uint32_t i = first; i < first + count; ++i) {
    const wire::Rect rect = grid_.rect(i);
    v1::TileRect& tile = *tiles.add_tile();
    tile.set_x(rect.x);
    tile.set_y(rect.y);
    tile.set_width(rect.width);
    tile.set_height(rect.height);
    result_.add_tile();
  }
  tiles.set_last(last);
  asked_ += count;
  done_.resize(asked_);
  worker_.send(message);
  if (auto done = hear_until(Body::kDone); !done || failed()) return done;
  if (std::find(done_.begin(), done_.end(), false) != done_.end())
    return worker_.distrust("said that tiles are done which are not");
  return {};
}

/// Takes what comes, up to a message of that kind or a Failed.
Result<void> Task::hear_until(Body::BodyCase wanted) {
  progress_ = Clock::now();
  for (;;) {
    auto message = worker_.next();
    if (!message) return tl::unexpected(message.error());
    const Body::BodyCase kind = message->body_case();
    if (auto taken = take(*std::move(message)); !taken) return taken;
    if (kind == wanted || failed()) return {};
    if (Clock::now() - progress_ > most_stall)
      return worker_.distrust("stopped answering: its work stood still for 120 s");
  }
}

Result<void> Task::take(Body message) {
  switch (message.body_case()) {
    case Body::kHeartbeat:
      if (std::exchange(work_, message.heartbeat().work()) != work_) progress_ = Clock::now();
      return {};
    case Body::kPlanned:
      return take_plan(message.planned().plan());
    case Body::kPrepared:
      *result_.mutable_prepared() = message.prepared().timing();
      return {};
    case Body::kFactorsPiece:
      return take_factors(message.factors_piece());
    case Body::kTileDone:
      return take_tile(message.tile_done());
    case Body::kDone:
      *result_.mutable_done() = std::move(*message.mutable_done());
      return {};
    case Body::kFailed:
      *result_.mutable_failed() = std::move(*message.mutable_failed());
      return {};
    case Body::kAssetDamaged:
      if (result_.damaged_size() < static_cast<int>(limits::max_assets))
        result_.add_damaged(message.asset_damaged().sha256());
      return {};
    case Body::kReady:
    case Body::kPreparing:
    case Body::kTilesVerified:
      return {};
    default:
      return worker_.distrust("sent a message that was not asked for");
  }
}

Result<void> Task::take_plan(const v1::Plan& plan) {
  if (plan_) return worker_.distrust("planned twice");
  if (!can_be(plan)) return worker_.distrust("sent a plan that can't be");
  if (order_.has_plan() && !same_picture(order_.plan(), plan))
    return problem("this node plans another picture than the one that planned the job");
  plan_ = plan;
  grid_ = wire::TileGrid(plan.width(), plan.height(), plan.tile_size());
  if (!order_.has_plan()) *result_.mutable_plan() = plan;
  return {};
}

/// Which of the result's tiles it is, if it is one that is not done.
std::optional<std::uint32_t> Task::place_of(const v1::TileRect& tile) const {
  const auto index = plan_ ? grid_.find(wire::to_rect(tile)) : std::nullopt;
  if (!index || *index < order_.first() || *index - order_.first() >= asked_) return std::nullopt;
  const std::uint32_t place = *index - order_.first();
  return done_[place] ? std::nullopt : std::optional(place);
}

Result<void> Task::take_tile(const v1::TileDone& done) {
  const auto place = place_of(done.tile());
  if (!place) return worker_.distrust("sent a tile that was not asked for");
  v1::BatchTile& tile = *result_.mutable_tile(static_cast<int>(*place));
  tile.set_rays(done.rays());
  tile.set_xyz(pixels_of(done.tile(), *plan_, worker_.film()));
  bytes_ += tile.xyz().size() + tile.factors().size();
  done_[*place] = true;
  return {};
}

Result<void> Task::take_factors(const v1::FactorsPiece& piece) {
  const auto place = piece.has_tile() ? place_of(piece.tile()) : std::nullopt;
  if (piece.has_tile() ? !place : plan_.has_value())
    return worker_.distrust("sent factors that were not asked for");
  std::string& own = place ? *result_.mutable_tile(static_cast<int>(*place))->mutable_factors()
                           : *result_.mutable_scene_factors();
  if (own.size() + piece.data().size() > wire::max_factors)
    return worker_.distrust("sent more factors than a tile may have");
  own += piece.data();
  return {};
}

}  // namespace metamer::batch
