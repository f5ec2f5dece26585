// What a user learns of the store: what it has itself sent, and nothing of others.

#include "server/service/access/known_assets.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "../client.h"
#include "../daemon.h"
#include "../temporary_state.h"
#include "server/service/access/users.h"

namespace metamer::service {

TEST(KnownAssets, TheUserThatHasMostLosesItsOldest) {
  KnownAssets known(4);
  const auto digest = [](int i) { return sha256(std::to_string(i)); };
  known.add("ann", digest(1));
  for (int i = 1; i <= 3; ++i) known.add("bob", digest(i));
  known.add("bob", digest(3));
  EXPECT_TRUE(known.knows("bob", digest(1))) << "the same again is no more";
  known.add("ann", digest(2));
  EXPECT_FALSE(known.knows("bob", digest(1)));
  EXPECT_TRUE(known.knows("ann", digest(1)) && known.knows("ann", digest(2)));
  known.forget("ann", digest(1));
  EXPECT_FALSE(known.knows("ann", digest(1)));
  known.add("cy", digest(1));
  EXPECT_TRUE(known.knows("bob", digest(2))) << "there is room again";
}

namespace test {

namespace {

const std::string scene = "picture 8 8 8";

std::string digest_bytes(const std::string& asset) { return std::string(to_bytes(sha256(asset))); }

/// Two submitters and an admin, in a state.
class AssetsOfUsers : public testing::Test {
 protected:
  TemporaryState state_;
  std::unique_ptr<Daemon> daemon_;
  std::map<std::string, std::string> tokens_;

