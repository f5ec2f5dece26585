#include "client/gui/editor/scene_lexer.h"

#include <Qsci/qsciscintilla.h>

#include <QFontDatabase>
#include <string_view>

#include "client/gui/editor/scene_styles.h"

namespace metamer::gui {
namespace {

struct StyleColors {
  SceneStyle style;
  const char* name;
  QRgb light, dark;  ///< At least 4.5 : 1 against white and against #232629 (WCAG 2.1, 1.4.3).
};

constexpr StyleColors style_colors[] = {
    {SceneStyle::plain, "Plain", 0x202020, 0xe0e0e0},
    {SceneStyle::field, "Field", 0x0b4f8a, 0x8cc4ff},
    {SceneStyle::text, "Text", 0x8a3b12, 0xf0b27a},
    {SceneStyle::open_text, "Text without its end", 0xb00020, 0xff8a8a},
    {SceneStyle::number, "Number", 0x1c6b2a, 0x9bdc9b},
    {SceneStyle::comment, "Comment", 0x666666, 0x9a9a9a},
    {SceneStyle::word, "Word", 0x6a1b9a, 0xd9a5ff},
    {SceneStyle::brace, "Brace", 0x444444, 0xc0c0c0},
};
static_assert(std::size(style_colors) == scene_style_count);

std::string_view view_of(const QByteArray& bytes) {
  return {bytes.data(), static_cast<std::size_t>(bytes.size())};
}

}  // namespace

SceneLexer::SceneLexer(QObject* parent) : QsciLexerCustom(parent) {
  setDefaultFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
}

void SceneLexer::set_colors(const QPalette& palette) {
  const QColor ground = palette.color(QPalette::Base);
  const bool dark = ground.lightness() < 128;
  setDefaultPaper(ground);
  setDefaultColor(palette.color(QPalette::Text));
  for (const StyleColors& one : style_colors) {
    setPaper(ground, static_cast<int>(one.style));
    setColor(QColor(dark ? one.dark : one.light), static_cast<int>(one.style));
  }
}

const char* SceneLexer::wordCharacters() const {
  return "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
}

QString SceneLexer::description(int style) const {
  return style >= 0 && style < scene_style_count ? tr(style_colors[style].name) : QString();
}

const char* SceneLexer::blockStart(int* style) const {
  if (style != nullptr) *style = static_cast<int>(SceneStyle::brace);
  return "{";
}

const char* SceneLexer::blockEnd(int* style) const {
  if (style != nullptr) *style = static_cast<int>(SceneStyle::brace);
  return "}";
}

void SceneLexer::styleText(int start, int end) {
  QsciScintilla& area = *editor();
  const auto line_of = [&](int at) {
    return static_cast<int>(area.SendScintilla(QsciScintilla::SCI_LINEFROMPOSITION, at));
  };
  // Whole lines.
  const int first = line_of(start);
  const long begin = area.SendScintilla(QsciScintilla::SCI_POSITIONFROMLINE, first);
  long stop = area.SendScintilla(QsciScintilla::SCI_POSITIONFROMLINE, line_of(end) + 1);
  if (stop < end) stop = area.length();
  if (stop <= begin) return;
  QByteArray text(stop - begin + 1, '\0');
  area.SendScintilla(QsciScintilla::SCI_GETTEXTRANGE, begin, stop, text.data());
  text.chop(1);

  const std::string styles = scene_styles(view_of(text));
  area.SendScintilla(QsciScintilla::SCI_STARTSTYLING, static_cast<unsigned long>(begin));
  area.SendScintilla(QsciScintilla::SCI_SETSTYLINGEX, styles.size(), styles.data());
  fold(first, text, styles);
}

/// A line's level is its depth, and above its low 16 bits that of the line after it.
void SceneLexer::fold(int line, const QByteArray& text, const std::string& styles) {
  QsciScintilla& area = *editor();
  constexpr int base = QsciScintilla::SC_FOLDLEVELBASE,
                mask = QsciScintilla::SC_FOLDLEVELNUMBERMASK;
  constexpr int deepest = mask - base;
  int depth = 0;
  if (line > 0) {
    const long before = area.SendScintilla(QsciScintilla::SCI_GETFOLDLEVEL, line - 1);
    depth = std::max(0, static_cast<int>(before >> 16) - base);
  }
  const std::string_view all = view_of(text);
  for (std::size_t begin = 0; begin < all.size(); ++line) {
    const std::size_t end = std::min(all.find('\n', begin), all.size() - 1) + 1;
    const int next =
        std::min(depth_after(all.substr(begin, end - begin),
                             std::string_view(styles).substr(begin, end - begin), depth),
                 deepest);
    int level = (base + depth) | ((base + next) << 16);
    if (next > depth) level |= QsciScintilla::SC_FOLDLEVELHEADERFLAG;
    area.SendScintilla(QsciScintilla::SCI_SETFOLDLEVEL, line, level);
    depth = next;
    begin = end;
  }
}

}  // namespace metamer::gui
