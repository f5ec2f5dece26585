// A worker for tests: speaks the worker's protocol without a renderer. The scene asset's bytes say
// what it does with the job: see fake_worker_script.h. A pixel of the picture is (x, y, 1).
//
// A file beside the store can spoil the start: `no-start` makes it exit with code 3, `never-ready`
// keeps it from saying that it is ready. One for GL leaves the file `started-gl` there. With
// --batch it is a task of a cluster, which starts another.

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "common/digest.h"
#include "common/wire/blocking.h"
#include "common/wire/worker_exit.h"
#include "fake_worker_deeds.h"
#include "fake_worker_script.h"
#include "server/batch/batch.h"

namespace {

using namespace metamer;
using namespace metamer::service::test;
namespace fs = std::filesystem;

/// Of the store, from the folder in it that a worker sees.
constexpr const char* beside = "../..";

constexpr int link = 3;
constexpr int film = 4;

std::mutex link_mutex;

void send(const v1::WorkerEnvelope& message) {
  const std::lock_guard lock(link_mutex);
  if (!wire::write_envelope(link, message)) _exit(0);
}

std::string hex(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += "0123456789abcdef"[byte / 16];
    text += "0123456789abcdef"[byte % 16];
  }
  return text;
}

/// Beats four times a second until the process ends; `beating` is false when it shall not.
struct Heart {
  std::atomic<bool> beating = true;
  std::atomic<std::uint64_t> work = 0;
  void start() {
    std::thread([this] {
      while (true) {
        // A timer of the kernel's: the protocol asks for a beat every quarter of a second.
        ::poll(nullptr, 0, 50);
        if (!beating) continue;
        v1::WorkerEnvelope beat;
        beat.mutable_heartbeat()->set_work(work);
        send(beat);
      }
    }).detach();
  }
};

Heart heart;

void show(std::uint64_t view, const Script& script) {
  v1::WorkerEnvelope message;
  message.mutable_view_event()->set_view_id(view);
  v1::Plan& plan = *message.mutable_view_event()->mutable_updated()->mutable_plan();
  plan.set_width(script.width);
  plan.set_height(script.height);
  send(message);
}

class Job {
 public:
  Job(std::uint64_t id, Script script, fs::path store)
      : id_(id), script_(std::move(script)), store_(std::move(store)) {
    // A file remembers that there was an attempt before.
    const fs::path mark = store_ / beside / ("attempted-" + std::to_string(id_));
    first_attempt_ = !fs::exists(mark);
    std::ofstream(mark).put('x');
  }

  void plan(const v1::CompileJob& request) {
    if (request.keep_factors()) send_factors(nullptr);
    v1::WorkerEnvelope message;
    message.set_job_id(id_);
    keep_factors_ = request.keep_factors();
    chosen_ = request.chosen();
    if (!script_.reach.empty()) {
      message.mutable_failed()->set_reason(
          reached(store_, hex(request.scene_sha256()), script_.reach));
    } else if (script_.has("fail")) {
      message.mutable_failed()->set_kind(v1::Failed::BAD_INPUT);
      message.mutable_failed()->set_reason("the script says so");
      message.mutable_failed()->add_problem()->set_message("it fails");
    } else {
      v1::Plan& plan = *message.mutable_planned()->mutable_plan();
      plan.set_width(script_.width);
      plan.set_height(script_.height);
      plan.set_tile_size(script_.tile);
      *plan.mutable_method() = chosen_;
      if (script_.has("verify")) plan.set_verify_cost(2);
    }
    if (script_.has("stages")) say_preparing(v1::Preparing::READING);
    if (script_.has("stages")) say_preparing(v1::Preparing::PLANNING);
    send(message);
    if (request.prepare()) say_prepared();
  }

