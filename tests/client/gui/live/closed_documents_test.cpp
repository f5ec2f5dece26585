// Of documents that were shown and closed nothing is left.
#include <QPointer>

#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

class ClosedDocuments : public OpenedScene {
 protected:
  /// Also what goes by deleteLater.
  qsizetype objects() const {
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return window.findChildren<QObject*>().size();
  }
};

TEST_F(ClosedDocuments, LeaveNoObjectBehindAndNoViewOnTheServer) {
  link.open({});
  window.resize(700, 400);
  window.show();
  const QByteArray scene = QByteArray(sound) + "settings { spp: 1 }\n";
  constexpr int documents = 20;  // more than a server has views
  qsizetype before = 0;
  for (int i = 0; i < documents; ++i) {
    open(scene);
    const QPointer<Document> document = window.document();
    const QPointer<LivePage> live = window.live();
    const QPointer<SceneEditor> editor = window.editor();
    ASSERT_TRUE(document && live && editor);
    ASSERT_TRUE(wait([&] { return live->frame() && live->frame()->frame.complete(); }))
        << "document " << i;
    const std::weak_ptr<const client::CheckedScene> checked = document->checked();
    const std::weak_ptr<const LiveFrame> frame = live->frame();
    ASSERT_TRUE(window.close_scene(0));
    EXPECT_TRUE(document.isNull());
    EXPECT_TRUE(live.isNull());
    EXPECT_TRUE(editor.isNull());
    EXPECT_TRUE(wait([&] { return checked.expired() && frame.expired(); }));
    // The first one makes what all have in common.
    if (i == 0) before = objects();
    EXPECT_EQ(objects(), before) << "after document " << i;
  }
  EXPECT_EQ(window.scenes().count(), 0);
  EXPECT_EQ(window.pictures().count(), 0);
}

}  // namespace
}  // namespace metamer::gui
