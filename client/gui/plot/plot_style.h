#pragma once

#include <QColor>
#include <QPalette>
#include <QSize>
#include <QString>

#include "common/problem.h"

class QCustomPlot;

/// What all plots look like, in light and dark themes, and how they get into files.
namespace metamer::gui {

/// The i-th colour of curves: at least 3:1 in contrast to the palette's Base (WCAG 2.1, 1.4.11),
/// and told apart by most who see few colours. Six of them; then they come again.
QColor curve_color(int i, const QPalette& palette);
inline constexpr int curve_colors = 6;

/// Background, axes, grid, legend and fonts.
void apply_theme(QCustomPlot& plot, const QPalette& palette);

/// Of white paper, whatever the theme is.
QPalette paper_palette();

/// As large as it is shown, into a .pdf, or into a .png of twice as many pixels. Errors: another
/// extension; it can't be written.
Result<void> save_plot(QCustomPlot& plot, const QSize& size, const QString& file);

/// Text into a file, whole or not at all. Error: what the system says.
Result<void> save_text(const QString& file, const QString& text);

}  // namespace metamer::gui