  void render(const v1::RenderTiles& request) {
    const std::size_t bytes = std::size_t{script_.width} * script_.height * 12;
    void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, film, 0);
    if (memory == MAP_FAILED) std::abort();
    if (script_.has("stages") && done_ == 0) {
      say_preparing(v1::Preparing::HIERARCHY);
      say_prepared();
    }
    for (const v1::TileRect& tile : request.tile()) {
      trouble();
      stopped_ = stopped_ || stop_waits();
      if (stopped_) break;
      paint(static_cast<float*>(memory), tile);
      if (due("shrink") && (::ftruncate(film, 0) == 0 || errno != EPERM)) std::abort();
      tile_done(tile);
    }
    if (!stopped_) trouble();
    const bool verifies = script_.has("verify") && request.last();
    const bool whole = is_whole(static_cast<const float*>(memory));
    ::munmap(memory, bytes);
    v1::WorkerEnvelope message;
    message.set_job_id(id_);
    if (stopped_) {
      message.mutable_stopped();
    } else {
      if (verifies) tell_verified();
      message.mutable_done()->mutable_timing()->set_compile(0.25);
      if (verifies) message.mutable_done()->mutable_accuracy()->set_kept(whole);
      if (script_.has("broken") && !chosen_.has_exact())
        message.mutable_done()->mutable_better()->mutable_exact();
    }
    send(message);
  }

 private:
  void say_preparing(v1::Preparing::Stage stage) const {
    v1::WorkerEnvelope message;
    message.set_job_id(id_);
    message.mutable_preparing()->set_stage(stage);
    send(message);
  }
  void say_prepared() const {
    v1::WorkerEnvelope message;
    message.set_job_id(id_);
    v1::Timing& timing = *message.mutable_prepared()->mutable_timing();
    timing.set_compile(0.25);
    timing.set_acceleration(0.5);
    timing.set_pilot(1);
    timing.set_prepare(2);
    timing.add_pass()->set_name("none of the daemon's business");
    send(message);
  }

  bool due(const std::string& word) const {
    if (script_.has("once") && !first_attempt_) return false;
    const auto found = script_.at.find(word);
    return found != script_.at.end() && found->second == done_;
  }

  void trouble() {
    if (due("gate")) wait_for_gate();
    if (due("prepared")) say_prepared();
    if (due("preparing")) say_preparing(v1::Preparing::TABLES);
    if (due("crash")) std::abort();
    if (due("exit")) _exit(3);
    if (due("swell")) swell();
    if (due("hang")) {
      heart.beating = false;
      while (true) ::pause();
    }
    if (due("stall")) {
      while (true) ::pause();
    }
    if (due("garbage")) {
      const std::lock_guard lock(link_mutex);
      const char bytes[] = "\xFF\xFF\xFF\xFFgarbage";
      if (::write(link, bytes, sizeof bytes) < 0) _exit(0);
      while (true) ::pause();
    }
    if (due("early")) {
      v1::WorkerEnvelope message;
      message.set_job_id(id_);
      message.mutable_done();
      send(message);
    }
    if (due("stray")) {
      v1::TileRect tile;
      tile.set_x(1);
      tile.set_width(script_.tile);
      tile.set_height(script_.tile);
      tile_done(tile);
    }
  }

  /// True when a StopJob has come that the script does not ignore.
  bool stop_waits() {
    pollfd waiting{link, POLLIN, 0};
    while (::poll(&waiting, 1, 0) == 1) {
      const auto message = wire::read_envelope(link);
      if (!message || !*message) _exit(0);
      if ((*message)->has_stop_job() && !script_.has("deaf")) return true;
    }
    return false;
  }

  /// The test holds the FIFO open and writes a byte when the worker may go on.
  void wait_for_gate() {
    const int gate = ::open((store_ / beside / "gate").c_str(), O_RDONLY | O_CLOEXEC);
    while (!stopped_) {
      pollfd waiting[2] = {{gate, POLLIN, 0}, {link, POLLIN, 0}};
      ::poll(waiting, 2, -1);
      char byte = 0;
      if (waiting[0].revents != 0 && ::read(gate, &byte, 1) == 1) break;
      if (waiting[1].revents != 0) stopped_ = stop_waits();
    }
    ::close(gate);
  }

  void paint(float* pixels, const v1::TileRect& tile) const {
    for (std::uint32_t y = tile.y(); y < tile.y() + tile.height(); ++y) {
      for (std::uint32_t x = tile.x(); x < tile.x() + tile.width(); ++x) {
        float* pixel = pixels + (std::size_t{y} * script_.width + x) * 3;
        pixel[0] = static_cast<float>(x);
        pixel[1] = static_cast<float>(y);
        pixel[2] = 1;
      }
    }
  }

  bool is_whole(const float* pixels) const {
    for (std::uint32_t y = 0; y < script_.height; ++y)
      for (std::uint32_t x = 0; x < script_.width; ++x, pixels += 3)
        if (pixels[0] != static_cast<float>(x) || pixels[1] != static_cast<float>(y) ||
            pixels[2] != 1)
          return false;
    return true;
  }

  void tell_verified() const {
    v1::WorkerEnvelope message;
    message.set_job_id(id_);
    message.mutable_tiles_verified()->set_tiles(3);
    send(message);
  }

  /// In pieces of 100 bytes, "fff…".
  void send_factors(const v1::TileRect* tile) const {
    for (std::uint32_t left = script_.at.at("factors"); left > 0;) {
      const std::uint32_t size = std::min(left, 100u);
      v1::WorkerEnvelope message;
      message.set_job_id(id_);
      if (tile) *message.mutable_factors_piece()->mutable_tile() = *tile;
      message.mutable_factors_piece()->set_data(std::string(size, 'f'));
      send(message);
      left -= size;
    }
  }

  void tile_done(const v1::TileRect& tile) {
    if (keep_factors_) send_factors(&tile);
    ++done_;
    ++heart.work;
    v1::WorkerEnvelope message;
    message.set_job_id(id_);
    *message.mutable_tile_done()->mutable_tile() = tile;
    message.mutable_tile_done()->set_rays(10);
    send(message);
  }

  std::uint64_t id_;
  Script script_;
  fs::path store_;
  bool first_attempt_ = true;
  bool keep_factors_ = false;
  v1::Method chosen_;
  std::uint32_t done_ = 0;  // tiles, in this attempt
  bool stopped_ = false;
};

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void say_damaged(std::uint64_t job, const std::string& digest) {
  v1::WorkerEnvelope message;
  message.mutable_asset_damaged()->set_sha256(digest);
  send(message);
  message.set_job_id(job);
  message.mutable_failed()->set_kind(v1::Failed::SERVER);
  message.mutable_failed()->set_reason("a worker read other bytes");
  send(message);
}

