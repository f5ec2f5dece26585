// Who may: a table, over all requests that there are.

#include "server/service/access/permit.h"

#include <gtest/gtest.h>

#include <map>

#include "../client.h"
#include "../daemon.h"
#include "../temporary_state.h"

namespace metamer::service::test {

namespace {

/// What a request comes to: done (or refused for another reason than who asks), or the code.
constexpr auto yes = v1::Error::UNSPECIFIED;
constexpr auto no = v1::Error::FORBIDDEN;
constexpr auto none = v1::Error::NOT_FOUND;
constexpr auto what = v1::Error::UNKNOWN_MESSAGE;

struct Row {
  v1::Error::Code own[3];      ///< By a viewer, a submitter, an admin, of what is its own.
  v1::Error::Code foreign[3];  ///< Likewise, of what is another user's.
};

const std::map<std::string, Row> table = {
    // Names nothing.
    {"hello", {{v1::Error::ORDER, v1::Error::ORDER, v1::Error::ORDER}, {}}},
    {"ping", {{yes, yes, yes}, {}}},
    {"get_info", {{yes, yes, yes}, {}}},
    {"offer_assets", {{yes, yes, yes}, {}}},
    {"asset_chunk", {{yes, yes, yes}, {}}},
    {"list_jobs", {{yes, yes, yes}, {}}},
    {"open_view", {{yes, yes, yes}, {}}},
    {"submit", {{no, yes, yes}, {}}},
    // Names a job.
    {"watch", {{yes, yes, yes}, {none, none, yes}}},
    {"cancel", {{yes, yes, yes}, {none, none, yes}}},
    {"pause", {{yes, yes, yes}, {none, none, yes}}},
    {"resume", {{no, yes, yes}, {no, none, yes}}},
    {"prioritize", {{no, yes, yes}, {no, none, yes}}},
    // Names what belongs to a session, whoever asks.
    {"unwatch", {{yes, yes, yes}, {none, none, none}}},
    {"update_view", {{yes, yes, yes}, {none, none, none}}},
    {"next_frame", {{yes, yes, yes}, {none, none, none}}},
    {"probe", {{yes, yes, yes}, {none, none, none}}},
    {"close_view", {{yes, yes, yes}, {none, none, none}}},
    // The server's.
    {"welcome", {{what, what, what}, {}}},
    {"pong", {{what, what, what}, {}}},
    {"info", {{what, what, what}, {}}},
    {"missing_assets", {{what, what, what}, {}}},
    {"asset_stored", {{what, what, what}, {}}},
    {"submitted", {{what, what, what}, {}}},
    {"job_event", {{what, what, what}, {}}},
    {"job_list", {{what, what, what}, {}}},
    {"job_summary", {{what, what, what}, {}}},
    {"error", {{what, what, what}, {}}},
    {"view_event", {{what, what, what}, {}}},
    {"unwatched", {{what, what, what}, {}}},
};

constexpr const char* names[3] = {"vera", "sue", "ann"};
constexpr v1::Role roles[3] = {v1::VIEWER, v1::SUBMITTER, v1::ADMIN};

class Permit : public testing::Test {
 protected:
  TemporaryState state_;
  Daemon daemon_{[this](ServiceOptions& options) {
    options.state = state_.path();
    options.limits.views = 256;
  }};
  Database database_{state_.database()};
  Users users_{database_};
  std::string tokens_[3], stranger_token_;
  std::uint64_t views_ = 0;  // opened so far: their numbers are 1, 2, …
  std::uint64_t last_request_ = 1000;

  std::string add(const std::string& name, v1::Role role) {
    UserChange change;
    change.name = name;
    change.role = role;
    EXPECT_TRUE(users_.add(change, 0));
    return users_.add_token(name, "desk", std::nullopt, 0);
  }

  /// Sends, and gives the Error that answers it, or `yes`.
  v1::Error::Code outcome(Client& client, v1::Envelope message) {
    message.set_request_id(++last_request_);
    client.send(message);
    v1::Envelope after;
    after.mutable_ping();
    const std::uint64_t asked = last_request_;
    after.set_request_id(++last_request_);
    client.send(after);
    v1::Error::Code code = yes;
    while (true) {
      const auto answer = client.receive();
      if (!answer) return v1::Error::FRAME;
      if (answer->request_id() == last_request_) return code;
      if (answer->request_id() == asked && answer->has_error()) code = answer->error().code();
    }
  }

  std::uint64_t open_view(Client& client) {
    v1::Envelope message;
    message.mutable_open_view()->set_scene_sha256(client.upload({"picture 8 8 8"})[0]);
    EXPECT_EQ(outcome(client, message), yes);
    return ++views_;
  }

