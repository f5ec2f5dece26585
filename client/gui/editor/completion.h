#pragma once

#include <QObject>

#include "client/gui/editor/providers.h"

class QsciScintilla;

namespace metamer::gui {

/// The list of words that can stand at the caret: when it is asked for, and while a name is typed.
class Completion : public QObject {
  Q_OBJECT
 public:
  explicit Completion(QsciScintilla* area);

  void set_provider(EditorProviders::Ask<EditorWords> provider) { provider_ = std::move(provider); }
  /// Asks for the words at the caret. Where there is but one, it is put in its place.
  void ask() { request(true); }
  /// What the list shows that is open; empty: none is.
  const QStringList& shown() const { return shown_; }

 private:
  void request(bool wanted);
  void show(const EditorWords& found, bool wanted);
  void take(const QByteArray& word);
  void put(const QByteArray& word, long begin, long end);

  QsciScintilla* area_;
  EditorProviders::Ask<EditorWords> provider_;
  QStringList shown_;
  long begin_ = 0;  ///< Of the word that is completed.
  long rest_ = 0;   ///< Bytes of it after the caret.
  quint64 asked_ = 0;
};

}  // namespace metamer::gui
