// Laws that hold in every page and dialog of the window: names for those who hear it, Tab for those
// who have no mouse, models as Qt wants them.
#include <QAbstractButton>
#include <QAbstractItemModelTester>
#include <QAbstractItemView>
#include <QAbstractProxyModel>
#include <QApplication>
#include <QGroupBox>
#include <QMainWindow>
#include <QScrollArea>
#include <QTabBar>
#include <set>

#include "client/gui/app/tour.h"
#include "tests/client/gui/link/faulty_window.h"

namespace metamer::gui {
namespace {

/// A part of a widget that has its name: the line of a box, the headers and bars of a table.
bool is_inner_part(const QWidget& widget) {
  const QWidget* parent = widget.parentWidget();
  if (widget.objectName().startsWith(QStringLiteral("qt_"))) return true;
  for (const char* type :
       {"QScrollArea", "QSplitterHandle", "QMenu", "QMenuBar", "QTabBar", "QDockWidgetTitleButton",
        "QDialogButtonBox", "QToolBarExtension", "QCustomPlot"})
    if (widget.inherits(type)) return true;
  for (const char* type : {"QComboBox", "QAbstractSpinBox", "QAbstractItemView", "QLineEdit",
                           "QDockWidget", "QMessageBox"})
    if (parent != nullptr && parent->inherits(type) && !widget.inherits("QAbstractButton") &&
        widget.layout() == nullptr)
      return true;
  return parent != nullptr && parent->inherits("QLineEdit");
}

bool is_named(const QWidget& widget) {
  if (!widget.accessibleName().isEmpty()) return true;
  if (const auto* button = qobject_cast<const QAbstractButton*>(&widget))
    return !button->text().isEmpty();
  if (const auto* group = qobject_cast<const QGroupBox*>(&widget)) return !group->title().isEmpty();
  if (qobject_cast<const QLabel*>(&widget) != nullptr) return true;  // its text, or nothing
  for (const QLabel* label : widget.window()->findChildren<QLabel*>())
    if (label->buddy() == &widget) return true;
  return false;
}

QString described(const QWidget& widget) {
  QString path = QString::fromUtf8(widget.metaObject()->className()) + QLatin1Char(' ') +
                 widget.accessibleName();
  for (const QWidget* up = widget.parentWidget(); up != nullptr; up = up->parentWidget())
    path += QStringLiteral(" in ") + QString::fromUtf8(up->metaObject()->className());
  return path;
}

QList<QWidget*> seen_in(QWidget& window) {
  QList<QWidget*> seen;
  for (QWidget* one : window.findChildren<QWidget*>())
    if (one->window() == &window && one->isVisible() && one->isEnabled() &&
        !one->visibleRegion().isEmpty())
      seen << one;
  return seen;
}

void expect_all_named(QWidget& window, const char* page) {
  for (const QWidget* one : seen_in(window)) {
    if (one->focusPolicy() == Qt::NoFocus || one->focusProxy() != nullptr || is_inner_part(*one))
      continue;
    EXPECT_TRUE(is_named(*one)) << page << ": " << described(*one).toStdString();
  }
}

/// What is drawn and not written has a sentence.
void expect_sentences(QWidget& window, const char* page) {
  for (const QWidget* one : seen_in(window))
    for (const char* type : {"metamer::gui::Canvas", "metamer::gui::SpectrumPlot",
                             "metamer::gui::FigurePlot", "metamer::gui::HistogramPlot"}) {
      if (!one->inherits(type)) continue;
      EXPECT_FALSE(one->accessibleDescription().isEmpty())
          << page << ": " << described(*one).toStdString();
    }
}

void expect_sound_models(QWidget& window) {
  using Tester = QAbstractItemModelTester;
  std::set<QAbstractItemModel*> models;
  for (const QAbstractItemView* view : window.findChildren<QAbstractItemView*>())
    for (QAbstractItemModel* model = view->model(); model != nullptr;) {
      models.insert(model);
      auto* proxy = qobject_cast<QAbstractProxyModel*>(model);
      model = proxy == nullptr ? nullptr : proxy->sourceModel();
    }
  for (QAbstractItemModel* model : models)
    const Tester tester(model, Tester::FailureReportingMode::Warning);
}

/// Text that takes Tab for itself: F6 leaves it.
bool takes_tab(const QWidget& widget) {
  for (const QWidget* up = &widget; up != nullptr; up = up->parentWidget())
    if (up->inherits("metamer::gui::SceneEditor")) return true;
  return false;
}

/// From one on, Tab comes to all that can have the focus. In the main window it goes as far as the
/// text, which has it for itself.
void expect_tab_to_reach_all(QWidget& window, const char* page) {
  window.activateWindow();
  if (!QTest::qWaitFor([&] { return QApplication::activeWindow() == &window; }, 2000)) return;
  QList<QWidget*> wanted;
  for (QWidget* one = window.nextInFocusChain(); one != &window; one = one->nextInFocusChain())
    if ((one->focusPolicy() & Qt::TabFocus) != 0 && one->focusProxy() == nullptr &&
        seen_in(window).contains(one) && !is_inner_part(*one) && !takes_tab(*one))
      wanted << one;
  std::set<const QWidget*> reached;
  for (QWidget* start : wanted) {
    if (reached.contains(start)) continue;
    start->setFocus(Qt::TabFocusReason);
    for (qsizetype i = 0; i <= 2 * wanted.size() + 8; ++i) {
      QWidget* at = QApplication::focusWidget();
      if (at == nullptr || takes_tab(*at)) break;
      reached.insert(at);
      // In a text it goes from link to link first.
      for (int key = 0; key < 3 && QApplication::focusWidget() == at; ++key)
        QTest::keyClick(at, Qt::Key_Tab);
      if (QApplication::focusWidget() != at) continue;
      EXPECT_LE(wanted.size(), 1) << page << ": Tab does not leave "
                                  << described(*at).toStdString();
      break;
    }
    // A dialog has no text that takes Tab: one way round is all.
    if (!window.inherits("QMainWindow")) break;
  }
  for (const QWidget* one : wanted)
    EXPECT_TRUE(reached.contains(one)) << page << ": " << described(*one).toStdString();
}

class Pages : public FaultyWindow {
 protected:
  void look_at(const char* page) {
    QWidget& front = front_window(window_);
    expect_all_named(front, page);
    expect_sentences(front, page);
    expect_tab_to_reach_all(front, page);
    expect_sound_models(front);
    if (&front != &window_) front.close();
  }
  void look_after(const TourStep& step) {
    bool looked = false;
    // A modal dialog runs a loop of its own: the timer goes on in it.
    QTimer::singleShot(step.wait, &window_, [&] {
      looked = true;
      look_at(step.name);
    });
    take_step(window_, step);
    EXPECT_TRUE(wait([&] { return looked; }));
  }
};

TEST_F(Pages, HaveNamesSentencesAWayByTabAndSoundModels) {
  link_.open({});
  ASSERT_TRUE(completes());
  window_.resize(1400, 900);
  for (QDockWidget* dock : window_.findChildren<QDockWidget*>()) {
    dock->show();
    dock->raise();
    const QByteArray name = dock->objectName().toUtf8();
    look_after({name.constData(), {name.constData()}, 50});
  }
  for (TourStep step : tour_steps()) {
    step.wait = 400;
    look_after(step);
  }
  for (const char* id :
       {"light.all", "light.paint", "light.look.keep", "edit.find", "edit.replace"})
    look_after({id, {id}, 200});
}

}  // namespace
}  // namespace metamer::gui
