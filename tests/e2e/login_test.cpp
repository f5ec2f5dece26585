// As three people do: an administrator adds users, who log in by TLS and see their own jobs.

#include <gtest/gtest.h>

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include "../common/wire/certificates.h"
#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

/// A metamerd with users, that listens by TLS; and what one user has configured.
class LoginE2e : public testing::Test {
 protected:
  Folder folder_;
  wire::test::Certificates certificates_;
  wire::TlsIdentity server_ = certificates_.sign("server", "DNS:localhost,IP:127.0.0.1");
  std::string state_ = folder_ / "state";

  std::vector<std::string> tls_options() {
    return {"--listen",          "tls:127.0.0.1:0", "--state",   state_,        "--tls-cert",
            server_.certificate, "--tls-key",       server_.key, "--log-level", "info"};
  }
  Ended user(std::vector<std::string> words) {
    words.insert(words.begin(), {"metamerd", "user"});
    words.insert(words.end(), {"--state", state_});
    return run(words);
  }
  /// `metamer WORDS` by a person with a configuration of his own.
  Ended as(const std::string& person, const std::vector<std::string>& words) {
    ProcessOptions how;
    how.environment["XDG_CONFIG_HOME"] = folder_ / person;
    return metamer(words, how);
  }
  /// A user's new token, in a file.
  std::string token_file(const std::string& name, const std::string& role) {
    const Ended ended = user({"add", name, "--role", role, "--token", "desk"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out.substr(0, 4), "mtr_");
    return secret(name + ".token", ended.out);
  }
  std::string secret(const std::string& name, const std::string& text) const {
    const std::string path = folder_.write(name, text);
    std::filesystem::permissions(path, std::filesystem::perms::owner_read);
    return path;
  }
};

/// A metamerd that says on stderr where it listens.
struct Listening {
  explicit Listening(std::vector<std::string> words) : process(std::move(words)) {
    const auto line = process.line_err("listening on tls:");
    if (line) server = line->substr(line->find("tls:"));
  }
  Process process;
  std::string server;
};

TEST_F(LoginE2e, UsersLogInByTlsAndSeeTheirOwnJobs) {
  auto words = tls_options();
  words.insert(words.begin(), {"metamerd", "--threads", "1", "--unconfined"});
  Listening daemon(words);
  ASSERT_NE(daemon.server, "");
  const std::string ann = token_file("ann", "submitter"), bob = token_file("bob", "submitter");
  const std::string scene = folder_.write("scene.txtpb", small_scene());

  // Nothing is trusted unasked, nothing is said to who is not trusted.
  const Ended unknown = as("ann", {"login", daemon.server, "--token-file", ann});
  EXPECT_EQ(unknown.code, 3) << unknown.err;
  const std::string sum = certificates_.fingerprint("server");
  EXPECT_NE(unknown.err.find(sum), std::string::npos) << unknown.err;
  const Ended logged_in =
      as("ann", {"login", daemon.server, "--token-file", ann, "--fingerprint", sum});
  EXPECT_EQ(logged_in.code, 0) << logged_in.err;
  EXPECT_EQ(logged_in.out.find("logged in to " + daemon.server + " as ann"), 0u) << logged_in.out;
  struct stat status {};
  ASSERT_EQ(::stat((folder_ / "ann/metamer/servers.toml").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777u, 0600u);
  EXPECT_EQ(
      as("bob", {"login", daemon.server, "--token-file", bob, "--ca", certificates_.authority()})
          .code,
      0);

  const Ended submitted = as("ann", {"submit", scene, "--server", daemon.server});
  ASSERT_EQ(submitted.code, 0) << submitted.err;
  const std::string job = submitted.out.substr(0, submitted.out.find('\n'));
  const std::vector<std::string> fetch = {"fetch",           job,        "-o",
                                          folder_ / "a.png", "--server", daemon.server};
  EXPECT_EQ(as("ann", fetch).code, 0);
  EXPECT_NE(as("bob", fetch).err.find("there is no job " + job.substr(0, job.find('@'))),
            std::string::npos);
  EXPECT_EQ(as("bob", {"jobs", "--server", daemon.server}).out.find(job), std::string::npos);
  EXPECT_NE(as("ann", {"jobs", "--server", daemon.server}).out.find(job), std::string::npos);

  // Without a token; revoked; the server's certificate is another one.
  EXPECT_NE(as("nobody", {"login", daemon.server, "--token-file", secret("x", "mtr_x\n"),
                          "--fingerprint", sum})
                .err.find("this token is not valid here"),
            std::string::npos);
  EXPECT_EQ(user({"revoke", "bob"}).code, 0);
  EXPECT_NE(as("bob", {"jobs", "--server", daemon.server}).code, 0);
  const Ended list = user({"list"});
  EXPECT_NE(list.out.find("ann: submitter"), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("bob: submitter, share 1, revoked"), std::string::npos) << list.out;
  EXPECT_EQ(list.out.find("mtr_"), std::string::npos);
  daemon.process.signal(SIGTERM);
  const Ended ended = daemon.process.wait();
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err.find("mtr_"), std::string::npos) << "a token is in the log";
}

TEST_F(LoginE2e, ATokenThatOthersMayReadIsNotTaken) {
  const std::string token = folder_.write("token", "mtr_x\n");
  for (const unsigned mode : {0640u, 0604u, 0620u}) {
    ASSERT_EQ(::chmod(token.c_str(), mode), 0);
    const Ended ended = as("ann", {"login", "tls:127.0.0.1:1", "--token-file", token});
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find("others may read " + token), std::string::npos) << ended.err;
  }
  ASSERT_EQ(::chmod(token.c_str(), 0600), 0);
  EXPECT_EQ(as("ann", {"login", "tls:127.0.0.1:1", "--token-file", token}).code, 3);
}

