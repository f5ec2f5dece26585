// Whole sessions of several clients at once against a daemon in this process: any requests in any
// order, read or not, whole, by halves or no requests at all, while its workers work, lie and end
// and time passes. The input is a list of steps, a letter each with what it needs; README.md says
// which. Beyond not crashing: each request has its one answer, a stranger's job is not there, what
// clients make the daemon keep is bounded, and when they have gone nothing of theirs is left.

#include <spdlog/spdlog.h>

#include <cstdio>
#include <cstdlib>

#include "session/messages.h"
#include "session/scripted_worker.h"
#include "session/world.h"

namespace {

using namespace metamer;
using namespace metamer::fuzz;
using std::chrono::milliseconds;

constexpr int most_steps = 300;
constexpr std::size_t most_requests = 20'000;

Facts facts;

class Run {
 public:
  explicit Run(Bytes& bytes)
      : bytes_(bytes),
        world_({.keeps_state = bytes.next() == 's', .small_limits = bytes.next() == 'm'}, facts),
        first_request_(facts.requests) {}

  void step() {
    switch (bytes_.next()) {
      case 'o':
        return void(world_.open(bytes_.pick(4)));
      case 'h':
        return say_hello();
      case 'a':
        return ask_anything();
      case 'u':
        return upload();
      case 's':
        return submit();
      case 'w':
        return watch();
      case 'j':
        return order_job();
      case 'v':
        return use_view();
      case 'r':
        return read();
      case 'e':
        return end_client();
      case 't':
        return pass_time();
      case 'x':
        return let_workers_work(static_cast<unsigned>(bytes_.pick(200)));
      case 'y':
        return trouble_workers();
      case 'g':
        return send_nonsense();
      case 'l':
        return change_limits();
      case 'd':
        return world_.drain();
      default:
        return;  // Blanks, for people.
    }
  }

  void steps() {
    for (int i = 0; i < most_steps && !bytes_.empty(); ++i) {
      if (facts.requests - first_request_ > most_requests) break;
      step();
      world_.settle();
      let_workers_work(1);
      if (i % 16 == 15) world_.check_memory();
    }
  }

 private:
  Peer* peer() {
    auto& peers = world_.peers();
    return peers.empty() ? world_.open(0) : peers[bytes_.pick(peers.size())].get();
  }
  std::uint64_t job() {
    const std::uint64_t number = bytes_.number();
    return facts.owners.empty() || number > 200 ? number : number % (facts.owners.size() + 2);
  }
  /// Once, or many times in a row, which nobody reads meanwhile.
  void ask(Peer* peer, const v1::Envelope& request) {
    if (!peer) return;
    const std::size_t times = bytes_.pick(64);
    for (std::size_t i = 0; i < (times < 60 ? 1 : std::size_t{64} << 2 * (times - 60)); ++i) {
      if (i > 2000) break;
      peer->ask(request);
    }
  }

  void say_hello() {
    Peer* const one = peer();
    v1::Envelope request;
    constexpr std::uint32_t versions[] = {1, 1, 1, 1, 0, 2, 1u << 31};
    request.mutable_hello()->set_protocol_version(versions[bytes_.pick(std::size(versions))]);
    request.mutable_hello()->set_client("fuzz");
    const std::size_t token = bytes_.pick(10);
    if (token > 0 && token <= facts.tokens.size())
      request.mutable_hello()->set_token(facts.tokens[token - 1]);
    if (token == 8) request.mutable_hello()->set_token("mtr_wrong");
    if (token == 9) request.mutable_hello()->set_token(std::string(5000, 'x'));
    if (one) one->ask(request);
  }

  void ask_anything() {
    Peer* const one = peer();
    const auto request = any_envelope<v1::Envelope>(bytes_, facts);
    const std::size_t how = bytes_.pick(8);
    if (one && how == 6) return one->ask(request, true);
    if (one && how == 7) return one->ask_half(request, bytes_.number());
    ask(one, request);
  }

  void upload(Peer& one, std::size_t asset, bool offer) {
    const std::string& text = all_assets()[asset];
    v1::Envelope request;
    request.mutable_offer_assets()->add_sha256(digest_of(asset));
    if (offer) one.ask(request);
    v1::AssetChunk& chunk = *request.mutable_asset_chunk();
    chunk.set_sha256(digest_of(asset));
    chunk.set_size(text.size());
    chunk.set_data(text);
    one.ask(request);
  }

  void upload() {
    Peer* const one = peer();
    const std::size_t asset = bytes_.pick(all_assets().size());
    const std::size_t how = bytes_.pick(8);
    if (!one) return;
    if (how < 4) return upload(*one, asset, how < 3);
    // By pieces, of which some lack, come twice, or are another's.
    v1::Envelope request;
    v1::AssetChunk& chunk = *request.mutable_asset_chunk();
    chunk.set_sha256(digest_of(how == 4 ? asset + 1 : asset));
    chunk.set_size(all_assets()[asset].size() + (how == 5 ? bytes_.number() : 0));
    chunk.set_offset(bytes_.number() * (how == 6 ? 256u : 1u));
    chunk.set_data(all_assets()[asset].substr(0, bytes_.number() * (how == 7 ? 256u : 1u)));
    one->ask(request);
  }

