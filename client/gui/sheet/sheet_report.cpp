// What a metamerism sheet says in words, and as a page.
#include <QObject>
#include <QPageSize>
#include <QPdfWriter>
#include <QSaveFile>
#include <QTextDocument>
#include <QUrl>

#include "client/gui/sheet/sheet_work.h"

namespace metamer::gui {
namespace {

QString de00_text(double value) { return QString::number(value, 'f', 2); }

/// The lights under which a paint is within the limit, and those under which it is not.
QString judged(const client::PaintMatch& match, double limit) {
  QStringList pass, fail;
  for (const Mismatch& under : match.under)
    (under.de00 <= limit ? pass : fail) << QString::fromStdString(under.light);
  if (fail.isEmpty()) return QObject::tr("matches under all lights");
  if (pass.isEmpty()) return QObject::tr("matches under none of the lights");
  return QObject::tr("matches under %1, but not under %2")
      .arg(pass.join(QStringLiteral(", ")), fail.join(QStringLiteral(", ")));
}

QString table_html(const MadeSheet& sheet) {
  QString html = QStringLiteral("<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\"><tr>");
  for (const QString& heading : sheet_headings())
    html += QStringLiteral("<th>%1</th>").arg(heading.toHtmlEscaped());
  html += QStringLiteral("</tr>");
  for (const QStringList& row : sheet_rows(sheet.wish, sheet.made.matches)) {
    html += QStringLiteral("<tr>");
    for (const QString& cell : row) html += QStringLiteral("<td>%1</td>").arg(cell.toHtmlEscaped());
    html += QStringLiteral("</tr>");
  }
  return html + QStringLiteral("</table>");
}

}  // namespace

QString verdict_of(const SheetWish& wish, const std::vector<client::PaintMatch>& matches) {
  const client::PaintMatch& best = client::nearest(matches);
  const QString name = QString::fromStdString(best.name), reference = wish.paints.front(),
                worst = QString::fromStdString(best.under[best.worst].light);
  const QString nearer =
      matches.size() > 1
          ? QObject::tr("%1 is nearer to %2.").arg(name, reference) + QLatin1Char(' ')
          : QString();
  return nearer + QObject::tr("%1 %2 (ΔE00 at most %3, under %4; the limit is %5).")
                      .arg(name, judged(best, wish.limit), de00_text(best.worst_de00()), worst,
                           de00_text(wish.limit));
}

QStringList sheet_headings() {
  return {QObject::tr("Paint"),    QObject::tr("Light"), QStringLiteral("ΔE00"),
          QStringLiteral("ΔE*ab"), QObject::tr("Index"), QObject::tr("Verdict")};
}

QList<QStringList> sheet_rows(const SheetWish& wish,
                              const std::vector<client::PaintMatch>& matches) {
  QList<QStringList> rows;
  for (const client::PaintMatch& match : matches)
    for (std::size_t i = 0; i < match.under.size(); ++i) {
      const Mismatch& under = match.under[i];
      rows << QStringList{QString::fromStdString(match.name),
                          QString::fromStdString(under.light),
                          de00_text(under.de00),
                          de00_text(under.deab),
                          de00_text(match.index[i].de00),
                          under.de00 <= wish.limit ? QObject::tr("✓ pass") : QObject::tr("✗ fail")};
    }
  return rows;
}

Result<void> save_sheet_png(const MadeSheet& sheet, const QString& file) {
  return write_image(sheet.picture, file.toStdString(), false,
                     {{"metamer:sheet", sheet.title.toStdString()}}, sheet.made.developing)
      .map([](const GamutReport&) {});
}

Result<void> save_sheet_pdf(const MadeSheet& sheet, const QString& file) {
  QSaveFile out(file);
  if (!out.open(QIODevice::WriteOnly)) return problem(out.errorString().toStdString());
  {
    QPdfWriter pdf(&out);
    pdf.setPageSize(QPageSize(QPageSize::A4));
    pdf.setPageOrientation(QPageLayout::Landscape);
    pdf.setTitle(QObject::tr("Metamerism sheet"));
    pdf.setResolution(150);
    QTextDocument document;
    document.setPageSize(QSizeF(pdf.width(), pdf.height()));
    document.addResource(QTextDocument::ImageResource, QUrl(QStringLiteral("sheet")), sheet.shown);
    // All on one page, where the table leaves room.
    const double share = std::min(1.0, std::min(pdf.width() / double(sheet.shown.width()),
                                                0.6 * pdf.height() / sheet.shown.height()));
    document.setHtml(QStringLiteral("<h2>%1</h2><p>%2</p><p><b>%3</b></p>"
                                    "<p><img src=\"sheet\" width=\"%4\"></p>%5")
                         .arg(QObject::tr("Metamerism sheet"), sheet.title.toHtmlEscaped(),
                              verdict_of(sheet.wish, sheet.made.matches).toHtmlEscaped())
                         .arg(int(share * sheet.shown.width()))
                         .arg(table_html(sheet)));
    document.print(&pdf);
  }
  if (!out.commit()) return problem(out.errorString().toStdString());
  return {};
}

}  // namespace metamer::gui