TEST_F(LoginE2e, OneWhoHasToMakeRoomAtTheDoorIsLoggedWithThatReason) {
  auto words = tls_options();
  words.insert(words.begin(),
               {"metamerd", "--unconfined", "--handshakes", "1", "--handshake-timeout", "0.1"});
  Listening daemon(words);
  ASSERT_NE(daemon.server, "");
  const auto begin_handshake = [&] {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(
        static_cast<std::uint16_t>(std::stoi(daemon.server.substr(daemon.server.rfind(':') + 1))));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::send(fd, "\x16\x03\x01", 3, MSG_NOSIGNAL), 3);
    return fd;
  };
  const int first = begin_handshake(), second = begin_handshake();
  const auto line = daemon.process.line_err("a login failed");
  ASSERT_TRUE(line);
  EXPECT_NE(line->find("peer=127.0.0.1 reason=\"its handshake took long, and others waited\""),
            std::string::npos)
      << *line;
  ::close(first);
  ::close(second);
}

TEST_F(LoginE2e, PlainWordsToTlsAndTheReverseAreSaidForWhatTheyAre) {
  auto words = tls_options();
  words.insert(words.begin(), {"metamerd", "--unconfined", "--listen", "127.0.0.1:0", "--open"});
  Process process(words);
  const auto plain_line = process.line_err("listening on 127");
  const auto tls_line = process.line_err("listening on tls:");
  ASSERT_TRUE(plain_line && tls_line);
  const std::string plain = plain_line->substr(plain_line->find("127"));
  const std::string tls = tls_line->substr(tls_line->find("tls:"));

  const Ended to_tls = as("ann", {"jobs", "--server", tls.substr(4)});
  EXPECT_EQ(to_tls.code, 3);
  EXPECT_NE(to_tls.err.find("it speaks TLS there: try " + tls), std::string::npos) << to_tls.err;
  EXPECT_TRUE(process.line_err("the client speaks no TLS"));
  const Ended to_plain = as("ann", {"jobs", "--server", "tls:" + plain});
  EXPECT_EQ(to_plain.code, 3);
  EXPECT_NE(to_plain.err.find("the server speaks no TLS; try it without tls:"), std::string::npos)
      << to_plain.err;
  EXPECT_TRUE(process.line_err("these bytes are TLS, not a frame"));
}

TEST_F(LoginE2e, OtherMachinesAreReachedByTlsAloneUnlessToldOtherwise) {
  const Ended refused = run({"metamerd", "--listen", "0.0.0.0:0"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("Listen on tls:0.0.0.0:0, or say --insecure"), std::string::npos)
      << refused.err;
  const Ended no_certificate = run({"metamerd", "--listen", "tls:0.0.0.0:0"});
  EXPECT_EQ(no_certificate.code, 2);
  EXPECT_NE(no_certificate.err.find("TLS needs --tls-cert and --tls-key"), std::string::npos);
  Process insecure({"metamerd", "--listen", "0.0.0.0:0", "--insecure", "--unconfined"});
  EXPECT_TRUE(insecure.line_err("listening on 0.0.0.0:"));
}

TEST_F(LoginE2e, WrongWordsForUsersAreSaid) {
  const std::string nowhere = folder_ / "nowhere";
  EXPECT_EQ(run({"metamerd", "user", "list", "--state", nowhere}).code, 1);
  EXPECT_FALSE(std::filesystem::exists(nowhere));
  std::filesystem::create_directory(state_);
  EXPECT_EQ(user({"add", "ann"}).code, 1);
  EXPECT_EQ(user({"add", "ann", "--role", "king"}).code, 2);
  EXPECT_EQ(user({"add", "a b", "--role", "viewer"}).code, 1);
  EXPECT_EQ(user({"add", "ann", "--role", "viewer", "--expires", "3"}).code, 1);
  EXPECT_EQ(user({"revoke", "ann"}).code, 1);
  EXPECT_EQ(user({}).code, 2);
  EXPECT_EQ(user({"add", "ann", "--role", "viewer"}).code, 0);
  EXPECT_EQ(user({"revoke", "ann", "--token", "desk"}).code, 1);
}

}  // namespace
}  // namespace metamer::test
