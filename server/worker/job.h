#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "common/problem.h"
#include "metamer/v1/worker.pb.h"
#include "server/film/film.h"
#include "server/import/importer.h"
#include "server/methods/method.h"
#include "server/plan/plan.h"
#include "server/render/renderer.h"
#include "server/scene/render_scene.h"
#include "server/worker/assets.h"
#include "server/worker/job_messages.h"
#include "server/worker/link.h"
#include "server/worker/run_clock.h"
#include "server/worker/view_turns.h"

namespace metamer::worker {

/// What a worker is started with.
struct WorkerOptions {
  std::filesystem::path store;  ///< The assets that it sees, by their hex digest.
  unsigned threads = 0;
  Backend* backend = nullptr;                  ///< What it draws by.
  int film_descriptor = -1;                    ///< Shared memory, sized by the daemon.
  const import::Importer* importer = nullptr;  ///< Reads mesh files.
  TellDamage tell_damage = [](const std::string&) {};
  v1::MachineRecord machine = {};  ///< For records: what it was found out before the sandbox.

  /// As plans see them.
  Capabilities plan_capabilities() const {
    return {.threads = threads, .backend = backend->name(), .features = backend->features()};
  }
  /// Of a scene's files, in the importer. What is named has to outlive it.
  MeshImport meshes(const AssetNames& names, const std::atomic<bool>& cancelled) const {
    return [this, &names, &cancelled](const MeshRequest& request) {
      auto meshes = importer->import(request, names, cancelled);
      if (!meshes) tell_damage_of(meshes.error(), names, tell_damage);
      return meshes;
    };
  }
  /// Of a scene's textures, in this process.
  TextureImport textures(const AssetNames& names) const { return textures_of(assets(names)); }
  SkyImport skies(const AssetNames& names) const { return skies_of(assets(names)); }
  AssetReader assets(const AssetNames& names) const {
    return stored_assets(names, store, tell_damage);
  }
  /// The scene of this digest. Errors: is_damage(); other bytes than a scene's.
  Result<v1::Scene> scene(const std::string& digest) const;
};

/// Counts pixels and other steps, for the heartbeat.
using Work = std::atomic<std::uint64_t>;

/// One job in the worker, from the scene's bytes to the pixels: the way of the data as one readable
/// object. Runs on one thread; `stop` alone may be called from another.
class Job {
 public:
  /// Between two parts of its picture the job gives the views their turns.
  Job(std::uint64_t id, const WorkerOptions& options, Link& link, Work& work,
      ViewTurns& view_turns);
  ~Job();

  /// Parses, compiles and plans; sends JobPlanned, Failed or JobStopped. Where the message says
  /// prepare, then builds what the plan needs; sends Prepared, Failed or JobStopped.
  void compile(const v1::CompileJob& message);

  /// Builds what the plan needs and sends Prepared (the first time), renders the tiles in their
  /// order; sends TileDone for each, then, where that is asked for, holds the whole picture against
  /// the reference; sends JobDone, Failed or JobStopped. Only after a JobPlanned; any number of
  /// times.
  void render(const v1::RenderTiles& message);

  /// Makes the running step end soon with JobStopped.
  void stop() { stopped_ = true; }

  /// Says JobStopped for a job that is between two steps.
  void send_stopped() { messages_.stopped(record()); }

  std::uint64_t id() const { return messages_.id(); }
  bool stopped() const { return stopped_; }
  /// True once JobDone, Failed or JobStopped has been sent.
  bool ended() const { return messages_.ended(); }

 private:
  using Clock = std::chrono::steady_clock;
  static double since(Clock::time_point start);

  bool succeeds(const Result<void>& result);
  bool make_plan(const v1::CompileJob& message);
  bool build(const std::function<bool()>& prepare);
  bool plan_verification();
  bool plan_factors();
  void prepare_method();
  Result<void> prepare();
  Result<void> draw(const v1::RenderTiles& message, const Film& film);
  Result<void> draw_on();
  Result<void> conclude(const Film& film, v1::JobDone& done);
  void measure_promise(v1::JobDone& done);
  Result<void> verify(const Film& film, v1::JobDone& done);
  void take(const DrawnTile& drawn);
  v1::RunRecord record();

  JobMessages messages_;
  RunClock run_clock_;
  std::atomic<std::uint32_t> tiles_drawn_ = 0;
  RayCounts rays_;  ///< Of what draw() has drawn.
  const WorkerOptions& options_;
  Work& work_;
  ViewTurns& view_turns_;
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> too_many_factors_ = false;  ///< The picture goes on without.
  bool keep_factors_ = false;
  std::unique_ptr<RenderScene> scene_;  // outlives what refers to it
  std::unique_ptr<Method> method_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<Probe> probe_;  ///< Of the renderer.
  bool built_ = false;            ///< Its hierarchy, or it is being built.
  bool prepared_ = false;         ///< The renderer knows plan and method.
  bool told_prepared_ = false;
  v1::Settings settings_;  ///< With the defaults filled in.
  v1::Plan plan_;
  v1::Timing timing_;
  double planned_setup_ = 0;  ///< Of its acceleration and prepare, what planning took.
  Clock::time_point begun_;
};

}  // namespace metamer::worker
