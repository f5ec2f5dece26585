#include "worker_script.h"

#include <fstream>
#include <set>

#include "common/digest.h"

namespace metamer::fuzz {

namespace {

std::set<std::uint64_t> attempted;  // jobs

Script read_script(const std::filesystem::path& store, const std::string& digest) {
  Script script;
  const auto known = digest_from_bytes(digest);
  if (!known) return script;
  std::ifstream file(store / to_hex(*known));
  std::string word;
  // What is no script, a large asset say, is read no further.
  for (int words = 0; words < 32 && file >> word; ++words) {
    if (word == "picture") {
      file >> script.width >> script.height >> script.tile;
      script.width %= 512, script.height %= 512;
    } else if (word == "crash" || word == "stuck" || word == "factors") {
      file >> script.at[word];
    } else {
      script.at[word.substr(0, 16)] = 0;
    }
  }
  return script;
}

v1::WorkerEnvelope of_job(std::uint64_t job) {
  v1::WorkerEnvelope message;
  message.set_job_id(job);
  return message;
}

bool due(const Worker& worker, const char* word) {
  const auto found = worker.script.at.find(word);
  if (found == worker.script.at.end() || found->second != worker.done) return false;
  return worker.first_attempt || !worker.script.has("once");
}

void say_factors(Worker& worker, const v1::TileRect* tile) {
  const auto found = worker.script.at.find("factors");
  if (!worker.compile.keep_factors() || found == worker.script.at.end()) return;
  v1::WorkerEnvelope& message = worker.says.emplace_back(of_job(worker.job));
  if (tile) *message.mutable_factors_piece()->mutable_tile() = *tile;
  message.mutable_factors_piece()->set_data(std::string(found->second % 4096, 'f'));
}

void say_preparing(Worker& worker, v1::Preparing::Stage stage) {
  if (worker.script.has("stages"))
    worker.says.emplace_back(of_job(worker.job)).mutable_preparing()->set_stage(stage);
}

void compile(Worker& worker, const v1::WorkerEnvelope& order) {
  worker.job = order.job_id();
  worker.compile = order.compile_job();
  worker.script = read_script(worker.command.store, worker.compile.scene_sha256());
  worker.first_attempt = attempted.insert(worker.job).second;
  worker.done = 0;
  worker.tiles.clear();
  worker.rendering = false;
  if (worker.script.has("fail")) {
    v1::Failed& failed = *worker.says.emplace_back(of_job(worker.job)).mutable_failed();
    failed.set_kind(v1::Failed::BAD_INPUT);
    failed.add_problem()->set_message("it fails");
    return;
  }
  say_factors(worker, nullptr);
  say_preparing(worker, v1::Preparing::READING);
  v1::Plan& plan = *worker.says.emplace_back(of_job(worker.job)).mutable_planned()->mutable_plan();
  plan.set_width(worker.script.width);
  plan.set_height(worker.script.height);
  plan.set_tile_size(worker.script.tile);
  *plan.mutable_method() = worker.compile.chosen();
  if (worker.script.has("verify")) plan.set_verify_cost(2);
  if (worker.compile.prepare()) worker.says.emplace_back(of_job(worker.job)).mutable_prepared();
}

void take_tiles(Worker& worker, const v1::RenderTiles& order) {
  worker.tiles.assign(order.tile().begin(), order.tile().end());
  worker.rendering = true;
  worker.last_batch = order.last();
  if (worker.done > 0) return;
  say_preparing(worker, v1::Preparing::HIERARCHY);
  if (worker.script.has("stages")) worker.says.emplace_back(of_job(worker.job)).mutable_prepared();
}

void stop(Worker& worker) {
  if (worker.script.has("deaf")) return;
  worker.tiles.clear();
  worker.rendering = false;
  worker.says.emplace_back(of_job(worker.job)).mutable_stopped();
}

/// A tile, or the word that all are there.
void render(Worker& worker) {
  if (!worker.rendering || due(worker, "stuck")) return;
  if (due(worker, "crash")) {
    worker.dies = true;
    return;
  }
  if (!worker.tiles.empty()) {
    const v1::TileRect tile = worker.tiles.front();
    worker.tiles.pop_front();
    say_factors(worker, &tile);
    ++worker.done, ++worker.work;
    v1::TileDone& done = *worker.says.emplace_back(of_job(worker.job)).mutable_tile_done();
    *done.mutable_tile() = tile;
    done.set_rays(10);
    return;
  }
  worker.rendering = false;
  const bool verifies = worker.script.has("verify") && worker.last_batch;
  if (verifies) worker.says.emplace_back(of_job(worker.job)).mutable_tiles_verified()->set_tiles(1);
  v1::JobDone& done = *worker.says.emplace_back(of_job(worker.job)).mutable_done();
  if (verifies) done.mutable_accuracy()->set_kept(true);
  if (worker.script.has("broken") && !worker.compile.chosen().has_exact())
    done.mutable_better()->mutable_exact();
}

v1::ViewEvent& of_view(Worker& worker, std::uint64_t view) {
  v1::ViewEvent& event = *worker.says.emplace_back().mutable_view_event();
  event.set_view_id(view);
  return event;
}

void answer_update(Worker& worker, std::uint64_t view, std::uint64_t revision) {
  const Script& script = worker.views[view];
  if (script.has("shut")) {
    of_view(worker, view).mutable_closed()->mutable_reason()->set_kind(v1::Failed::BAD_INPUT);
  } else if (script.has("refuse") && revision != 0) {
    of_view(worker, view).mutable_refused()->set_revision(revision);
  } else {
    v1::ViewUpdated& updated = *of_view(worker, view).mutable_updated();
    updated.set_revision(revision);
    updated.mutable_plan()->set_width(script.width);
    updated.mutable_plan()->set_height(script.height);
  }
}

/// In two bands, where it has two rows.
void send_frame(Worker& worker, const v1::NextFrame& order) {
  const auto found = worker.views.find(order.view_id());
  if (found == worker.views.end()) return;
  const std::uint32_t width = found->second.width, height = found->second.height;
  for (std::uint32_t row = 0; row < height;) {
    const std::uint32_t rows = row == 0 && height > 1 ? height / 2 : height - row;
    v1::FrameBand& band = *of_view(worker, order.view_id()).mutable_band();
    band.set_width(width);
    band.set_height(height);
    band.set_first_row(row);
    band.set_rgb(std::string(std::size_t{3} * width * rows, 'c'));
    if (order.xyz()) band.set_xyz(std::string(band.rgb().size() * sizeof(float), 'x'));
    row += rows;
    if (row == height) band.mutable_frame()->set_complete(true);
  }
}

void carry_out(Worker& worker, const v1::WorkerEnvelope& order) {
  using Body = v1::WorkerEnvelope;
  switch (order.body_case()) {
    case Body::kCompileJob:
      return compile(worker, order);
    case Body::kRenderTiles:
      return take_tiles(worker, order.render_tiles());
    case Body::kStopJob:
      return stop(worker);
    case Body::kOpenView: {
      const std::string& scene = order.open_view().open().scene_sha256();
      worker.views[order.open_view().view_id()] = read_script(worker.command.store, scene);
      return answer_update(worker, order.open_view().view_id(), 0);
    }
    case Body::kUpdateView:
      return answer_update(worker, order.update_view().view_id(), order.update_view().revision());
    case Body::kNextFrame:
      return send_frame(worker, order.next_frame());
    case Body::kProbe:
      return of_view(worker, order.probe().view_id())
          .mutable_probed()
          ->set_number(order.probe().number());
    case Body::kCloseView:
      worker.views.erase(order.close_view().view_id());
      of_view(worker, order.close_view().view_id()).mutable_closed();
      return;
    default:
      return;
  }
}

}  // namespace

void forget_attempts() { attempted.clear(); }

void work(Worker& worker, bool may_be_ready) {
  if (!worker.ready) {
    if (!may_be_ready) return;
    worker.ready = true;
    worker.says.emplace_back().mutable_ready()->mutable_capabilities()->add_backend("scripted");
  } else if (!worker.orders.empty()) {
    const v1::WorkerEnvelope order = std::move(worker.orders.front());
    worker.orders.pop_front();
    carry_out(worker, order);
  } else {
    render(worker);
  }
}

}  // namespace metamer::fuzz
