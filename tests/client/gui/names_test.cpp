// What cannot be seen can be heard: all that takes the keyboard in these pages has a name.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLabel>
#include <QScrollArea>
#include <QTabBar>

#include "client/gui/compare/compare_page.h"
#include "client/gui/log/log_dock.h"
#include "client/gui/methods/methods_dock.h"
#include "client/gui/models/models_page.h"
#include "client/gui/spectra/metamer_dialog.h"
#include "client/gui/spectra/resample_dialog.h"
#include "client/gui/spectra/rgb_dialog.h"
#include "client/gui/spectra/spectra_window.h"

namespace metamer::gui {
namespace {

bool has_name(const QWidget& widget) {
  if (!widget.accessibleName().isEmpty()) return true;
  if (const auto* button = qobject_cast<const QAbstractButton*>(&widget))
    return !button->text().isEmpty();
  for (const QLabel* label : widget.window()->findChildren<QLabel*>())
    if (label->buddy() == &widget) return true;
  return false;
}

/// Parts of widgets that have their name: the line of a box, the headers and bars of a table.
bool is_part(const QWidget& widget) {
  const QWidget* parent = widget.parentWidget();
  return widget.objectName().startsWith(QStringLiteral("qt_")) ||
         (parent != nullptr &&
          (parent->inherits("QComboBox") || parent->inherits("QAbstractSpinBox") ||
           parent->inherits("QAbstractItemView"))) ||
         widget.inherits("QCustomPlot") || widget.inherits("QScrollArea") ||
         widget.inherits("QSplitterHandle") || widget.inherits("QMenu");
}

void expect_names(QWidget& page) {
  page.show();
  for (const QWidget* widget : page.findChildren<QWidget*>()) {
    if (widget->focusPolicy() == Qt::NoFocus || is_part(*widget) ||
        widget->window() != page.window())
      continue;
    EXPECT_TRUE(has_name(*widget))
        << page.objectName().toStdString() << ": " << widget->metaObject()->className();
  }
}

TEST(AccessibleNames, AreThereInAllPages) {
  auto worded = client::worded_spectra("TCS09");
  const QList<Listed> rows{*listed(worded->front(), Viewer::usual())};
  SpectraWindow spectra;
  ResampleDialog resample(rows, Viewer::usual());
  RgbDialog rgb(rows, Viewer::usual());
  MetamerDialog metamer(rows.front(), Viewer::usual());
  ComparePage compare([] { return QList<PictureAtHand>(); });
  ModelsPage models;
  MethodsDock methods;
  Log lines;
  LogDock log(lines);
  for (QWidget* page : std::initializer_list<QWidget*>{&spectra, &resample, &rgb, &metamer,
                                                       &compare, &models, &methods, &log})
    expect_names(*page);
}

}  // namespace
}  // namespace metamer::gui
