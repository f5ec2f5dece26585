#pragma once

#include <QByteArray>
#include <QString>
#include <optional>

class QsciScintilla;

namespace metamer::gui {

/// What is looked for in a text.
struct SearchFor {
  QString what;
  bool match_case = false, whole_words = false,
       pattern = false;  ///< A regular expression of C++11.
};

/// Bytes of a text.
struct TextRange {
  long begin = 0, end = 0;
};

/// Looking for something in a text, and putting something else in its place.
class TextSearch {
 public:
  explicit TextSearch(QsciScintilla& area) : area_(area) {}

  /// The first in the bytes from `from` to `to`, the last where from > to. Nothing: it is not
  /// there, or is no pattern.
  std::optional<TextRange> find(const SearchFor& wanted, long from, long to) const;
  /// The next after the selection, or before it, going on at the other end; selects it.
  bool find_next(const SearchFor& wanted, bool backwards);
  /// The same, but what is selected stays so if it still fits.
  bool find_here(const SearchFor& wanted);
  /// Replaces the selection if it is what is wanted; `by` may cite a pattern's groups as \1.
  bool replace_selected(const SearchFor& wanted, const QString& by);
  /// All of them, as one step to undo. Their number.
  int replace_all(const SearchFor& wanted, const QString& by);
  int count(const SearchFor& wanted, int most) const;

 private:
  bool select(const std::optional<TextRange>& range);
  long replace_target(const SearchFor& wanted, const QByteArray& by);

  QsciScintilla& area_;
};

}  // namespace metamer::gui