  void submit() {
    Peer* const one = peer();
    const std::size_t asset = bytes_.pick(all_assets().size());
    const std::uint8_t flags = bytes_.number();
    if (!one) return;
    if ((flags & 1) == 0) upload(*one, asset, true);
    v1::Envelope request;
    v1::Submit& submit = *request.mutable_submit();
    submit.set_scene_sha256(digest_of(asset));
    submit.set_check_only((flags & 2) != 0);
    submit.set_prepare((flags & 4) != 0);
    submit.set_keep_factors((flags & 8) != 0);
    if ((flags & 16) != 0) submit.set_backend(v1::GL);
    if ((flags & 32) != 0) submit.set_client_key("key " + std::to_string(flags >> 6));
    ask(one, request);
  }

  void watch() {
    Peer* const one = peer();
    v1::Envelope request;
    v1::Watch& watch = *request.mutable_watch();
    watch.set_job_id(job());
    const std::uint8_t flags = bytes_.number();
    watch.set_tiles((flags & 1) != 0);
    watch.set_previews((flags & 2) != 0);
    watch.set_factors((flags & 4) != 0);
    if ((flags & 8) != 0) watch.set_from_sequence(bytes_.number());
    ask(one, request);
  }

  void order_job() {
    Peer* const one = peer();
    v1::Envelope request;
    switch (bytes_.pick(5)) {
      case 0:
        request.mutable_cancel()->set_job_id(job());
        break;
      case 1:
        request.mutable_pause()->set_job_id(job());
        break;
      case 2:
        request.mutable_resume()->set_job_id(job());
        break;
      case 3:
        request.mutable_prioritize()->set_job_id(job());
        request.mutable_prioritize()->set_priority(static_cast<std::int8_t>(bytes_.number()));
        break;
      default:
        request.mutable_list_jobs()->set_mine(bytes_.flag());
    }
    ask(one, request);
  }

  void use_view() {
    Peer* const one = peer();
    const std::size_t what = bytes_.pick(6);
    v1::Envelope request;
    const std::uint64_t view =
        facts.views.empty() ? 1 : facts.views[bytes_.pick(facts.views.size())];
    if (what == 0) {
      const std::size_t asset = bytes_.pick(all_assets().size());
      if (one) upload(*one, asset, true);
      request.mutable_open_view()->set_scene_sha256(digest_of(asset));
      if (bytes_.flag()) request.mutable_open_view()->set_backend(v1::GL);
    } else if (what == 1 || what == 2) {
      request.mutable_update_view()->set_view_id(view);
      request.mutable_update_view()->set_revision(bytes_.number());
      if (what == 2) request.mutable_update_view()->set_scene_sha256(digest_of(bytes_.number()));
    } else if (what == 3) {
      request.mutable_next_frame()->set_view_id(view);
      request.mutable_next_frame()->set_xyz(bytes_.flag());
    } else if (what == 4) {
      request.mutable_probe()->set_view_id(view);
      request.mutable_probe()->set_x(bytes_.number());
      request.mutable_probe()->set_side(bytes_.number());
    } else {
      request.mutable_close_view()->set_view_id(view);
    }
    ask(one, request);
  }

  void read() {
    Peer* const one = peer();
    constexpr std::size_t appetites[] = {Peer::everything, 0, 1, 7, 100, 4096};
    const std::size_t appetite = appetites[bytes_.pick(std::size(appetites))];
    if (one) one->appetite = appetite;
  }

  void end_client() {
    Peer* const one = peer();
    const std::size_t how = bytes_.pick(3);
    if (!one) return;
    if (how == 0) std::erase_if(world_.peers(), [&](const auto& it) { return it.get() == one; });
    if (how == 1) one->finish_sending();
    if (how == 2) one->finish_half();
  }

  void pass_time() {
    constexpr int times[] = {10, 250, 1000, 5000, 11'000, 31'000, 61'000, 121'000};
    world_.pass(milliseconds(times[bytes_.pick(std::size(times))]));
  }

  void trouble_workers() {
    switch (bytes_.pick(8)) {
      case 0:
        return end_workers();
      case 1:
        return set_start(Start::lacks_memory);
      case 2:
        return set_start(Start::fails);
      case 3:
        return set_start(Start::never_ready);
      case 4:
        return set_start(Start::works);
      default: {
        auto said = any_envelope<v1::WorkerEnvelope>(bytes_, facts);
        // Pictures of this size are made, and cost as much time as they are large.
        if (said.has_planned() && said.planned().plan().width() > 512)
          said.mutable_planned()->mutable_plan()->set_width(512);
        if (said.has_planned() && said.planned().plan().height() > 512)
          said.mutable_planned()->mutable_plan()->set_height(512);
        return let_workers_say(said);
      }
    }
  }

  void send_nonsense() {
    Peer* const one = peer();
    const bool framed = bytes_.flag();
    const std::string text = bytes_.take(bytes_.number());
    if (!one) return;
    framed ? one->send_frame(text) : one->send_garbage(text);
  }

  void change_limits() {
    service::Limits limits;
    limits.sessions = 1 + bytes_.pick(20);
    limits.session_watches = bytes_.pick(20);
    limits.views = bytes_.pick(20);
    limits.live_jobs = bytes_.pick(20);
    limits.ended_jobs = bytes_.pick(20);
    world_.service().change_limits(limits, {});
  }

  Bytes& bytes_;
  World world_;
  std::uint64_t first_request_;
};

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  spdlog::set_level(spdlog::level::off);
  facts.owners.clear();
  std::atexit([] {
    std::fprintf(stderr, "%llu requests, %llu messages in answer\n",
                 static_cast<unsigned long long>(facts.requests),
                 static_cast<unsigned long long>(facts.answers));
  });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes({reinterpret_cast<const char*>(data), size});
  Run run(bytes);
  run.steps();
  return 0;
}
