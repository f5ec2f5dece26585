#include "client/gui/link/remote_view.h"

#include <utility>

namespace metamer::gui {
namespace {

/// On the session's thread: the window's has no time for it.
std::shared_ptr<const LiveFrame> shown(client::ViewFrame came) {
  const QImage bytes(came.rgb.data(), static_cast<int>(came.width), static_cast<int>(came.height),
                     static_cast<qsizetype>(3 * came.width), QImage::Format_RGB888);
  std::shared_ptr<Image> xyz;
  if (came.xyz.size() == std::size_t{3} * came.width * came.height) {
    xyz = std::make_shared<Image>(
        Image{bytes.width(), bytes.height(), {"X", "Y", "Z"}, std::move(came.xyz)});
  }
  return std::make_shared<const LiveFrame>(
      LiveFrame{.image = bytes.convertToFormat(QImage::Format_RGB32),
                .xyz = std::move(xyz),
                .newest = came.newest,
                .frame = std::move(came.frame),
                .plan = std::move(came.plan)});
}

}  // namespace

RemoteView::RemoteView(Link& link, client::Submission submission, QObject* parent)
    : QObject(parent) {
  const QPointer<QObject> self(this);
  client::ViewHooks hooks;
  hooks.opened = [this, &link, self](const v1::Plan& plan) {
    link.deliver(self,
                 [this, kept = std::make_shared<const v1::Plan>(plan)] { Q_EMIT opened(kept); });
  };
  hooks.frame = [this, &link, self](client::ViewFrame came) {
    link.deliver(self, [this, kept = shown(std::move(came))] { Q_EMIT frame(kept); });
  };
  hooks.refused = [this, &link, self](const client::SessionError& error) {
    link.deliver(self, [this, kept = std::make_shared<const client::SessionError>(error)] {
      Q_EMIT refused(kept);
    });
  };
  hooks.interrupted = [this, &link, self](const client::SessionError& error) {
    link.deliver(self, [this, kept = std::make_shared<const client::SessionError>(error)] {
      Q_EMIT interrupted(kept);
    });
  };
  hooks.lost = [this, &link, self](const client::SessionError& error) {
    link.deliver(self, [this, kept = std::make_shared<const client::SessionError>(error)] {
      Q_EMIT lost(kept);
    });
  };
  hooks.probed = [this, &link, self](const client::ViewPlace& place,
                                     client::Answer<v1::Probed> answer) {
    const auto kept = std::make_shared<const client::Answer<v1::Probed>>(std::move(answer));
    link.deliver(self, [this, place, kept] {
      if (*kept)
        Q_EMIT probed(place, std::shared_ptr<const v1::Probed>(kept, &**kept));
      else
        Q_EMIT not_probed(std::make_shared<const client::SessionError>(kept->error()));
    });
  };
  view_ = link.hub().view(std::move(submission), std::move(hooks));
}

void RemoteView::change(v1::UpdateView change, std::vector<client::Upload> files) {
  view_->change(std::move(change), std::move(files));
}
void RemoteView::replace(client::Submission scene) { view_->replace(std::move(scene)); }
void RemoteView::taken() { view_->taken(); }
void RemoteView::pause(bool paused) { view_->pause(paused); }
void RemoteView::want_xyz(bool wanted) { view_->want_xyz(wanted); }
void RemoteView::probe(const client::ViewPlace& place) { view_->probe(place); }

}  // namespace metamer::gui
