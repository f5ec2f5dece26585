#include "client/gui/app/theme.h"

#include <QPalette>
#include <QStyleFactory>

namespace metamer::gui {

void set_dark(QApplication& application) {
  application.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  const QColor window(42, 42, 42), base(30, 30, 30), text(225, 225, 225), faint(130, 130, 130);
  QPalette palette;
  palette.setColor(QPalette::Window, window);
  palette.setColor(QPalette::Button, QColor(56, 56, 56));
  for (const auto role : {QPalette::Base, QPalette::AlternateBase}) palette.setColor(role, base);
  palette.setColor(QPalette::ToolTipBase, window);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText,
                          QPalette::ToolTipText, QPalette::BrightText})
    palette.setColor(role, text);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, faint);
  palette.setColor(QPalette::PlaceholderText, faint);
  palette.setColor(QPalette::Highlight, QColor(38, 97, 156));
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::Link, QColor(110, 170, 230));
  application.setPalette(palette);
}

}  // namespace metamer::gui
