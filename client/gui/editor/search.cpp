#include "client/gui/editor/search.h"

#include <Qsci/qsciscintilla.h>

namespace metamer::gui {
namespace {

int flags_of(const SearchFor& wanted) {
  return (wanted.match_case ? QsciScintilla::SCFIND_MATCHCASE : 0) |
         (wanted.whole_words ? QsciScintilla::SCFIND_WHOLEWORD : 0) |
         (wanted.pattern ? QsciScintilla::SCFIND_REGEXP | QsciScintilla::SCFIND_CXX11REGEX : 0);
}

}  // namespace

std::optional<TextRange> TextSearch::find(const SearchFor& wanted, long from, long to) const {
  const QByteArray what = wanted.what.toUtf8();
  if (what.isEmpty()) return std::nullopt;
  area_.SendScintilla(QsciScintilla::SCI_SETSEARCHFLAGS, flags_of(wanted));
  area_.SendScintilla(QsciScintilla::SCI_SETTARGETRANGE, static_cast<unsigned long>(from), to);
  const long begin = area_.SendScintilla(QsciScintilla::SCI_SEARCHINTARGET,
                                         static_cast<unsigned long>(what.size()), what.constData());
  if (begin < 0) return std::nullopt;
  return TextRange{begin, area_.SendScintilla(QsciScintilla::SCI_GETTARGETEND)};
}

bool TextSearch::select(const std::optional<TextRange>& range) {
  if (!range) return false;
  area_.SendScintilla(QsciScintilla::SCI_SETSEL, static_cast<unsigned long>(range->begin),
                      range->end);
  const int line = static_cast<int>(area_.SendScintilla(QsciScintilla::SCI_LINEFROMPOSITION,
                                                        static_cast<unsigned long>(range->begin)));
  area_.ensureLineVisible(line);
  area_.SendScintilla(QsciScintilla::SCI_SCROLLCARET);
  return true;
}

bool TextSearch::find_next(const SearchFor& wanted, bool backwards) {
  const long begin = area_.SendScintilla(QsciScintilla::SCI_GETSELECTIONSTART);
  const long end = area_.SendScintilla(QsciScintilla::SCI_GETSELECTIONEND);
  const long length = area_.length();
  if (backwards) return select(find(wanted, begin, 0)) || select(find(wanted, length, 0));
  return select(find(wanted, end, length)) || select(find(wanted, 0, length));
}

bool TextSearch::find_here(const SearchFor& wanted) {
  const long begin = area_.SendScintilla(QsciScintilla::SCI_GETSELECTIONSTART);
  return select(find(wanted, begin, area_.length())) || select(find(wanted, 0, area_.length()));
}

/// Of what find() found last. Returns the length of what stands there now.
long TextSearch::replace_target(const SearchFor& wanted, const QByteArray& by) {
  return area_.SendScintilla(
      wanted.pattern ? QsciScintilla::SCI_REPLACETARGETRE : QsciScintilla::SCI_REPLACETARGET,
      static_cast<unsigned long>(by.size()), by.constData());
}

bool TextSearch::replace_selected(const SearchFor& wanted, const QString& by) {
  const long begin = area_.SendScintilla(QsciScintilla::SCI_GETSELECTIONSTART);
  const long end = area_.SendScintilla(QsciScintilla::SCI_GETSELECTIONEND);
  const auto here = find(wanted, begin, area_.length());
  if (!here || here->begin != begin || here->end != end || begin == end) return false;
  const long length = replace_target(wanted, by.toUtf8());
  area_.SendScintilla(QsciScintilla::SCI_GOTOPOS, static_cast<unsigned long>(begin + length));
  return true;
}

int TextSearch::replace_all(const SearchFor& wanted, const QString& by) {
  const QByteArray bytes = by.toUtf8();
  int done = 0;
  area_.SendScintilla(QsciScintilla::SCI_BEGINUNDOACTION);
  for (long at = 0;;) {
    const auto found = find(wanted, at, area_.length());
    if (!found) break;
    at = found->begin + replace_target(wanted, bytes);
    ++done;
    // An empty match is not found again.
    if (found->begin == found->end && ++at > area_.length()) break;
  }
  area_.SendScintilla(QsciScintilla::SCI_ENDUNDOACTION);
  return done;
}

int TextSearch::count(const SearchFor& wanted, int most) const {
  int found = 0;
  for (long at = 0; found < most; ++found) {
    const auto next = find(wanted, at, area_.length());
    if (!next) break;
    at = next->end > next->begin ? next->end : next->end + 1;
    if (at > area_.length()) return found + 1;
  }
  return found;
}

}  // namespace metamer::gui
