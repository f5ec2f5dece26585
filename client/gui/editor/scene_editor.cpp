#include "client/gui/editor/scene_editor.h"

#include <Qsci/qsciscintilla.h>

#include <QCursor>
#include <QFontDatabase>
#include <QLabel>
#include <QPointer>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "client/gui/editor/completion.h"
#include "client/gui/editor/find_bar.h"
#include "client/gui/editor/scene_lexer.h"

namespace metamer::gui {
namespace {

constexpr long dwell = 400;      // ms that the mouse rests before a tip
constexpr int caret_rest = 120;  // ms that the caret rests before the line of help
constexpr int number_margin = 0, fold_margin = 2;

QByteArray bytes_of(const QsciScintilla& area, long begin, long end) {
  const auto* text =
      static_cast<const char*>(area.SendScintillaPtrResult(QsciScintilla::SCI_GETCHARACTERPOINTER));
  return {text + begin, end - begin};
}

/// The first byte of the outermost message that a byte lies in, as far as it was folded.
long outermost(const QsciScintilla& area, long byte) {
  long line = area.SendScintilla(QsciScintilla::SCI_LINEFROMPOSITION, byte);
  const auto level = [&](long of) {
    return area.SendScintilla(QsciScintilla::SCI_GETFOLDLEVEL, of) &
           QsciScintilla::SC_FOLDLEVELNUMBERMASK;
  };
  while (line > 0 && level(line) > QsciScintilla::SC_FOLDLEVELBASE) --line;
  return area.SendScintilla(QsciScintilla::SCI_POSITIONFROMLINE, line);
}

}  // namespace

SceneEditor::SceneEditor(QWidget* parent, Kind kind)
    : QWidget(parent),
      area_(new QsciScintilla(this)),
      rows_(new QVBoxLayout(this)),
      help_(new QLabel(this)),
      completion_(new Completion(area_)),
      find_bar_(new FindBar(area_, this)) {
  rows_->setContentsMargins(0, 0, 0, 0);
  rows_->setSpacing(0);
  rows_->addWidget(find_bar_);
  rows_->addWidget(area_, 1);
  rows_->addWidget(help_);
  help_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  help_->setTextFormat(Qt::PlainText);
  help_->setContentsMargins(4, 2, 4, 2);
  help_->setVisible(kind == Kind::scene);
  setFocusProxy(area_);
  if (kind == Kind::scene) lexer_ = new SceneLexer(this);
  set_up_area();
  marks_ = std::make_unique<ProblemMarks>(*area_);
  set_colors();

  connect(area_, &QsciScintilla::textChanged, this, [this] {
    marks_->close_box();
    help_timer_.start();
    Q_EMIT text_changed();
  });
  connect(area_, &QsciScintilla::cursorPositionChanged, this, [this](int line, int) {
    help_timer_.start();
    Q_EMIT caret_moved(line + 1, column());
  });
  connect(area_, &QsciScintilla::SCN_DWELLSTART, this,
          [this](int byte, int, int) { show_tip(byte); });
  connect(area_, &QsciScintilla::SCN_DWELLEND, this, [] { QToolTip::hideText(); });
  help_timer_.setSingleShot(true);
  help_timer_.setInterval(caret_rest);
  connect(&help_timer_, &QTimer::timeout, this, [this] {
    ask_help(static_cast<int>(area_->SendScintilla(QsciScintilla::SCI_GETCURRENTPOS)),
             [this](const EditorHelp& help) {
               help_line_ = help.line;
               show_help_line();
             });
  });
}

SceneEditor::~SceneEditor() = default;

void SceneEditor::set_up_area() {
  area_->setUtf8(true);
  area_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  if (lexer_ != nullptr) {
    area_->setLexer(lexer_);
    area_->setFolding(QsciScintilla::PlainFoldStyle, fold_margin);
  }
  area_->setMarginType(number_margin, QsciScintilla::NumberMargin);
  area_->setMarginWidth(number_margin, QStringLiteral("00000"));
  area_->setIndentationsUseTabs(false);
  area_->setIndentationWidth(2);
  area_->setTabWidth(2);
  area_->setAutoIndent(true);
  area_->setBraceMatching(QsciScintilla::SloppyBraceMatch);
  area_->setScrollWidth(1);
  area_->setScrollWidthTracking(true);
  area_->setAccessibleName(lexer_ != nullptr ? tr("Scene text") : tr("Text"));
  area_->SendScintilla(QsciScintilla::SCI_SETMOUSEDWELLTIME, dwell);
}

/// Scintilla has colours of its own: these are the window's.
void SceneEditor::set_colors() {
  const QPalette colors = palette();
  const QColor text = colors.color(QPalette::Text), window = colors.color(QPalette::Window);
  if (lexer_ != nullptr) {
    lexer_->set_colors(colors);
  } else {
    area_->setPaper(colors.color(QPalette::Base));
    area_->setColor(text);
  }
  area_->setCaretForegroundColor(text);
  area_->setMarginsBackgroundColor(window);
  area_->setMarginsForegroundColor(colors.color(QPalette::WindowText));
  area_->setFoldMarginColors(window, window);
  area_->setSelectionBackgroundColor(colors.color(QPalette::Highlight));
  area_->setSelectionForegroundColor(colors.color(QPalette::HighlightedText));
  area_->setMatchedBraceForegroundColor(text);
  area_->setMatchedBraceBackgroundColor(colors.color(QPalette::Midlight));
  area_->setUnmatchedBraceForegroundColor(QColor(200, 40, 40));
  area_->setUnmatchedBraceBackgroundColor(colors.color(QPalette::Base));
}

void SceneEditor::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange && marks_) set_colors();
  QWidget::changeEvent(event);
}

