#include "world.h"

#include <unistd.h>

#include "../check.h"
#include "scripted_worker.h"
#include "server/service/access/users.h"
#include "server/service/store/schema.h"
#include "virtual_clock.h"

// Of sanitizer/allocator_interface.h, which Debian has for Clang alone.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();

namespace metamer::fuzz {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

namespace {

/// Beats are due four times a second; a worker that is silent for 5 s is ended.
constexpr milliseconds longest_step{2000};
constexpr int most_rounds = 20'000;  ///< Until all is answered.

/// Of this process, removed at its end; in memory where there is such a folder.
class Folders {
 public:
  static Folders& all() {
    static Folders folders;
    return folders;
  }
  fs::path make() {
    const fs::path folder = top_ / std::to_string(++made_);
    fs::create_directory(folder);
    return folder;
  }
  /// A state with users in it, made once.
  const fs::path& state(std::vector<std::string>& tokens) {
    if (state_.empty()) make_state();
    tokens = tokens_;
    return state_;
  }
  ~Folders() {
    std::error_code ignored;
    fs::remove_all(top_, ignored);
  }

 private:
  Folders() {
    const fs::path shared = "/dev/shm";
    std::string pattern =
        ((fs::exists(shared) ? shared : fs::temp_directory_path()) / "metamer-fuzz-XXXXXX")
            .string();
    top_ = ::mkdtemp(pattern.data());
  }

  void make_state() {
    state_ = top_ / "state";
    fs::create_directory(state_);
    service::Database database(state_ / service::database_name);
    check(service::migrate(database).has_value(), "the tables are made");
    service::Users users(database);
    const std::pair<const char*, v1::Role> all[] = {
        {"ann", v1::SUBMITTER}, {"bob", v1::VIEWER}, {"cy", v1::ADMIN}, {"dee", v1::SUBMITTER}};
    for (const auto& [name, role] : all) {
      service::UserChange change;
      change.name = name;
      change.role = role;
      check(users.add(change, 0).has_value(), "a user is added");
      tokens_.push_back(users.add_token(name, "desk", std::nullopt, 0));
    }
    tokens_.push_back(users.add_token("ann", "old", 1.0, 0));
    check(users.revoke("dee", 1).has_value(), "a user is revoked");
  }

