#pragma once

#include <optional>
#include <vector>

#include "client/session/submission.h"
#include "metamer/v1/views.pb.h"

namespace metamer::client {

/// What a view is told in one go: another scene in the place of the whole, or none, and what is
/// changed of it.
struct SceneChange {
  std::optional<Submission> scene;
  v1::UpdateView rest;
  std::vector<Upload> files;  ///< That `rest` names beside the scene's.

  bool empty() const { return !scene && files.empty() && rest.ByteSizeLong() == 0; }
};

/// Puts a newer change over an older one: what the newer one names wins, another scene over all.
void merge(v1::UpdateView newer, v1::UpdateView& older);
void merge(SceneChange newer, SceneChange& older);

}  // namespace metamer::client
