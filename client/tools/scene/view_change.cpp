#include "client/tools/scene/view_change.h"

#include <google/protobuf/util/message_differencer.h>

#include <algorithm>

namespace metamer::client {
namespace {

using google::protobuf::util::MessageDifferencer;

/// Whether two lists have the same names in the same order, and which of the newer are others.
template <class Named>
bool add_changed(const Named& shown, const Named& wanted, Named& changed) {
  if (shown.size() != wanted.size()) return false;
  for (int i = 0; i < shown.size(); ++i) {
    if (shown[i].name() != wanted[i].name()) return false;
    if (!MessageDifferencer::Equals(shown[i], wanted[i])) *changed.Add() = wanted[i];
  }
  return true;
}

}  // namespace

std::optional<v1::UpdateView> view_change(const v1::Scene& shown, const v1::Scene& wanted) {
  const bool same_objects = std::equal(
      shown.object().begin(), shown.object().end(), wanted.object().begin(), wanted.object().end(),
      [](const v1::Object& a, const v1::Object& b) { return MessageDifferencer::Equals(a, b); });
  if (!same_objects || shown.settings().backend() != wanted.settings().backend())
    return std::nullopt;

  v1::UpdateView change;
  if (!add_changed(shown.light(), wanted.light(), *change.mutable_light()) ||
      !add_changed(shown.material(), wanted.material(), *change.mutable_material()))
    return std::nullopt;
  if (!MessageDifferencer::Equals(shown.camera(), wanted.camera()))
    *change.mutable_camera() = wanted.camera();
  if (!MessageDifferencer::Equals(shown.settings(), wanted.settings()))
    *change.mutable_settings() = wanted.settings();
  return change;
}

}  // namespace metamer::client
