#include "common/digest.h"

#include <gtest/gtest.h>

namespace metamer {
namespace {

// FIPS 180-4's examples.
constexpr const char* abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* nothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

TEST(Digest, EqualsThePublishedExamples) {
  EXPECT_EQ(to_hex(sha256("abc")), abc);
  EXPECT_EQ(to_hex(sha256("")), nothing);
  EXPECT_EQ(to_hex(sha256(std::string(1'000'000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, OfPiecesIsThatOfTheWhole) {
  DigestStream stream;
  stream.update("a");
  stream.update("");
  DigestStream moved = std::move(stream);
  moved.update("bc");
  EXPECT_EQ(to_hex(moved.finish()), abc);
}

TEST(Digest, TakesExactly32BytesFromAMessage) {
  const Digest digest = sha256("abc");
  EXPECT_EQ(digest_from_bytes(to_bytes(digest)), digest);
  EXPECT_FALSE(digest_from_bytes(std::string(31, 'x')).has_value());
  EXPECT_FALSE(digest_from_bytes(std::string(33, 'x')).has_value());
  EXPECT_FALSE(digest_from_bytes("").has_value());
}

}  // namespace
}  // namespace metamer
