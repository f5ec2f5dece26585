// The power is cut at each sync of a job's life, and the disk has what was synced until then and
// nothing else.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>

#include "../client.h"
#include "../gate.h"
#include "../program.h"
#include "../temporary_state.h"

namespace metamer::service::test {
namespace {

namespace fs = std::filesystem;

/// Makes in `to` what forgetful_disk_module.cpp has noted.
void restore_folder(const fs::path& shadow, const std::string& key, const fs::path& to) {
  std::ifstream list(shadow / (key + ".folder"));
  std::string kind, inside, name;
  while (list >> kind >> inside && std::getline(list >> std::ws, name)) {
    if (kind == "folder") {
      fs::create_directory(to / name);
      restore_folder(shadow, inside, to / name);
    } else if (fs::exists(shadow / inside)) {
      fs::copy_file(shadow / inside, to / name);
    } else {
      std::ofstream(to / name).flush();
    }
  }
}

/// What the client was promised.
struct Promised {
  std::string asset;
  std::uint64_t job = 0;
  bool finished = false;
  bool cancelled = false;
  bool paused = false;
};

struct PowerCut : testing::Test {
  TemporaryState place;
  std::string socket = (place.path() / "socket").string();
  std::string key = "sixteen bytes...";

  std::unique_ptr<Program> start(const fs::path& state, std::vector<std::string> environment) {
    return std::make_unique<Program>(
        place.path(),
        std::vector<std::string>{"--listen", "unix:" + socket, "--parent-fd", "3", "--state",
                                 state.string()},
        std::move(environment));
  }

  v1::Envelope submit(const std::string& asset) const {
    v1::Envelope message;
    message.mutable_submit()->set_scene_sha256(asset);
    message.mutable_submit()->set_client_key(key);
    return message;
  }

  using Story = std::function<void(Client&, Promised&)>;

  /// False when the story came to its end before the cut.
  bool cut_at(int sync, const Story& story, Promised& promised) {
    const TemporaryState state, shadow;
    const Gate closed(state.path());
    bool cut = false;
    {
      auto daemon = start(state.path(), {"LD_PRELOAD=" METAMER_BIN "/forgetful-disk.so",
                                         "METAMER_DISK=" + state.path().string(),
                                         "METAMER_DISK_SHADOW=" + shadow.path().string(),
                                         "METAMER_DISK_CUT=" + std::to_string(sync)});
      if (daemon->ready() == "ready\n") {
        try {
          Client client(socket);
          client.hello();
          story(client, promised);
        } catch (const std::runtime_error&) {
        }
      }
      daemon->hang_up();
      cut = daemon->wait() == -SIGKILL;
    }
    const TemporaryState after;
    std::string root;
    std::ifstream(shadow.path() / "root") >> root;
    restore_folder(shadow.path(), root, after.path());
    check(after.path(), promised, "cut at sync " + std::to_string(sync));
    return cut;
  }

  void check(const fs::path& state, const Promised& promised, const std::string& when) {
    SCOPED_TRACE(when);
    const Gate gate(state);
    auto daemon = start(state, {});
    ASSERT_EQ(daemon->ready(), "ready\n") << daemon->log();
    Client client(socket);
    client.hello();
    if (!promised.asset.empty()) {
      v1::Envelope offer;
      offer.mutable_offer_assets()->add_sha256(promised.asset);
      EXPECT_EQ(client.ask(offer).missing_assets().sha256_size(), 0) << "an asset is lost";
    }
    if (promised.job != 0) {
      const v1::JobSummary job = client.summary(promised.job);
      ASSERT_EQ(job.job_id(), promised.job) << "the job is lost";
      EXPECT_TRUE(!promised.finished || job.state() == v1::FINISHED) << job.ShortDebugString();
      EXPECT_TRUE(!promised.cancelled || job.state() == v1::CANCELLED) << job.ShortDebugString();
      EXPECT_TRUE(!promised.paused || job.state() == v1::PAUSED) << job.ShortDebugString();
      EXPECT_EQ(client.ask(submit(promised.asset)).submitted().job_id(), promised.job)
          << "the same request is another job";
      if (job.state() == v1::PAUSED) {
        v1::Envelope resume;
        resume.mutable_resume()->set_job_id(promised.job);
        client.ask(resume);
      }
      for (int i = 0; i < 8; ++i) gate.open();
      if (job.state() != v1::CANCELLED) expect_whole(client, promised.job);
    }
    const std::uint64_t next = client.submit("picture 8 8 8");
    EXPECT_GT(next, promised.job);
  }

  static void expect_whole(Client& client, std::uint64_t job) {
    client.watch(job);
    int tiles = 0;
    client.receive_event_until([&](const v1::JobEvent& event) {
      if (event.has_retrying() && event.retrying().from_start()) tiles = 0;
      tiles += event.has_tile();
      return event.has_finished();
    });
    EXPECT_EQ(tiles, 12);
  }

  void expect_promises_kept(const Story& story) {
    int cuts = 0;
    Promised promised;
    while (cut_at(++cuts, story, promised) && !HasFailure()) promised = {};
    // The last run had no cut: all was promised.
    EXPECT_NE(promised.job, 0u);
    EXPECT_GT(cuts, 8);
    std::cout << cuts - 1 << " power cuts\n";
  }

  void submit_one(Client& client, Promised& promised, const std::string& script) const {
    const std::string asset = client.upload({script})[0];
    promised.asset = asset;
    promised.job = client.ask(submit(asset)).submitted().job_id();
  }
};

TEST_F(PowerCut, AtAnySyncLosesNoFinishedJob) {
  expect_promises_kept([&](Client& client, Promised& promised) {
    submit_one(client, promised, "picture 64 48 16");
    client.watch(promised.job);
    client.receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
    promised.finished = true;
  });
}

TEST_F(PowerCut, AtAnySyncUndoesNoCancel) {
  expect_promises_kept([&](Client& client, Promised& promised) {
    submit_one(client, promised, "picture 64 48 16 gate 3");
    client.watch(promised.job);
    client.receive_event_until([](const v1::JobEvent& event) { return event.has_tile(); });
    v1::Envelope cancel;
    cancel.mutable_cancel()->set_job_id(promised.job);
    promised.cancelled = client.ask(cancel).job_summary().state() == v1::CANCELLED;
  });
}

TEST_F(PowerCut, AtAnySyncUndoesNoPause) {
  expect_promises_kept([&](Client& client, Promised& promised) {
    submit_one(client, promised, "picture 64 48 16 gate 3");
    client.watch(promised.job);
    client.receive_event_until([](const v1::JobEvent& event) { return event.has_tile(); });
    v1::Envelope pause;
    pause.mutable_pause()->set_job_id(promised.job);
    promised.paused = client.ask(pause).job_summary().state() == v1::PAUSED;
  });
}

}  // namespace
}  // namespace metamer::service::test
