#pragma once

#include <QImage>
#include <QJsonObject>
#include <QStringList>
#include <QWidget>

namespace metamer::gui {

/// What `metamer WORDS… --json` prints, by the program that was built beside the tests.
QJsonObject answer_of(const QStringList& words);

/// A widget as a picture in $METAMER_GUI_SHOTS, to be looked at, where that is set.
void take_shot(QWidget& widget, const QString& name);

}  // namespace metamer::gui
