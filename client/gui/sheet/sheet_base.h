#pragma once

#include <functional>

#include "client/gui/app/main_window.h"
#include "client/gui/sheet/sheet_work.h"

namespace metamer::gui {

/// Finds what a metamerism sheet of the scene in front is made of: the newest finished picture that
/// fits it and has factors; else a small one is rendered.
class SheetBaseFinder : public QObject {
  Q_OBJECT
 public:
  explicit SheetBaseFinder(MainWindow& window);

  /// One question at a time counts: the newest.
  void find();

 Q_SIGNALS:
  void rendering();
  void found(const std::shared_ptr<const SheetBase>& base);
  void failed(const QString& why);

 private:
  void render(const v1::Scene& scene);
  void watch(const client::JobHandle& job, unsigned number, std::shared_ptr<const v1::Scene> scene);

  MainWindow& window_;
  std::shared_ptr<const SheetBase> kept_;  ///< That was rendered for it.
  unsigned asked_ = 0;
};

}  // namespace metamer::gui
