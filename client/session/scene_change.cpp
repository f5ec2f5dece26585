#include "client/session/scene_change.h"

#include <algorithm>
#include <utility>

namespace metamer::client {
namespace {

/// Each of the newer list in the place of the older's of that name.
template <class Named>
void merge_named(const Named& newer, Named& older) {
  for (const auto& one : newer) {
    const auto same = std::find_if(older.begin(), older.end(),
                                   [&](const auto& other) { return other.name() == one.name(); });
    *(same == older.end() ? older.Add() : &*same) = one;
  }
}

}  // namespace

void merge(v1::UpdateView newer, v1::UpdateView& older) {
  if (newer.has_camera()) *older.mutable_camera() = std::move(*newer.mutable_camera());
  if (newer.has_settings()) *older.mutable_settings() = std::move(*newer.mutable_settings());
  merge_named(newer.light(), *older.mutable_light());
  merge_named(newer.material(), *older.mutable_material());
  merge_named(newer.asset(), *older.mutable_asset());
}

void merge(SceneChange newer, SceneChange& older) {
  if (newer.scene) {
    older = std::move(newer);
    return;
  }
  merge(std::move(newer.rest), older.rest);
  for (Upload& file : newer.files) {
    std::erase_if(older.files, [&](const Upload& other) { return other.name == file.name; });
    older.files.push_back(std::move(file));
  }
}

}  // namespace metamer::client
