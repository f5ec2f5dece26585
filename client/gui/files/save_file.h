#pragma once

#include <QString>

class QWidget;

namespace metamer::gui {

class Document;
class TextFile;

/// Saves a text, asking where if it has no file yet, is to go `elsewhere`, or is the demo booth; a
/// scene that goes to another folder may take the files along that it names, and the booth does.
/// False: it is not saved, as a box said or the user wanted.
bool save_file(QWidget* parent, TextFile& file, bool elsewhere);

/// The same to a file that is known.
bool save_to(QWidget* parent, TextFile& file, const QString& path);

}  // namespace metamer::gui
