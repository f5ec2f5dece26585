#include "client/gui/editor/problem_marks.h"

#include <Qsci/qsciscintilla.h>
#include <Qsci/qscistyle.h>

#include <QPalette>
#include <QStringList>
#include <algorithm>

namespace metamer::gui {
namespace {

constexpr int squiggle = 0, mark = 1;
const QColor red(200, 40, 40);

QColor mixed(const QColor& a, const QColor& b, double share) {
  const auto mix = [share](double x, double y) { return static_cast<float>(x + share * (y - x)); };
  return QColor::fromRgbF(mix(a.redF(), b.redF()), mix(a.greenF(), b.greenF()),
                          mix(a.blueF(), b.blueF()));
}

}  // namespace

ProblemMarks::ProblemMarks(QsciScintilla& area) : area_(area) {
  area_.indicatorDefine(QsciScintilla::SquiggleIndicator, squiggle);
  area_.setIndicatorForegroundColor(red, squiggle);
  area_.markerDefine(QsciScintilla::Circle, mark);
  area_.setMarkerBackgroundColor(red, mark);
  area_.setMarkerForegroundColor(red, mark);
  area_.setAnnotationDisplay(QsciScintilla::AnnotationBoxed);
}

long ProblemMarks::begin_of(const EditorProblem& problem) const {
  const long line = area_.SendScintilla(QsciScintilla::SCI_POSITIONFROMLINE, problem.line - 1);
  const long end = area_.SendScintilla(QsciScintilla::SCI_GETLINEENDPOSITION, problem.line - 1);
  return std::min(line + std::max(0, problem.column - 1), end);
}

void ProblemMarks::show(const QList<EditorProblem>& problems) {
  close_box();
  problems_ = problems;
  area_.SendScintilla(QsciScintilla::SCI_SETINDICATORCURRENT, squiggle);
  area_.SendScintilla(QsciScintilla::SCI_INDICATORCLEARRANGE, 0UL, area_.length());
  area_.markerDeleteAll(mark);
  for (const EditorProblem& one : problems) {
    if (one.line < 1 || one.line > area_.lines()) continue;
    area_.markerAdd(one.line - 1, mark);
    const long begin = begin_of(one);
    const long end = area_.SendScintilla(QsciScintilla::SCI_WORDENDPOSITION,
                                         static_cast<unsigned long>(begin), 1L);
    area_.SendScintilla(QsciScintilla::SCI_INDICATORFILLRANGE, static_cast<unsigned long>(begin),
                        std::max(1L, end - begin));
  }
}

QString ProblemMarks::at(long byte) const {
  const auto at = static_cast<unsigned long>(byte);
  if (area_.SendScintilla(QsciScintilla::SCI_INDICATORVALUEAT, squiggle, byte) == 0) return {};
  const long begin = area_.SendScintilla(QsciScintilla::SCI_INDICATORSTART, squiggle, byte);
  const int line = static_cast<int>(area_.SendScintilla(QsciScintilla::SCI_LINEFROMPOSITION, at));
  QStringList here, on_line;
  for (const EditorProblem& one : problems_) {
    if (one.line != line + 1) continue;
    on_line << one.message;
    if (begin_of(one) == begin) here << one.message;
  }
  return (here.isEmpty() ? on_line : here).join(QLatin1Char('\n'));
}

void ProblemMarks::open_box(int line) {
  close_box();
  QStringList sentences;
  for (const EditorProblem& one : problems_)
    if (one.line == line && !sentences.contains(one.message)) sentences << one.message;
  if (sentences.isEmpty()) return;
  const QPalette colors = area_.palette();
  const QsciStyle style(-1, QStringLiteral("problem"), colors.color(QPalette::Text),
                        mixed(colors.color(QPalette::Base), red, 0.15), area_.font());
  area_.annotate(line - 1, sentences.join(QLatin1Char('\n')), style);
  open_ = true;
}

void ProblemMarks::close_box() {
  if (open_) area_.clearAnnotations();
  open_ = false;
}

}  // namespace metamer::gui
