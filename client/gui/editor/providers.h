#pragma once

#include <QByteArray>
#include <QString>
#include <QStringList>
#include <functional>

namespace metamer::gui {

/// What can be put in the place of the bytes begin to end of a text.
struct EditorWords {
  int begin = 0, end = 0;
  QStringList words;
};

/// What is to be said of a place in a text.
struct EditorHelp {
  QString line;  ///< A line of plain text.
  QString tip;   ///< All of it, as rich text.
};

/// What an editor asks of a byte of its text, which is UTF-8. Each answers once, later and in the
/// same thread, or not at all.
struct EditorProviders {
  template <class Answer>
  using Ask = std::function<void(const QByteArray& text, int byte,
                                 std::function<void(const Answer&)> answer)>;
  Ask<EditorWords> words;
  Ask<EditorHelp> help;
};

}  // namespace metamer::gui
