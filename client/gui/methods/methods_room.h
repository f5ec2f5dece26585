#pragma once

#include <QDockWidget>
#include <QList>
#include <QPointer>
#include <QTimer>
#include <memory>

#include "client/gui/app/main_window.h"
#include "client/gui/methods/known_methods.h"
#include "client/gui/methods/methods_dock.h"
#include "client/gui/methods/tradeoff_job.h"

namespace metamer::gui {

/// Fills the dock of methods: asks the server, follows the scene in front, sets its method and its
/// tolerance, and takes what came of jobs and the live view.
class MethodsRoom : public QObject {
  Q_OBJECT
 public:
  explicit MethodsRoom(MainWindow& window);

  MethodsDock& dock() { return *dock_; }
  void show_dock();
  /// Asks for predictions of the scene in front.
  void explain();
  /// Renders it by every method.
  void measure(unsigned rounds);
  /// What was measured of the scene in front, as tradeoff_csv. Errors: nothing was; it can't be
  /// written.
  Result<void> save(const QString& file) const;

 private:
  struct OfDocument {
    QPointer<const Document> document;
    KnownMethods known;
  };
  using Tradeoff = std::shared_ptr<const client::Tradeoff>;

  void follow_document();
  void follow_pages();
  void update();
  void ask(bool choice_only);
  void take_job(Document& document, const v1::Scene& scene, const client::JobRecord& job,
                bool choice_only);
  /// Null: nothing is known of it.
  KnownMethods* find_known(const Document* document);
  const KnownMethods* find_known(const Document* document) const;
  void set_known(const Document& document, KnownMethods known);
  void join_jobs(KnownMethods& known) const;
  void set_method(const v1::Settings& wanted, const QString& text);
  void save_as();

  MainWindow& window_;
  MethodsDock* dock_;
  QDockWidget* frame_;
  QPointer<Document> document_;
  QPointer<LivePage> live_;
  QList<OfDocument> known_;
  TradeoffJob* measuring_ = nullptr;
  QTimer settled_;      ///< A camera that is moved comes to rest.
  unsigned asked_ = 0;  ///< Answers of older questions are dropped.
  bool asking_ = false;
};

}  // namespace metamer::gui