  fs::path top_, state_;
  std::vector<std::string> tokens_;
  std::uint64_t made_ = 0;
};

}  // namespace

World::World(Options options, Facts& facts)
    : options_(options),
      facts_(facts),
      folder_(Folders::all().make()),
      allocated_before_(__sanitizer_get_current_allocated_bytes()) {
  forget_scripts();
  facts_.owners.clear();
  facts_.views.clear();
  facts_.tokens.clear();
  service::ServiceOptions set;
  set.listen = {wire::parse_endpoint("unix:" + (folder_ / "socket").string()).value(),
                wire::parse_endpoint("127.0.0.1:0").value()};
  set.open = true;
  set.store = folder_ / "store";
  set.first_job_id = 1;
  set.keep_bytes = 2 << 20;
  set.store_bytes = 4 << 20;
  set.worker.command.program = "/dev/null";
  if (options_.small_limits) {
    set.limits.sessions = 6;
    set.limits.session_watches = 3;
    set.limits.views = 5;
    set.limits.session_views = 2;
    set.limits.held_assets = 8;
    set.limits.live_jobs = 6;
    set.limits.ended_jobs = 2;
    set.keep_bytes = 1 << 20;
    set.store_bytes = 200'000;
  }
  if (options_.keeps_state) {
    set.state = folder_ / "state";
    set.patience.recheck = milliseconds(200);
    fs::copy(Folders::all().state(facts_.tokens), set.state, fs::copy_options::recursive);
  }
  service_ = std::make_unique<service::Service>(loop_, set);
  check(service_->start().has_value(), "the daemon starts");
  port_ = service_->endpoints().back().port;
}

void World::poll() {
  loop_.restart();
  loop_.poll();
}

Peer* World::open(std::size_t from) {
  std::erase_if(peers_, [](const auto& peer) { return peer->closed(); });
  if (peers_.size() == most_peers || drained_) return nullptr;
  if (from == 0)
    peers_.push_back(std::make_unique<Peer>(facts_, (folder_ / "socket").string()));
  else
    peers_.push_back(std::make_unique<Peer>(facts_, port_, static_cast<std::uint8_t>(from)));
  return peers_.back().get();
}

void World::settle() {
  poll();
  for (const auto& peer : peers_) peer->read(peer->appetite);
  poll();
}

void World::pass(milliseconds time) {
  while (time.count() > 0) {
    const milliseconds step = std::min(time, longest_step);
    time -= step;
    let_workers_beat();
    advance_clock(step);
    // A timer that is due makes Asio look at the others, too.
    boost::asio::steady_timer kick(loop_, boost::asio::steady_timer::time_point::min());
    bool ran = false;
    kick.async_wait([&](boost::system::error_code) { ran = true; });
    while (!ran) poll();
    poll();
  }
}

void World::drain() {
  if (std::exchange(drained_, true)) return;
  boost::asio::co_spawn(loop_, service_->drain(milliseconds(1000)), boost::asio::detached);
  poll();
}

void World::check_memory() const {
  // A message each way, what waits to be sent and a picture for each client; jobs and views.
  constexpr std::size_t of_peer = 3 << 20, of_daemon = 24 << 20;
  const std::size_t taken = __sanitizer_get_current_allocated_bytes();
  check(taken < allocated_before_ + of_daemon + of_peer * (peers_.size() + 1),
        "what clients make the daemon keep is bounded");
}

/// Every client reads, and asks once more: then all that it has asked is answered.
void World::finish_questions() {
  set_start(Start::works);
  for (const auto& peer : peers_) {
    peer->appetite = Peer::everything;
    peer->ask_last();
  }
  const auto waits = [](const auto& peer) { return peer->can_ask() && !peer->has_last(); };
  for (int round = 0; std::any_of(peers_.begin(), peers_.end(), waits); ++round) {
    check(round < most_rounds, "each client is answered");
    settle();
    let_workers_work(4);
    // The journal, and what reads a doubted asset, have threads of their own, in time of their own.
    ::usleep(50);
    if (round % 64 == 63) pass(milliseconds(500));
  }
  for (const auto& peer : peers_)
    if (peer->can_ask() && peer->has_last()) peer->check_answers();
}

v1::Envelope World::ask_owner(Peer& owner, const v1::Envelope& request) {
  const std::uint64_t before = facts_.answers;
  owner.ask(request);
  for (int round = 0; facts_.answers == before; ++round) {
    check(round < most_rounds && !owner.closed(), "the owner is answered");
    poll();
    owner.read(Peer::everything);
    let_workers_work(1);
    if (options_.keeps_state) ::usleep(50);
    if (round % 64 == 63) pass(milliseconds(500));
  }
  return owner.latest();
}

std::uint64_t World::bytes_of_files() const {
  const fs::path store = folder_ / "store";
  std::uint64_t bytes = 0;
  for (const auto& file : fs::directory_iterator(store))
    if (file.is_regular_file()) bytes += file.file_size();  // Others are workers' folders.
  return bytes;
}

/// Cancels all jobs that have not ended.
void World::cancel_jobs(Peer& owner) {
  v1::Envelope request;
  request.mutable_list_jobs();
  const v1::JobList jobs = ask_owner(owner, request).job_list();
  for (const v1::JobSummary& job : jobs.job()) {
    request.mutable_cancel()->set_job_id(job.job_id());
    const v1::Envelope answer = ask_owner(owner, request);
    // Those that end meanwhile may push others that have ended out of the list.
    check(answer.has_job_summary() || answer.error().code() == v1::Error::STATE ||
              answer.error().code() == v1::Error::NOT_FOUND,
          "a job that is listed can be cancelled, or has ended");
  }
  for (int rounds = 0; rounds < 40; ++rounds) {
    let_workers_work(2);
    pass(milliseconds(100));
  }
}

/// What the server's owner sees when all others have gone.
void World::check_no_client_left() {
  Peer owner(facts_, (folder_ / "socket").string());
  v1::Envelope request;
  request.mutable_hello()->set_protocol_version(1);
  check(ask_owner(owner, request).has_welcome(), "the owner gets in");
  request.mutable_get_info();
  v1::Info info = ask_owner(owner, request).info();
  // What a client has sent before it went is carried out still, at the pace of the journal.
  for (int tries = 0; info.jobs_queued() + info.jobs_running() > 0; ++tries) {
    check(tries < 20, "no job goes on");
    cancel_jobs(owner);
    info = ask_owner(owner, request).info();
  }
  check(info.sessions() == 1, "no session is left");
  check(info.session_size() == 1 && info.session(0).watches() == 0, "no watch is left");
  cancel_jobs(owner);  // those that pause
  info = ask_owner(owner, request).info();
  for (const v1::UserUsage& user : info.user()) check(user.asset_bytes() == 0, "no asset is held");
  check(info.store_bytes() == bytes_of_files(), "the store knows what it has");
  check(service_->counts().views == 0, "no view is left");
}

World::~World() {
  finish_questions();
  check_memory();
  peers_.clear();
  // Those who are told why before they are closed have two seconds to read it.
  poll();
  pass(milliseconds(3000));
  for (int round = 0; service_->counts().sessions > 0; ++round) {
    check(round < most_rounds, "no session is left");
    poll();
    if (options_.keeps_state) ::usleep(50);
    if (round % 64 == 63) pass(milliseconds(500));
  }
  if (!drained_) check_no_client_left();
  service_->stop();
  poll();
  for (int rounds = 0; !loop_.stopped(); ++rounds) {
    check(rounds < 100, "the loop comes to rest");
    pass(longest_step);
    loop_.restart();
    loop_.poll();
  }
  service_.reset();
  check(count_workers() == 0, "no worker is left");
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace metamer::fuzz
