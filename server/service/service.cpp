#include "server/service/service.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "common/digest.h"
#include "common/wire/worker_program.h"
#include "server/service/executors/slurm/task_name.h"
#include "server/service/ops/usage.h"
#include "server/service/store/durable_file.h"
#include "server/service/store/schema.h"

namespace metamer::service {

namespace {

/// With what depends on the machine.
Limits completed(Limits limits) {
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  if (limits.memory == 0)
    limits.memory = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 4 * 3;
  return limits;
}

ServiceOptions completed(ServiceOptions options) {
  // Assets that nodes are to read lie where nodes see them.
  if (options.executor == "slurm" && options.store.empty())
    options.store = options.slurm.folder / "assets";
  if (!options.state.empty() && options.store.empty()) options.store = options.state / "assets";
  std::error_code ignored;
  const auto absolute = std::filesystem::absolute(options.store, ignored);
  if (!ignored) options.store = absolute;
  options.worker.command.store = options.store;
  options.limits = completed(options.limits);
  return options;
}

bool draws_gl_by_slurm(const ServiceOptions& options) {
  return options.executor == "slurm" && !options.slurm.commands.gres.empty();
}

/// Of Slurm's tasks, which run the same worker. Those of the two backends never know each other's.
SlurmExecutor::Options slurm_options(const ServiceOptions& all, v1::Backend backend,
                                     const std::string& build, std::string server_id) {
  SlurmExecutor::Options options = all.slurm;
  options.backend = backend;
  if (backend == v1::GL) {
    options.commands.gl_device = all.worker.command.gl_device;
    if (!server_id.empty()) server_id += "/gl";
  } else {
    options.commands.gres.clear();
  }
  std::error_code ignored;
  options.folder = std::filesystem::absolute(options.folder, ignored);
  options.store = all.store;
  options.server = task_prefix(server_id);
  options.commands.worker = std::filesystem::absolute(all.worker.command.program, ignored);
  options.commands.threads = std::max(1u, all.worker.command.threads);
  options.commands.unconfined = all.worker.command.unconfined;
  options.run.build = build;
  return options;
}

Supervisor::Options for_lane(Supervisor::Options options, const Lane& lane) {
  options.lane = lane;
  return options;
}

/// Between two looks at what could not be kept, and at what is too old to be.
constexpr std::chrono::seconds look_interval{1};

/// Of assets, that go at a time where the state's disk is full: many tiles, few of the assets.
constexpr std::uint64_t room_bytes = 16u << 20;

bool hold_all(const v1::Submit& submit, AssetHolds& holds) {
  const auto add = [&](const std::string& bytes) {
    const auto digest = digest_from_bytes(bytes);
    return digest && holds.add(*digest);
  };
  return add(submit.scene_sha256()) &&
         std::all_of(submit.asset().begin(), submit.asset().end(),
                     [&](const v1::AssetName& asset) { return add(asset.sha256()); });
}

/// A job's user has had its assets.
void note_assets(const std::string& user, const v1::Submit& submit, KnownAssets& known) {
  const auto note = [&](const std::string& bytes) {
    if (const auto digest = digest_from_bytes(bytes)) known.add(user, *digest);
  };
  note(submit.scene_sha256());
  for (const v1::AssetName& asset : submit.asset()) note(asset.sha256());
}

/// A job of which the number alone is left.
v1::JobRecord lost_record(std::uint64_t id) {
  v1::JobRecord record;
  record.set_job_id(id);
  record.set_state(v1::FAILED);
  record.set_reason("its record in the state is damaged");
  v1::JobEvent& last = *record.add_event();
  last.set_sequence(1);
  last.mutable_failed()->set_kind(v1::Failed::SERVER);
  last.mutable_failed()->set_reason(record.reason());
  record.set_next_sequence(2);
  return record;
}

}  // namespace

Service::Service(asio::io_context& context, ServiceOptions options)
    : context_(context),
      options_(completed(std::move(options))),
      next_look_(context),
      queue_(options_.keep_bytes, options_.first_job_id, options_.limits, options_.clock),
      views_(options_.limits),
      cpu_(context.get_executor(), for_lane(options_.worker, cpu_jobs), queue_, views_),
      cpu_views_(context.get_executor(), for_lane(options_.worker, cpu_views), queue_, views_),
      gl_(context.get_executor(),
          for_lane(options_.worker, draws_gl_by_slurm(options_) ? gl_views : gl_lane), queue_,
          views_),
      listener_(context.get_executor()) {}

/// The table of users in the state, by a connection of its own: it is read whenever somebody comes,
/// and what `metamerd user` writes meanwhile is seen at once.
Result<void> Service::open_users() {
  if (state_) {
    try {
      users_database_.emplace(options_.state / database_name);
      users_.emplace(*users_database_);
    } catch (const DatabaseError& error) {
      return problem("can't open " + (options_.state / database_name).string() + ": " +
                     error.what());
    }
  }
  logins_.emplace(users_ ? &*users_ : nullptr, options_.open);
  return {};
}

Result<void> Service::start() {
  queue_.count_views([this] { return views_.memory(); });
  if (!options_.state.empty()) {
    auto state = JobStore::open(context_.get_executor(), options_.state);
    if (!state) return tl::unexpected(state.error());
    state_ = *std::move(state);
    build_ = wire::digest_of_program(options_.worker.command.program);
    queue_.keep_in(*state_, build_);
  }
  if (options_.executor == "slurm") {
    if (auto made = make_folder(options_.slurm.folder, "Slurm's folder"); !made) return made;
    if (build_.empty()) build_ = wire::digest_of_program(options_.worker.command.program);
    const std::string id = state_ ? state_->server_id() : "";
    slurm_.emplace(context_.get_executor(), slurm_options(options_, v1::CPU, build_, id), queue_,
                   cpu_views_);
    if (draws_gl_by_slurm(options_))
      gl_slurm_.emplace(context_.get_executor(), slurm_options(options_, v1::GL, build_, id),
                        queue_, gl_);
  }
  if (auto opened = open_users(); !opened) return opened;
  auto store = AssetStore::open(options_.store, options_.store_bytes);
  if (!store) return tl::unexpected(store.error());
  store_ = *std::move(store);
  service_context_ = std::make_unique<ServiceContext>(
      ServiceContext{*store_, queue_, views_, cpu(), cpu_views_, gl(), cpu_views_, gl_,
                     [this] { return listener_.sessions(); }, options_.limits, options_.patience,
                     *logins_, Accounts(users_ ? &*users_ : nullptr), state_.get()});
  service_context_->tell_usage = [this](const Identity& who, v1::Info& info) {
    add_users(listener_, queue_, service_context_->accounts, who.is_admin() ? "" : who.user, info);
    if (!who.is_admin()) return;
    add_sessions(listener_, info);
    add_metrics(counts(), info);
  };
  store_->make_room_by([this] { return queue_.drop_unlisted_picture(); });
  if (state_) state_->make_room_by([this] { return store_->make_room(room_bytes); });
  if (state_) restore_jobs();
  asio::co_spawn(context_, look_after_jobs(), asio::detached);
  for (const wire::Endpoint& endpoint : options_.listen) {
    if (auto opened = listener_.open(endpoint, options_.listening); !opened) return opened;
  }
  cpu().start();
  if (gl_slurm_) gl_slurm_->start();
  listener_.start(*service_context_);
  return {};
}

void Service::change_limits(const Limits& limits, const Patience& patience) {
  options_.limits = completed(limits);
  options_.patience = patience;
}

/// What was kept, as it was; what ran or waited is queued again.
void Service::restore_jobs() {
  std::vector<JobQueue::JobPtr> ended;
  for (JobStore::Kept& kept : state_->take_kept()) {
    const AccountPtr owner =
        kept.user.empty() ? nullptr : service_context_->accounts.named(kept.user);
    if (!kept.record) kept.record = lost_record(kept.id);
    AssetHolds holds(*store_, owner);
    note_assets(kept.user, kept.record->submit(), service_context_->known_assets);
    const bool has_assets = is_end(kept.record->state()) || hold_all(kept.record->submit(), holds);
    const auto job =
        std::make_shared<Job>(*std::move(kept.record), std::move(holds), owner, *state_);
    if (!job->ended() && !has_assets)
      job->fail(v1::Failed::SERVER, "the server has lost its assets");
    if (!job->ended()) (void)job->go_on(build_, queue_.queued());
    if (job->ended())
      ended.push_back(job);
    else
      queue_.restore(job);
  }
  std::sort(ended.begin(), ended.end(),
            [](const auto& a, const auto& b) { return a->ended_at() < b->ended_at(); });
  for (const auto& job : ended) queue_.restore(job);
  queue_.restore(state_->take_leads(), state_->take_work());
}

/// A disk that was full may have room by now, and a job's time may be over.
asio::awaitable<void> Service::look_after_jobs() {
  for (;;) {
    next_look_.expires_after(look_interval);
    const auto [error] = co_await next_look_.async_wait(asio::as_tuple(asio::use_awaitable));
    if (error) co_return;
    store_->try_again();
    if (state_ && state_->trouble())
      state_->try_again([this] { queue_.keep_again(); });
    else
      queue_.keep_again();
    queue_.drop_old();
  }
}

Executor& Service::cpu() {
  if (slurm_) return *slurm_;
  return cpu_;
}

Executor& Service::gl() {
  if (gl_slurm_) return *gl_slurm_;
  return gl_;
}

Counts Service::counts() {
  Counts all;
  all.jobs = queue_.counts();
  all.traffic = service_context_->traffic;
  all.uptime =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - service_context_->started)
          .count();
  all.sessions = listener_.sessions();
  all.views = views_.size();
  all.jobs_queued = queue_.queued();
  all.jobs_running = queue_.running();
  all.store_bytes = store_->bytes();
  all.state_bytes = state_ ? queue_.picture_bytes() : 0;
  for (const Executor* executor :
       std::initializer_list<const Executor*>{&cpu(), &cpu_views_, &gl()}) {
    const v1::WorkerInfo info = executor->info();
    all.workers.push_back({info.backend(), info.starts(), executor->losses()});
  }
  return all;
}

std::string Service::state_line() const {
  return fmt::format("{} running, {} queued, {} sessions", queue_.running(), queue_.queued(),
                     listener_.sessions());
}

asio::awaitable<void> Service::drain(std::chrono::milliseconds limit) {
  if (service_context_) service_context_->closing = true;
  for (const v1::Backend backend : {v1::CPU, v1::GL}) views_.end(backend, "the server ends");
  co_await listener_.drain(
      state_ ? "the server ends; the job goes on when it is back" : "the server ends", limit);
}

Result<void> Service::reload_certificates() {
  if (options_.listening.tls.certificate.empty()) return {};
  return listener_.reload_certificates(options_.listening);
}

void Service::stop() {
  cpu().charge_job();
  gl().charge_job();
  queue_.set_aside();
  next_look_.cancel();
  listener_.stop();
  if (slurm_) slurm_->stop();
  if (gl_slurm_) gl_slurm_->stop();
  cpu_.stop();
  cpu_views_.stop();
  gl_.stop();
  if (store_) store_->stop();
}

}  // namespace metamer::service