  /// Names in a request what it is about.
  static void aim(google::protobuf::Message& body, const char* field, std::uint64_t number) {
    if (const auto* at = body.GetDescriptor()->FindFieldByName(field))
      body.GetReflection()->SetUInt64(&body, at, number);
  }
};

}  // namespace

TEST_F(Permit, EveryRequestByEveryRoleOfOnesOwnAndAnothersIsAsTheTableSays) {
  stranger_token_ = add("stan", v1::SUBMITTER);
  std::uint64_t own_job[3];
  for (int user = 0; user < 3; ++user) {
    tokens_[user] = add(names[user], v1::SUBMITTER);
    Client client(daemon_.port());
    client.hello(tokens_[user]);
    own_job[user] = client.submit("picture 8 8 8");
    UserChange change;
    change.name = names[user];
    change.role = roles[user];
    ASSERT_TRUE(users_.add(change, 0));
  }
  Client stranger(daemon_.port());
  stranger.hello(stranger_token_);
  const auto foreign_job = stranger.submit("picture 8 8 8");
  const auto foreign_watch = stranger.watch(stranger.submit("stall 1"));
  const auto foreign_view = open_view(stranger);

  const auto* bodies = v1::Envelope::descriptor()->FindOneofByName("body");
  for (int i = 0; i < bodies->field_count(); ++i) {
    const auto* field = bodies->field(i);
    const auto row = table.find(field->name());
    ASSERT_NE(row, table.end()) << field->name() << " has no row";
    for (int user = 0; user < 3; ++user) {
      for (const bool own : {true, false}) {
        Client client(daemon_.port());
        ASSERT_EQ(client.hello(tokens_[user]).role(), roles[user]);
        v1::Envelope message;
        auto& body = *message.GetReflection()->MutableMessage(&message, field);
        const bool is_view = body.GetDescriptor()->FindFieldByName("view_id") != nullptr;
        aim(body, "job_id", own ? own_job[user] : foreign_job);
        if (is_view && field->name() != "view_event")
          aim(body, "view_id", own ? open_view(client) : foreign_view);
        if (field->name() == "unwatch")
          aim(body, "watch", own ? client.watch(own_job[user]) : foreign_watch + 77);
        if (field->name() == "open_view") {
          message.mutable_open_view()->set_scene_sha256(client.upload({"picture 8 8 8"})[0]);
          ++views_;
        }
        if (field->name() == "submit")
          message.mutable_submit()->set_scene_sha256(client.upload({"picture 8 8 8"})[0]);
        auto code = outcome(client, message);
        if (code != yes && code != no && code != none && code != what && code != v1::Error::ORDER)
          code = yes;  // refused for another reason than who asks
        if (field->name() == "asset_chunk" && code == v1::Error::ORDER) code = yes;
        // An ended job's watch ends by itself, perhaps before it is given up.
        if (field->name() == "unwatch" && own && code == none) code = yes;
        const bool names_nothing = row->second.foreign[0] == yes && row->second.foreign[2] == yes;
        const auto& expected = own || names_nothing ? row->second.own : row->second.foreign;
        EXPECT_EQ(v1::Error::Code_Name(code), v1::Error::Code_Name(expected[user]))
            << names[user] << ", a " << word(roles[user]) << ": " << field->name()
            << (own ? ", own" : ", foreign");
      }
    }
  }
}

TEST_F(Permit, AListHoldsOnesOwnJobsAndAnAdminsAll) {
  std::uint64_t jobs[3];
  for (int user = 0; user < 3; ++user) {
    tokens_[user] = add(names[user], user == 2 ? v1::ADMIN : v1::SUBMITTER);
    Client client(daemon_.port());
    client.hello(tokens_[user]);
    jobs[user] = client.submit("picture 8 8 8");
  }
  for (int user = 0; user < 3; ++user) {
    Client client(daemon_.port());
    const v1::Welcome welcome = client.hello(tokens_[user]);
    EXPECT_EQ(welcome.user(), names[user]);
    for (int other = 0; other < 3; ++other) {
      const v1::JobSummary summary = client.summary(jobs[other]);
      const bool seen = user == 2 || user == other;
      EXPECT_EQ(summary.job_id(), seen ? jobs[other] : 0);
      EXPECT_EQ(summary.user(), seen ? names[other] : "");
    }
  }
}

TEST(PermitTable, HasALeastRoleForEachRequestAndForNothingElse) {
  const auto* bodies = v1::Envelope::descriptor()->FindOneofByName("body");
  for (int i = 0; i < bodies->field_count(); ++i) {
    const auto number = static_cast<v1::Envelope::BodyCase>(bodies->field(i)->number());
    const bool is_request = table.at(bodies->field(i)->name()).own[2] != what;
    EXPECT_EQ(least_role(number) != v1::ROLE_UNSPECIFIED, is_request) << bodies->field(i)->name();
  }
}

}  // namespace metamer::service::test