int run(const fs::path& store) {
  if (fs::exists(store / beside / "no-start")) return 3;
  if (!fs::exists(store / beside / "never-ready")) {
    v1::WorkerEnvelope ready;
    ready.mutable_ready()->mutable_capabilities()->add_backend("fake");
    ready.mutable_ready()->set_sandbox("none: a test");
    send(ready);
  }
  heart.start();
  std::optional<Job> job;
  while (true) {
    const auto message = wire::read_envelope(link);
    if (!message || !*message) return 0;
    if ((*message)->has_compile_job()) {
      const std::string scene = (*message)->compile_job().scene_sha256();
      const std::string text = read_file(store / hex(scene));
      const Script script = parse(text);
      if (script.has("slander") || to_bytes(sha256(text)) != scene) {
        say_damaged((*message)->job_id(), scene);
        continue;
      }
      job.emplace((*message)->job_id(), script, store);
      job->plan((*message)->compile_job());
    } else if ((*message)->has_open_view()) {
      const v1::WorkerView& view = (*message)->open_view();
      const Script script = parse(read_file(store / hex(view.open().scene_sha256())));
      if (script.has("shown")) show(view.view_id(), script);
    } else if ((*message)->has_render_tiles() && job) {
      job->render((*message)->render_tiles());
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  std::set_new_handler([] { _exit(wire::exit_out_of_memory); });
  const bool gl = std::any_of(arguments, arguments + count, [](const char* word) {
    return std::strcmp(word, "--gl-device") == 0;
  });
  for (int i = 1; i + 1 < count; ++i) {
    if (std::strcmp(arguments[i], "--batch") == 0)
      return batch::run_batch(
          {.order = arguments[i + 1], .program = fs::canonical("/proc/self/exe")});
    if (std::strcmp(arguments[i], "--store") != 0) continue;
    if (gl) std::ofstream(fs::path(arguments[i + 1]) / beside / "started-gl").put('x');
    return run(arguments[i + 1]);
  }
  return 2;
}
