#pragma once

#include <QImage>
#include <QObject>
#include <memory>
#include <vector>

#include "client/gui/link/link.h"
#include "common/image/image.h"

namespace metamer::gui {

/// A frame as it is shown.
struct LiveFrame {
  QImage image;  ///< RGB32, as the scene's development says.
  /// X Y Z of complete frames, where they were asked for; null else.
  std::shared_ptr<const Image> xyz;
  bool newest = false;  ///< It shows all that the view was told.
  v1::Frame frame;
  v1::Plan plan;
};

/// A view on the server, for the window's thread.
class RemoteView : public QObject {
  Q_OBJECT
 public:
  RemoteView(Link& link, client::Submission submission, QObject* parent);

  void change(v1::UpdateView change, std::vector<client::Upload> files = {});
  /// Another scene in the place of the whole; the backend stays.
  void replace(client::Submission scene);
  /// After a frame was painted: at most two wait.
  void taken();
  void pause(bool paused);
  void want_xyz(bool wanted);
  /// At most one question is under way; of those that come meanwhile the newest is asked.
  void probe(const client::ViewPlace& place);

 Q_SIGNALS:
  void opened(const std::shared_ptr<const v1::Plan>& plan);
  void frame(const std::shared_ptr<const LiveFrame>& frame);
  void refused(const std::shared_ptr<const client::SessionError>& error);
  /// The server lost what drew it, and it is opened anew.
  void interrupted(const std::shared_ptr<const client::SessionError>& error);
  void probed(const client::ViewPlace& place, const std::shared_ptr<const v1::Probed>& probed);
  void not_probed(const std::shared_ptr<const client::SessionError>& error);
  void lost(const std::shared_ptr<const client::SessionError>& error);  ///< The last.

 private:
  std::shared_ptr<client::HubView> view_;
};

}  // namespace metamer::gui
