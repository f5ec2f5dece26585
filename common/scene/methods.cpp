#include "common/scene/methods.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cassert>
#include <cstdio>

#include "common/scene/check_method.h"

namespace metamer {
namespace {

std::string number(double value, const char* format = "%g") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string counted(std::uint64_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

void fill_point(v1::Method& method) {
  v1::Point& point = *method.mutable_point();
  const bool uniform = point.has_from() || point.has_to() || point.has_step();
  if (uniform || !point.wavelengths().empty() || point.has_fitted()) return;
  point.set_from(400);
  point.set_to(700);
  point.set_step(5);
}

std::string point_text(const v1::Method& method) {
  const v1::Point& point = method.point();
  if (point.fitted() > 0) return "point fitted " + std::to_string(point.fitted());
  if (!point.wavelengths().empty())
    return "point at " + std::to_string(point.wavelengths_size()) + " listed";
  return "point " + number(point.from()) + ":" + number(point.to()) + ":" + number(point.step());
}

std::string planned_point(const v1::Plan& plan) {
  const bool fitted = plan.method().point().has_fitted();
  return "point at " + counted(plan.bands(), fitted ? "fitted wavelength" : "wavelength") +
         " from " + number(plan.from()) + " to " + number(plan.to()) + " nm";
}

void fill_linear(v1::Method& method) {
  if (!method.linear().has_bases()) method.mutable_linear()->set_bases(4);
}

std::string linear_text(const v1::Method& method) {
  const v1::Linear& linear = method.linear();
  return "linear " + std::to_string(linear.bases()) +
         (linear.weighting() == v1::Linear::OBSERVER ? " observer" : "") +
         (linear.bounce() ? " bounce" : "");
}

std::string planned_linear(const v1::Plan& plan) {
  return "linear with " + counted(plan.bands(), "basis function") + " (residual " +
         number(plan.residual(), "%.1e") + ")";
}

std::string planned_exact(const v1::Plan& plan) {
  return "exact with " + counted(plan.signatures(), "signature");
}

std::vector<std::string> compared_points() {
  std::vector<std::string> all;
  for (const char* step : {"50", "20", "10", "5", "1"})
    all.push_back("point { from: 400 to: 700 step: " + std::string(step) + " }");
  for (const char* count : {"4", "6", "8", "12", "16"})
    all.push_back("point { fitted: " + std::string(count) + " }");
  return all;
}

std::vector<std::string> compared_linear() {
  std::vector<std::string> all;
  for (const char* bases : {"2", "3", "4", "5", "6", "8", "12", "16"})
    for (const char* weighting : {"NONE", "OBSERVER"})
      all.push_back("linear { bases: " + std::string(bases) + " weighting: " + weighting + " }");
  return all;
}

v1::Method parsed(const std::string& text) {
  v1::Method method;
  [[maybe_unused]] const bool read = google::protobuf::TextFormat::ParseFromString(text, &method);
  assert(read);
  return method;
}

}  // namespace

const std::vector<MethodEntry>& method_entries() {
  static const std::vector<MethodEntry> entries = {
      {.word = "point",
       .trials = {{4, "point { fitted: 6 }"},
                  {4, "point { fitted: 8 }"},
                  {4, "point { fitted: 12 }"},
                  {4, "point { fitted: 16 }"},
                  {6, "point { from: 380 to: 780 step: 20 }"},
                  {6, "point { from: 380 to: 780 step: 10 }"},
                  {6, "point { from: 380 to: 780 step: 5 }"},
                  {6, "point { from: 360 to: 830 step: 1 }"}},
       .compared = compared_points(),
       .fill = fill_point,
       .check = check_point,
       .text = point_text,
       .planned = planned_point},
      {.word = "linear",
       .trials = {{3, "linear { bases: 3 weighting: OBSERVER bounce: true }"},
                  {3, "linear { bases: 4 weighting: OBSERVER bounce: true }"},
                  {3, "linear { bases: 6 weighting: OBSERVER bounce: true }"},
                  {5, "linear { bases: 8 weighting: OBSERVER bounce: true }"}},
       .compared = compared_linear(),
       .fill = fill_linear,
       .check = check_linear,
       .text = linear_text,
       .planned = planned_linear},
      {.word = "exact", .trials = {{0, "exact {}"}}, .planned = planned_exact},
      {.word = "prefilter", .trials = {{2, "prefilter {}"}}},
      {.word = "rgb", .trials = {{1, "rgb {}"}}}};
  return entries;
}

const MethodEntry* method_entry(const v1::Method& method) {
  const auto* field = method.GetReflection()->GetOneofFieldDescriptor(
      method, v1::Method::descriptor()->FindOneofByName("method"));
  if (field == nullptr) return nullptr;
  for (const MethodEntry& entry : method_entries())
    if (entry.word == field->name()) return &entry;
  assert(false && "a test holds the table against the schema");
  return nullptr;
}

std::string method_words() {
  std::string words;
  for (const MethodEntry& entry : method_entries())
    words += (words.empty() ? "" : ", ") + std::string(entry.word);
  return words;
}

std::string method_text(const v1::Method& method) {
  const MethodEntry* entry = method_entry(method);
  if (entry == nullptr) return "";
  return entry->text ? entry->text(method) : entry->word;
}

std::string planned_method_text(const v1::Plan& plan) {
  const MethodEntry* entry = method_entry(plan.method());
  if (entry == nullptr) return "";
  return entry->planned ? entry->planned(plan) : entry->word;
}

std::vector<v1::Method> candidates() {
  std::vector<Trial> trials;
  for (const MethodEntry& entry : method_entries())
    trials.insert(trials.end(), entry.trials.begin(), entry.trials.end());
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.turn < b.turn; });
  std::vector<v1::Method> methods;
  for (const Trial& trial : trials) methods.push_back(parsed(trial.method));
  return methods;
}

v1::Method default_method(const MethodEntry& entry) {
  v1::Method method = parsed(std::string(entry.word) + " {}");
  if (entry.fill) entry.fill(method);
  return method;
}

std::vector<v1::Method> compared_methods() {
  std::vector<v1::Method> methods;
  const auto& entries = method_entries();
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    if (entry->compared.empty()) methods.push_back(default_method(*entry));
    for (const std::string& text : entry->compared) methods.push_back(parsed(text));
  }
  return methods;
}

}  // namespace metamer
