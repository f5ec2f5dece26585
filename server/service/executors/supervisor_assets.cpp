// Which assets the worker sees: those of its job and of its views.
#include "server/service/executors/supervisor.h"

namespace metamer::service {

/// Starts a worker with a folder of its own.
tl::expected<std::shared_ptr<WorkerProcess>, WorkerProcess::SpawnError> Supervisor::spawn() {
  auto folder = AssetFolder::make(options_.command.store);
  if (!folder)
    return tl::unexpected(
        WorkerProcess::SpawnError{.message = folder.error().message, .shortage = true});
  assets_ = *std::move(folder);
  WorkerCommand command = options_.command;
  command.store = assets_->path();
  return WorkerProcess::spawn(
      executor_, command,
      {[this](v1::WorkerEnvelope message) { on_message(std::move(message)); },
       [this](const std::string& reason) { on_exit(reason); }});
}

/// Brings the folder up to date: before the worker hears of a job or view, and when one has left
/// it.
Result<void> Supervisor::show_assets(std::uint64_t closed_view) {
  std::vector<const AssetHolds*> all;
  if (job_) all.push_back(&job_->assets());
  std::vector<ViewPtr> views;
  if (options_.lane.views) views = views_.of(backend());
  for (const ViewPtr& view : views)
    if (view->id() != closed_view)
      for (const AssetHolds* const holds : view->assets()) all.push_back(holds);
  return assets_->show(all);
}

/// Before the worker is told of a view. False: the view has ended, since it can't see its assets.
bool Supervisor::show_assets_of(const v1::WorkerEnvelope& message) {
  const v1::UpdateView& update = message.update_view();
  if (message.has_close_view()) return (void)show_assets(message.close_view().view_id()), true;
  if (!message.has_open_view() && update.scene_sha256().empty() && update.asset().empty())
    return true;
  const auto shown = show_assets();
  if (shown) return true;
  const auto id = message.has_open_view() ? message.open_view().view_id() : update.view_id();
  v1::ViewClosed closed;
  closed.mutable_reason()->set_kind(v1::Failed::SERVER);
  closed.mutable_reason()->set_reason(shown.error().message);
  if (const ViewPtr view = views_.find(id)) view->end(std::move(closed));
  return false;
}

}  // namespace metamer::service
