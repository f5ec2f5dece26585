#include "client/session/job_handle.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

v1::Welcome welcome_of(const std::string& id) {
  v1::Welcome welcome;
  welcome.set_server_id(id);
  return welcome;
}

const v1::Welcome here = welcome_of("\x3f\x9c\x2a\x1b" + std::string(12, '\x07'));

TEST(JobHandle, IsANumberAndMayNameItsServer) {
  const std::string digits = server_digits(here);
  EXPECT_EQ(digits, "3f9c2a1b070707070707070707070707");
  EXPECT_EQ(to_text({7, digits}), "7@3f9c2a1b");
  EXPECT_EQ(to_text({7, {}}), "7");
  EXPECT_EQ(parse_job_handle("7"), (JobHandle{7, {}}));
  EXPECT_EQ(parse_job_handle("7@3f9c2a1b"), (JobHandle{7, "3f9c2a1b"}));
  EXPECT_EQ(parse_job_handle("7@3F9C2A"), (JobHandle{7, "3f9c2a"}));
  EXPECT_EQ(parse_job_handle("18446744073709551615@" + digits), (JobHandle{~0ull, digits}));
}

TEST(JobHandle, OfAnyOtherFormIsAnError) {
  for (const char* text : {"", "0", "-7", "+7", " 7", "7 ", "7.0", "seven", "18446744073709551616",
                           "7@", "@3f9c2a1b", "7@3f9c2", "7@3f9c2g", "7@3f9c2a1b@3f9c2a1b",
                           "7@3f9c2a1b 8", "7@3f9c2a1b0707070707070707070707070"}) {
    const auto job = parse_job_handle(text);
    ASSERT_FALSE(job) << text;
    EXPECT_NE(job.error().message.find("is no job"), std::string::npos);
  }
}

TEST(JobHandle, IsTakenByItsOwnServerAlone) {
  for (const char* text : {"7", "7@3f9c2a", "7@3f9c2a1b", "7@3f9c2a1b070707070707070707070707"})
    EXPECT_TRUE(check_server(*parse_job_handle(text), here)) << text;
  const auto other = check_server(*parse_job_handle("7@3f9c2a1c"), here);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().kind, SessionError::Kind::input);
  EXPECT_EQ(other.error().message,
            "job 7@3f9c2a1c is of another server: this one's end in @3f9c2a1b");
  const auto kept = check_server(*parse_job_handle("7@3f9c2a1b"), welcome_of(""));
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().message,
            "job 7@3f9c2a1b is of another server: this one's jobs have a number alone");
  EXPECT_TRUE(check_server(*parse_job_handle("7"), welcome_of("")));
}

TEST(JobHandle, ServersSayWhateverTheyLikeAsTheirId) {
  EXPECT_EQ(server_digits(welcome_of(std::string(100'000, '\xff'))), std::string(32, 'f'));
  EXPECT_EQ(server_digits(welcome_of("\x01")), "01");
}

}  // namespace
}  // namespace metamer::client
