#include "client/session/hub.h"

#include <utility>

#include "client/session/hub_state.h"

namespace metamer::client {

SessionHub::SessionHub(std::function<void(const LinkStatus&)> on_status)
    : state_(std::make_shared<State>()) {
  state_->on_status = std::move(on_status);
  state_->thread = std::thread([&loop = *state_->loop] { loop.run(); });
}

SessionHub::~SessionHub() {
  asio::post(*state_->loop, [state = state_] {
    state->ended = true;
    state->loop->stop();
  });
  state_->thread.join();
  // What still waits in the loop holds the state and the connection: it goes with the loop.
  state_->connection.reset();
  state_->retry.reset();
  state_->changed.reset();
  state_->work.reset();
  state_->loop.reset();
}

void SessionHub::open(std::string server) {
  asio::post(*state_->loop, [state = state_, server = std::move(server)]() mutable {
    state->leave("another server was chosen");
    state->server = std::move(server);
    state->start();
  });
}

void SessionHub::retry_now() {
  asio::post(*state_->loop, [state = state_] {
    state->retry->cancel();
    if (state->trying || state->generation == 0) return;
    state->restarts.forget();
    state->start();
  });
}

void SessionHub::stop() {
  asio::post(*state_->loop, [state = state_] {
    state->leave("it was left");
    state->say({.kind = LinkStatus::Kind::lost,
                .server = {},
                .error = session_error(SessionError::Kind::no_server, "not connected").value(),
                .retry_in = -1});
  });
}

void SessionHub::info(Done<v1::Info> done) {
  state_->ask<v1::Info>([](Session& session) { return session.info(); }, std::move(done));
}

namespace {

asio::awaitable<Answer<ServerJobs>> list_jobs(Session& session) {
  Answer<v1::JobList> list = co_await session.list();
  if (!list) co_return tl::unexpected<SessionError>(std::move(list.error()));
  co_return ServerJobs{server_digits(session.welcome()), std::move(*list)};
}

asio::awaitable<Answer<v1::JobSummary>> order_of(Session& session, SessionHub::Order order,
                                                 JobHandle job) {
  if (const Answer<void> known = check_server(job, session.welcome()); !known)
    co_return tl::unexpected<SessionError>(known.error());
  switch (order) {
    case SessionHub::Order::cancel:
      co_return co_await session.cancel(job.number);
    case SessionHub::Order::pause:
      co_return co_await session.pause(job.number);
    case SessionHub::Order::resume:
      break;
  }
  co_return co_await session.resume(job.number);
}

asio::awaitable<Answer<JobHandle>> submit_held(Session& session,
                                               std::shared_ptr<const Submission> held) {
  const Answer<std::uint64_t> number = co_await session.submit(*held);
  if (!number) co_return tl::unexpected<SessionError>(number.error());
  co_return JobHandle{*number, server_digits(session.welcome())};
}

}  // namespace

void SessionHub::list(Done<ServerJobs> done) {
  state_->ask<ServerJobs>([](Session& session) { return list_jobs(session); }, std::move(done));
}

void SessionHub::control(Order order, JobHandle job, Done<v1::JobSummary> done) {
  state_->ask<v1::JobSummary>(
      [order, job = std::move(job)](Session& session) { return order_of(session, order, job); },
      std::move(done));
}

void SessionHub::submit(Submission submission, Done<JobHandle> done) {
  const auto held = std::make_shared<const Submission>(std::move(submission));
  state_->ask<JobHandle>([held](Session& session) { return submit_held(session, held); },
                         std::move(done));
}

void SessionHub::record(JobHandle job, JobParts parts, std::stop_token stop,
                        std::function<void(const v1::JobEvent&)> on_event, Done<JobRecord> done) {
  const auto recording = std::make_shared<Recording>(Recording{.parts = parts,
                                                               .stop = std::move(stop),
                                                               .on_event = std::move(on_event),
                                                               .done = std::move(done),
                                                               .record = {}});
  recording->record.job = std::move(job);
  asio::post(*state_->loop, [state = state_, recording] {
    if (!state->connection)
      return recording->done(session_error(SessionError::Kind::disconnected, "there is no server"));
    asio::co_spawn(*state->loop, state->keep_recording(recording), asio::detached);
  });
}

namespace {

/// The handle that another thread has of a view: `post` runs work on the hub's thread, and does
/// nothing when the hub is gone.
class ViewHandle final : public HubView {
 public:
  using Post = std::function<void(std::function<void()>)>;
  ViewHandle(Post post, std::shared_ptr<LiveView> view)
      : post_(std::move(post)), view_(std::move(view)) {}
  ~ViewHandle() override {
    post_([view = view_] { view->close(); });
  }
  void change(v1::UpdateView change, std::vector<Upload> files) override {
    post_([view = view_, change = std::move(change), files = std::move(files)] {
      view->change({.scene = {}, .rest = change, .files = files});
    });
  }
  void replace(Submission scene) override {
    post_([view = view_, scene = std::move(scene)] {
      view->change({.scene = scene, .rest = {}, .files = {}});
    });
  }
  void taken() override {
    post_([view = view_] { view->taken(); });
  }
  void probe(const ViewPlace& place) override {
    post_([view = view_, place] { view->probe(place); });
  }
  void want_xyz(bool wanted) override {
    post_([view = view_, wanted] { view->want_xyz(wanted); });
  }
  void pause(bool paused) override {
    post_([view = view_, paused] { view->pause(paused); });
  }

 private:
  Post post_;
  std::shared_ptr<LiveView> view_;
};

asio::awaitable<void> run_view(std::shared_ptr<Connection> held, std::shared_ptr<LiveView> view) {
  co_await view->run(*held->session);
}

}  // namespace

std::shared_ptr<HubView> SessionHub::view(Submission submission, ViewHooks hooks) {
  const auto live = std::make_shared<LiveView>(state_->loop->get_executor(), std::move(submission),
                                               std::move(hooks));
  const auto post = [weak = std::weak_ptr<State>(state_)](std::function<void()> work) {
    const auto state = weak.lock();
    if (state && state->loop) asio::post(*state->loop, std::move(work));
  };
  post([state = state_.get(), live] {
    if (!state->connection)
      return live->lose(
          session_error(SessionError::Kind::disconnected, "there is no server").value());
    std::erase_if(state->views, [](const auto& view) { return view.expired(); });
    state->views.push_back(live);
    asio::co_spawn(*state->loop, run_view(state->connection, live), asio::detached);
  });
  return std::make_shared<ViewHandle>(post, live);
}

}  // namespace metamer::client
