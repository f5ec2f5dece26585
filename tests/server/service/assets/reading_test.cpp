// Large files are read anew beside the loop.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../daemon.h"

namespace metamer::service::test {

namespace {

namespace fs = std::filesystem;

/// So many zeros take no room on the disk, and a processor a tenth of a second or more.
constexpr std::uintmax_t size = 256u << 20;
constexpr const char* zeros = "a6d72ac7690f53be6ae46ba88506bd97302a093f7108472bd9efc3cefda06484";

std::string bytes_of(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

}  // namespace

TEST(Reading, OfALargeAssetLeavesTheLoopToOtherSessions) {
  fs::path file;
  Daemon daemon([&](ServiceOptions& options) {
    fs::create_directories(options.store);
    file = options.store / zeros;
    std::ofstream(file).close();
    fs::resize_file(file, size);
  });
  Client client(daemon.socket()), other(daemon.socket());
  client.hello();
  other.hello();
  v1::Envelope ping, offer;
  ping.mutable_ping();
  offer.set_request_id(1000);
  offer.mutable_offer_assets()->add_sha256(bytes_of(zeros));

  // A loaded machine may read before it lets the other session in; a loop that reads always does.
  bool served_meanwhile = false;
  for (int i = 0; i < 5 && !served_meanwhile; ++i) {
    fs::last_write_time(file, fs::file_time_type::clock::now());
    client.send(ping);
    client.send(offer);
    ASSERT_TRUE(client.receive()->has_pong());
    other.ping();
    auto answer = client.receive_if_there();
    served_meanwhile = !answer;
    if (!answer) answer = client.receive();
    ASSERT_TRUE(answer->has_missing_assets()) << answer->ShortDebugString();
    EXPECT_EQ(answer->missing_assets().sha256_size(), 0);
  }
  EXPECT_TRUE(served_meanwhile);
}

}  // namespace metamer::service::test
