// A word that is nearly one says which, for people in its sentence and for programs beside it.
#include "client/tools/scene/words.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

template <class T>
void expect_offer(const Result<T>& named, const char* was, const char* meant) {
  ASSERT_FALSE(named) << was;
  EXPECT_EQ(named.error().was, was);
  EXPECT_EQ(named.error().meant, meant);
  EXPECT_TRUE(named.error().message.ends_with("did you mean \"" + std::string(meant) + "\"?"))
      << named.error().message;
}

TEST(Words, ThatAreNearlyOneAreOffered) {
  expect_offer(adaptation_named("bradfrod"), "bradfrod", "bradford");
  expect_offer(rgb_space_named("srbg"), "srbg", "srgb");
  expect_offer(observer_named("cie-1931-2dge"), "cie-1931-2dge", "cie-1931-2deg");
}

TEST(Words, ThatAreFarFromAllAreToldWhatThereIs) {
  const auto named = observer_named("somebody");
  ASSERT_FALSE(named);
  EXPECT_EQ(named.error().meant, "");
  EXPECT_NE(named.error().message.find("; there are cie-1931-2deg"), std::string::npos)
      << named.error().message;
}

}  // namespace
}  // namespace metamer::client