  void start() {
    daemon_.reset();
    daemon_ = std::make_unique<Daemon>([&](ServiceOptions& options) {
      options.state = state_.path();
      options.store.clear();
      options.open = false;
    });
  }
  void SetUp() override {
    start();
    Database database(state_.database());
    Users users(database);
    for (const auto& [name, role] : {std::pair("ann", v1::SUBMITTER),
                                     std::pair("bob", v1::SUBMITTER), std::pair("cy", v1::ADMIN)}) {
      UserChange change;
      change.name = name;
      change.role = role;
      ASSERT_TRUE(users.add(change, 0));
      tokens_[name] = users.add_token(name, "desk", std::nullopt, 0);
    }
  }
  std::unique_ptr<Client> enter(const std::string& user) {
    auto client = std::make_unique<Client>(daemon_->port());
    EXPECT_EQ(client->hello(tokens_.at(user)).user(), user);
    return client;
  }
  static bool is_missing(Client& client, const std::string& asset) {
    v1::Envelope offer;
    offer.mutable_offer_assets()->add_sha256(digest_bytes(asset));
    const v1::Envelope answer = client.ask(offer);
    EXPECT_TRUE(answer.has_missing_assets()) << answer.ShortDebugString();
    return answer.missing_assets().sha256_size() == 1;
  }
  static v1::Envelope send(Client& client, const std::string& asset, const std::string& bytes) {
    v1::Envelope message;
    message.mutable_asset_chunk()->set_sha256(digest_bytes(asset));
    message.mutable_asset_chunk()->set_size(bytes.size());
    message.mutable_asset_chunk()->set_data(bytes);
    return client.ask(message);
  }
  std::size_t files() const {
    std::size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(state_.path() / "assets"))
      count += file.is_regular_file();
    return count;
  }
};

/// What a request is told that names an asset, with the digest taken out.
std::string told(Client& client, v1::Envelope request, const std::string& asset) {
  const std::string hex = to_hex(sha256(asset));
  const v1::Envelope answer = client.ask(std::move(request));
  std::string text = v1::Error::Code_Name(answer.error().code()) + ": " + answer.error().message();
  if (const auto at = text.find(hex); at != std::string::npos) text.replace(at, hex.size(), "it");
  return text;
}

}  // namespace

TEST_F(AssetsOfUsers, OnesAreMissingForAnotherUntilItHasSentThem) {
  const auto ann = enter("ann");
  ann->upload({scene});
  EXPECT_FALSE(is_missing(*ann, scene));
  EXPECT_FALSE(is_missing(*enter("ann"), scene)) << "in another session, too";
  EXPECT_FALSE(is_missing(*enter("cy"), scene)) << "an admin sees all";

  const auto bob = enter("bob");
  EXPECT_TRUE(is_missing(*bob, scene));
  EXPECT_EQ(send(*bob, scene, "picture 9 9 9").error().code(), v1::Error::DIGEST);
  EXPECT_TRUE(is_missing(*bob, scene)) << "who does not have the bytes does not get it";
  EXPECT_TRUE(send(*bob, scene, scene).has_asset_stored());
  EXPECT_FALSE(is_missing(*bob, scene));
  EXPECT_EQ(files(), 1u) << "there is no second copy";
  bob->submit(scene);
}

TEST_F(AssetsOfUsers, NamingAnothersIsToldInTheWordsOfOneThatIsNowhere) {
  const std::string own = "picture 16 16 8", nowhere = "nobody has sent this";
  const auto ann = enter("ann");
  ann->upload({scene});
  const auto bob = enter("bob");
  bob->upload({own});
  for (const bool as_scene : {true, false}) {
    std::vector<std::string> words;
    for (const std::string& asset : {scene, nowhere}) {
      v1::Envelope submit, open;
      submit.mutable_submit()->set_scene_sha256(digest_bytes(as_scene ? asset : own));
      open.mutable_open_view()->set_scene_sha256(digest_bytes(as_scene ? asset : own));
      for (auto* names :
           {submit.mutable_submit()->mutable_asset(), open.mutable_open_view()->mutable_asset()})
        if (!as_scene) {
          names->Add()->set_name("a.ply");
          names->rbegin()->set_sha256(digest_bytes(asset));
        }
      words.push_back(told(*bob, submit, asset) + "; " + told(*bob, open, asset));
    }
    EXPECT_EQ(words[0], words[1]);
    EXPECT_EQ(words[0].find("MISSING_ASSET: the store lacks"), 0u) << words[0];
  }
  // Nor does the number of bytes tell.
  EXPECT_EQ(bob->info().store_bytes(), own.size());
}

TEST_F(AssetsOfUsers, AViewsUpdateCantNameAnothers) {
  const auto ann = enter("ann");
  ann->upload({scene});
  const auto bob = enter("bob");
  v1::Envelope open;
  open.set_request_id(1000);
  open.mutable_open_view()->set_scene_sha256(bob->upload({"picture 16 16 8"})[0]);
  bob->send(open);
  for (const bool whole : {true, false}) {
    v1::Envelope update;
    update.mutable_update_view()->set_view_id(1);
    if (whole) update.mutable_update_view()->set_scene_sha256(digest_bytes(scene));
    v1::AssetName& name = *update.mutable_update_view()->add_asset();
    name.set_name("a.ply");
    name.set_sha256(digest_bytes(scene));
    EXPECT_EQ(told(*bob, update, scene).find("MISSING_ASSET: the store lacks"), 0u);
  }
}

TEST_F(AssetsOfUsers, OfAJobTheyAreKnownAfterARestart) {
  const std::string unused = "no job names this";
  {
    const auto ann = enter("ann");
    ann->submit(scene);
    ann->upload({unused});
  }
  start();
  const auto ann = enter("ann");
  EXPECT_FALSE(is_missing(*ann, scene));
  EXPECT_TRUE(is_missing(*ann, unused));
  EXPECT_TRUE(is_missing(*enter("bob"), scene));
}

TEST(AssetsOfTheOwner, AreKnownWhoeverSentThem) {
  Daemon daemon;
  Client guest(daemon.port());
  guest.hello();
  guest.upload({scene});
  Client owner(daemon.socket());
  owner.hello();
  v1::Envelope offer;
  offer.mutable_offer_assets()->add_sha256(digest_bytes(scene));
  EXPECT_EQ(owner.ask(offer).missing_assets().sha256_size(), 0);
}

}  // namespace test

}  // namespace metamer::service