void SceneEditor::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  show_help_line();
}

void SceneEditor::set_providers(EditorProviders providers) {
  providers_ = std::move(providers);
  completion_->set_provider(providers_.words);
  help_timer_.start();
}

QString SceneEditor::text() const { return area_->text(); }

void SceneEditor::set_text(const QString& text) {
  area_->setText(text);
  area_->SendScintilla(QsciScintilla::SCI_EMPTYUNDOBUFFER);
}

void SceneEditor::change_text(const QString& text) {
  const QByteArray now = area_->text().toUtf8(), wanted = text.toUtf8();
  if (now == wanted) return;
  const auto inside_character = [&](qsizetype byte) {
    return byte < now.size() && (static_cast<unsigned char>(now[byte]) & 0xC0) == 0x80;
  };
  auto begin =
      std::mismatch(now.begin(), now.end(), wanted.begin(), wanted.end()).first - now.begin();
  while (inside_character(begin)) --begin;
  const auto most = std::min(now.size(), wanted.size()) - begin;
  auto same =
      std::mismatch(now.rbegin(), now.rbegin() + most, wanted.rbegin()).first - now.rbegin();
  while (inside_character(now.size() - same)) --same;
  replace(static_cast<int>(begin), static_cast<int>(now.size() - same),
          QString::fromUtf8(wanted.mid(begin, wanted.size() - same - begin)));
}

void SceneEditor::show_problems(const QList<EditorProblem>& problems) { marks_->show(problems); }

/// What is to be said of a byte of the text: of its outermost message alone, so that large scenes
/// are no slower.
void SceneEditor::ask_help(int byte, std::function<void(const EditorHelp&)> answer) {
  if (!providers_.help || byte < 0) return;
  const long begin = outermost(*area_, byte);
  const long line = area_->SendScintilla(QsciScintilla::SCI_LINEFROMPOSITION, byte);
  const long end = area_->SendScintilla(QsciScintilla::SCI_GETLINEENDPOSITION, line);
  const QPointer<SceneEditor> self(this);
  providers_.help(bytes_of(*area_, begin, end), byte - static_cast<int>(begin),
                  [self, answer = std::move(answer)](const EditorHelp& help) {
                    if (self) answer(help);
                  });
}

