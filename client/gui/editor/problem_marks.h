#pragma once

#include <QList>
#include <QString>

class QsciScintilla;

namespace metamer::gui {

/// Something wrong with the text, at its place. Lines and columns count from 1, columns in bytes of
/// UTF-8.
struct EditorProblem {
  int line = 0, column = 0;
  QString message;
};

/// Problems as they show in a text: a squiggle below the word, a mark beside the line, and a box
/// below it for the one that a user has gone to. Marks move with the text until they are set anew.
class ProblemMarks {
 public:
  explicit ProblemMarks(QsciScintilla& area);

  void show(const QList<EditorProblem>& problems);
  /// Of a byte of the text, from 0: the sentences whose squiggle lies there; empty: none does.
  QString at(long byte) const;
  /// Opens the box with the sentences of a line, from 1; a line without any closes it.
  void open_box(int line);
  void close_box();

  const QList<EditorProblem>& problems() const { return problems_; }

 private:
  long begin_of(const EditorProblem& problem) const;

  QsciScintilla& area_;
  QList<EditorProblem> problems_;
  bool open_ = false;
};

}  // namespace metamer::gui
