#include "client/session/credentials.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

namespace metamer::client::test {

namespace {

namespace fs = std::filesystem;

/// A folder of its own for what is configured.
class CredentialsTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "metamer-config-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    if (const char* before = std::getenv("XDG_CONFIG_HOME")) before_ = before;
    ::setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
  }
  void TearDown() override {
    if (before_.empty()) {
      ::unsetenv("XDG_CONFIG_HOME");
    } else {
      ::setenv("XDG_CONFIG_HOME", before_.c_str(), 1);
    }
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path folder_;
  std::string before_;
};

}  // namespace

TEST_F(CredentialsTest, AreKeptForEachServerAndForTheirUserAlone) {
  const Credentials one{"mtr_1", "/etc/ca.pem", "", "", ""};
  const Credentials other{"mtr_\"2\"\n\\", "", std::string(64, 'a'), "/c.pem", "/k.pem"};
  EXPECT_EQ(kept_credentials("tls:a:1").value(), Credentials());
  ASSERT_TRUE(keep_credentials("tls:a:1", one));
  ASSERT_TRUE(keep_credentials("tls:[::1]:2", other));
  EXPECT_EQ(kept_credentials("tls:a:1").value(), one);
  EXPECT_EQ(kept_credentials("tls:[::1]:2").value(), other);
  EXPECT_EQ(kept_credentials("a:1").value(), Credentials());
  struct stat status {};
  ASSERT_EQ(::stat(credentials_file().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777u, 0600u);
  ASSERT_TRUE(keep_credentials("tls:a:1", {}));
  EXPECT_EQ(kept_credentials("tls:a:1").value(), Credentials());
  EXPECT_EQ(kept_credentials("tls:[::1]:2").value(), other);
}

TEST_F(CredentialsTest, AFileThatOthersReadIsRefused) {
  ASSERT_TRUE(keep_credentials("tls:a:1", {"mtr_1", "", "", "", ""}));
  ::chmod(credentials_file().c_str(), 0640);
  EXPECT_EQ(kept_credentials("tls:a:1").error().message,
            credentials_file().string() + ": others may read the tokens in it; chmod 600 it");
}

TEST_F(CredentialsTest, AFileThatIsNoneOfOursIsRefusedByItsLine) {
  fs::create_directories(credentials_file().parent_path());
  std::ofstream(credentials_file()) << "# fine\n[[[\n";
  ::chmod(credentials_file().c_str(), 0600);
  EXPECT_NE(kept_credentials("x").error().message.find("line 2"), std::string::npos)
      << kept_credentials("x").error().message;
  EXPECT_FALSE(keep_credentials("x", {"t", "", "", "", ""})) << "it is left as it is";
}

}  // namespace metamer::client::test