/// At a squiggle its problem, else the field's help.
void SceneEditor::show_tip(int byte) {
  if (byte < 0) return;
  const QPoint place = QCursor::pos();
  if (const QString text = marks_->at(byte); !text.isEmpty())
    return QToolTip::showText(place, text, area_);
  ask_help(byte, [this, place](const EditorHelp& help) {
    if (!help.tip.isEmpty() && place == QCursor::pos()) QToolTip::showText(place, help.tip, area_);
  });
}

void SceneEditor::show_help_line() {
  help_->setText(help_->fontMetrics().elidedText(help_line_, Qt::ElideRight, width() - 8));
  help_->setToolTip(help_line_);
}

void SceneEditor::go_to(int line, int column) {
  const int there = std::clamp(line, 1, area_->lines());
  const long begin = area_->SendScintilla(QsciScintilla::SCI_POSITIONFROMLINE, there - 1);
  const long end = area_->SendScintilla(QsciScintilla::SCI_GETLINEENDPOSITION, there - 1);
  area_->ensureLineVisible(there - 1);
  area_->SendScintilla(QsciScintilla::SCI_GOTOPOS,
                       static_cast<unsigned long>(std::min(begin + std::max(0, column - 1), end)));
  marks_->open_box(there);
  area_->setFocus();
}

QString SceneEditor::box() const {
  for (int line = 0; line < area_->lines(); ++line)
    if (const QString text = area_->annotation(line); !text.isEmpty()) return text;
  return {};
}

void SceneEditor::insert(const QString& text) {
  area_->SendScintilla(QsciScintilla::SCI_REPLACESEL, text.toUtf8().constData());
}

void SceneEditor::replace(int begin, int end, const QString& by) {
  const QByteArray bytes = by.toUtf8();
  const long caret = area_->SendScintilla(QsciScintilla::SCI_GETCURRENTPOS);
  area_->SendScintilla(QsciScintilla::SCI_SETTARGETRANGE, static_cast<unsigned long>(begin), end);
  area_->SendScintilla(QsciScintilla::SCI_REPLACETARGET, static_cast<unsigned long>(bytes.size()),
                       bytes.constData());
  if (caret >= begin && caret <= end)
    area_->SendScintilla(QsciScintilla::SCI_GOTOPOS,
                         static_cast<unsigned long>(begin + bytes.size()));
}

QString SceneEditor::selected() const { return area_->selectedText(); }

void SceneEditor::toggle_fold(int line) {
  // All lines before it must have their levels.
  area_->SendScintilla(QsciScintilla::SCI_COLOURISE, 0UL, -1L);
  area_->foldLine(line - 1);
}

bool SceneEditor::shows_line(int line) const {
  return area_->SendScintilla(QsciScintilla::SCI_GETLINEVISIBLE, line - 1) != 0;
}

QWidget& SceneEditor::viewport() { return *area_->viewport(); }

int SceneEditor::line() const {
  int line = 0, index = 0;
  area_->getCursorPosition(&line, &index);
  return line + 1;
}

int SceneEditor::column() const {
  const long at = area_->SendScintilla(QsciScintilla::SCI_GETCURRENTPOS);
  const long start = area_->SendScintilla(QsciScintilla::SCI_POSITIONFROMLINE, line() - 1);
  return static_cast<int>(at - start) + 1;
}

void SceneEditor::undo() { area_->undo(); }
void SceneEditor::redo() { area_->redo(); }
void SceneEditor::complete() { completion_->ask(); }
void SceneEditor::find(bool replace) { find_bar_->open(replace); }
void SceneEditor::add_bar(QWidget* bar) { rows_->insertWidget(0, bar); }

}  // namespace metamer::gui
