#include "common/scene/methods.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <set>

namespace metamer::test {
namespace {

using google::protobuf::util::MessageDifferencer;

v1::Method method_named(const std::string& word) {
  v1::Method method;
  method.GetReflection()->MutableMessage(&method, v1::Method::descriptor()->FindFieldByName(word));
  return method;
}

TEST(Methods, TheTableHasEachMemberOfTheSchemaOnce) {
  std::multiset<std::string> members, words;
  const auto& oneof = *v1::Method::descriptor()->FindOneofByName("method");
  for (int i = 0; i < oneof.field_count(); ++i) members.insert(oneof.field(i)->name());
  for (const MethodEntry& entry : method_entries()) words.insert(entry.word);
  EXPECT_EQ(words, members);
  EXPECT_EQ(method_words(), "point, linear, exact, prefilter, rgb");
  EXPECT_EQ(method_entry({}), nullptr);
}

TEST(Methods, ByTheirDefaultsEachIsSoundAndSaysItsName) {
  for (const MethodEntry& entry : method_entries()) {
    v1::Method method = method_named(entry.word);
    ASSERT_EQ(method_entry(method), &entry);
    if (entry.fill) entry.fill(method);
    const v1::Method once = method;
    if (entry.fill) entry.fill(method);
    EXPECT_TRUE(MessageDifferencer::Equals(once, method)) << entry.word;
    Findings findings;
    if (entry.check) entry.check(method, "here", findings);
    EXPECT_EQ(findings.size(), 0u) << entry.word;
    EXPECT_TRUE(method_text(method).starts_with(entry.word)) << method_text(method);
  }
  EXPECT_EQ(method_text({}), "");
}

TEST(Methods, CandidatesAreSoundDistinctAndBeginWithTheExactOne) {
  std::set<std::string> texts;
  for (v1::Method& method : candidates()) {
    const MethodEntry* entry = method_entry(method);
    ASSERT_NE(entry, nullptr);
    const v1::Method written = method;
    if (entry->fill) entry->fill(method);
    EXPECT_TRUE(MessageDifferencer::Equals(written, method)) << method_text(method);
    Findings findings;
    if (entry->check) entry->check(method, "here", findings);
    EXPECT_EQ(findings.size(), 0u);
    EXPECT_TRUE(texts.insert(method_text(method)).second) << method_text(method);
  }
  EXPECT_TRUE(candidates().front().has_exact());
  EXPECT_EQ(texts.size(), 15u);
}

TEST(Methods, TextsTellTheParameters) {
  v1::Method point = method_named("point");
  point.mutable_point()->set_fitted(8);
  EXPECT_EQ(method_text(point), "point fitted 8");
  point.mutable_point()->clear_fitted();
  point.mutable_point()->add_wavelengths(546);
  EXPECT_EQ(method_text(point), "point at 1 listed");

  v1::Method linear = method_named("linear");
  linear.mutable_linear()->set_bases(4);
  linear.mutable_linear()->set_weighting(v1::Linear::OBSERVER);
  linear.mutable_linear()->set_bounce(true);
  EXPECT_EQ(method_text(linear), "linear 4 observer bounce");
  v1::Plan plan;
  *plan.mutable_method() = linear;
  plan.set_bands(1);
  plan.set_residual(0.012);
  EXPECT_EQ(planned_method_text(plan), "linear with 1 basis function (residual 1.2e-02)");
}

}  // namespace
}  // namespace metamer::test
