#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <memory>

#include "client/gui/document/document.h"
#include "client/gui/link/remote_view.h"
#include "client/gui/picture/picture_page.h"

namespace metamer::gui {

/// A document as it looks now: a view on the server that follows every change of scene, look and
/// camera.
class LivePage : public PicturePage {
  Q_OBJECT
 public:
  LivePage(Link& link, Document& document, QWidget* parent = nullptr);

  Canvas& canvas() override { return *canvas_; }
  Document& document() { return document_; }
  bool live() const { return live_; }
  void set_live(bool live);
  /// Whether it follows the document: live, and on a server.
  bool goes_on() const { return live_ && view_ != nullptr; }
  void show_info(bool shown);
  /// Another method than the document's, for a moment; nothing: its own.
  void show_by(const std::optional<v1::Method>& method);

  /// The camera that is shown: the look's, else the scene's.
  v1::Camera camera() const;
  void set_camera(const v1::Camera& camera);
  void home();

  /// Asks what is at a pixel of the picture as it is shown, and the mean of the square around it.
  /// Returns where that is; nothing: there is no picture. Of questions that come fast the newest is
  /// answered.
  std::optional<client::ViewPlace> probe(const QPoint& pixel, int side);

  /// Null before the first frame.
  std::shared_ptr<const LiveFrame> frame() const { return frame_; }
  std::optional<Picture> picture() const override { return given_; }
  QString picture_title() const override;
  /// The next complete frame, whose X Y Z are asked for.
  void hand_over(std::function<void(const Picture&)> to) override;
  double frames_per_second() const { return rate_; }

 Q_SIGNALS:
  void framed();
  /// Where a pixel was asked for: pixels of a complete frame.
  void probed(const client::ViewPlace& place, const std::shared_ptr<const v1::Probed>& probed);
  void not_probed(const std::shared_ptr<const client::SessionError>& error);
  /// What keeps the view from what the document says; empty: nothing does.
  void troubled(const QString& why);

 private:
  void follow();
  void follow_camera();
  client::Submission submission(const v1::Scene& scene);
  void open_view(const v1::Scene& scene);
  void wait_for_frame();
  void take(const std::shared_ptr<const LiveFrame>& frame);
  void give(const LiveFrame& frame);
  void go_on_unseen();
  void show_frame();
  void ask_xyz();
  void lose(const client::SessionError& error);
  void update_overlay();
  void drag(const QPointF& by, Qt::MouseButton button, Qt::KeyboardModifiers modifiers);
  v1::Scene sized(v1::Scene scene) const;

  Link& link_;
  Document& document_;
  Canvas* canvas_;
  RemoteView* view_ = nullptr;
  v1::Scene shown_;  ///< What the view was told, with these files.
  std::vector<Asset> shown_files_;
  std::optional<v1::Method> method_;  ///< In place of the document's.
  std::shared_ptr<const LiveFrame> frame_;
  QList<std::function<void(const Picture&)>> waiting_;  ///< For X Y Z.
  std::optional<Picture> given_;  ///< What is shown, once its X Y Z have come.
  bool live_ = true, info_ = true, taken_due_ = false;
  QElapsedTimer since_;
  QElapsedTimer due_;  ///< Valid while what is shown is older than what the view was told.
  QTimer age_;         ///< Shows how long, meanwhile.
  double rate_ = 0;
};

}  // namespace metamer::gui
