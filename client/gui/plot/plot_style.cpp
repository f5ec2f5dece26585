#include "client/gui/plot/plot_style.h"

#include <qcustomplot.h>

#include <QSaveFile>
#include <array>

namespace metamer::gui {
namespace {

bool is_dark(const QPalette& palette) { return palette.color(QPalette::Base).lightness() < 128; }

/// Between text and ground: what stands behind curves.
QColor faint(const QPalette& palette) {
  const QColor text = palette.color(QPalette::Text), base = palette.color(QPalette::Base);
  return QColor((text.red() + 5 * base.red()) / 6, (text.green() + 5 * base.green()) / 6,
                (text.blue() + 5 * base.blue()) / 6);
}

void style_axis(QCPAxis& axis, const QColor& text, const QColor& grid) {
  axis.setBasePen(QPen(text));
  axis.setTickPen(QPen(text));
  axis.setSubTickPen(QPen(text));
  axis.setLabelColor(text);
  axis.setTickLabelColor(text);
  axis.grid()->setPen(QPen(grid));
  axis.grid()->setZeroLinePen(QPen(grid));
}

}  // namespace

// After M. Okabe and K. Ito, Color universal design (2008), darkened for white and lightened for
// black where they would be too faint.
QColor curve_color(int i, const QPalette& palette) {
  static constexpr std::array<QRgb, curve_colors> on_light{0x0072b2, 0xc85200, 0x00805c,
                                                           0xb04a86, 0x7a5c00, 0x444444};
  static constexpr std::array<QRgb, curve_colors> on_dark{0x56b4e9, 0xf08a3c, 0x3fc9a0,
                                                          0xe69ac8, 0xf0e442, 0xcccccc};
  const auto at = static_cast<std::size_t>(i) % on_light.size();
  return QColor::fromRgb(is_dark(palette) ? on_dark[at] : on_light[at]);
}

void apply_theme(QCustomPlot& plot, const QPalette& palette) {
  const QColor text = palette.color(QPalette::Text), grid = faint(palette);
  plot.setBackground(palette.brush(QPalette::Base));
  for (QCPAxisRect* rect : plot.axisRects())
    for (QCPAxis* axis : rect->axes()) style_axis(*axis, text, grid);
  if (plot.legend == nullptr) return;
  plot.legend->setBrush(Qt::NoBrush);
  plot.legend->setTextColor(text);
}

QPalette paper_palette() {
  QPalette palette;
  palette.setColor(QPalette::Base, Qt::white);
  palette.setColor(QPalette::Text, Qt::black);
  return palette;
}

Result<void> save_plot(QCustomPlot& plot, const QSize& size, const QString& file) {
  const bool pdf = file.endsWith(QStringLiteral(".pdf"), Qt::CaseInsensitive);
  if (!pdf && !file.endsWith(QStringLiteral(".png"), Qt::CaseInsensitive))
    return problem(file.toStdString() + " ends neither in .pdf nor in .png");
  const bool saved = pdf ? plot.savePdf(file, size.width(), size.height())
                         : plot.savePng(file, size.width(), size.height(), 2);
  if (!saved) return problem(file.toStdString() + " can't be written");
  return {};
}

Result<void> save_text(const QString& file, const QString& text) {
  QSaveFile out(file);
  if (out.open(QIODevice::WriteOnly)) {
    out.write(text.toUtf8());
    if (out.commit()) return {};
  }
  return problem(file.toStdString() + ": " + out.errorString().toStdString());
}

}  // namespace metamer::gui
