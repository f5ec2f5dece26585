#include "client/gui/editor/completion.h"

#include <Qsci/qsciscintilla.h>

#include <QPointer>
#include <utility>

namespace metamer::gui {
namespace {

/// Words with this sign, or of several lines, can't be listed.
constexpr char separator = '\n';
/// A list comes by itself once so much of a name was typed.
constexpr int typed_before = 2;

bool starts_like(const QString& word, const QString& typed) {
  return word.startsWith(typed, Qt::CaseInsensitive);
}

}  // namespace

Completion::Completion(QsciScintilla* area) : QObject(area), area_(area) {
  area_->SendScintilla(QsciScintilla::SCI_AUTOCSETSEPARATOR, static_cast<long>(separator));
  area_->SendScintilla(QsciScintilla::SCI_AUTOCSETIGNORECASE, 1L);
  area_->SendScintilla(QsciScintilla::SCI_AUTOCSETORDER, QsciScintilla::SC_ORDER_PERFORMSORT);
  area_->SendScintilla(QsciScintilla::SCI_AUTOCSETMAXHEIGHT, 12L);
  // The type of an item, which none has, would begin at a "?".
  area_->SendScintilla(QsciScintilla::SCI_AUTOCSETTYPESEPARATOR, 1L);
  connect(area_, qOverload<const char*, int, int, int>(&QsciScintilla::SCN_AUTOCSELECTION), this,
          [this](const char* word, int, int, int) { take(word); });
  connect(area_, &QsciScintilla::SCN_AUTOCCANCELLED, this, [this] { shown_.clear(); });
  connect(area_, &QsciScintilla::SCN_CHARADDED, this, [this](int sign) {
    const bool letter = sign < 128 && (std::isalnum(sign) != 0 || sign == '_');
    if (letter && area_->SendScintilla(QsciScintilla::SCI_AUTOCACTIVE) == 0) request(false);
  });
}

/// The newest question counts, and only if the caret is where it was.
void Completion::request(bool wanted) {
  if (!provider_) return;
  const long at = area_->SendScintilla(QsciScintilla::SCI_GETCURRENTPOS);
  const quint64 number = ++asked_;
  const QPointer<Completion> self(this);
  provider_(area_->text().toUtf8(), static_cast<int>(at),
            [self, number, at, wanted](const EditorWords& found) {
              if (!self || self->asked_ != number) return;
              if (self->area_->SendScintilla(QsciScintilla::SCI_GETCURRENTPOS) == at)
                self->show(found, wanted);
            });
}

void Completion::show(const EditorWords& found, bool wanted) {
  const long at = area_->SendScintilla(QsciScintilla::SCI_GETCURRENTPOS);
  const QString typed =
      QString::fromUtf8(area_->bytes(found.begin, static_cast<int>(at)).constData());
  if (!wanted && (typed.size() < typed_before || found.end > at)) return;
  QStringList words;
  for (const QString& word : found.words)
    if (starts_like(word, typed) && !word.contains(QLatin1Char(separator))) words << word;
  if (words.isEmpty()) return;
  if (words.size() == 1 && wanted) return put(words.front().toUtf8(), found.begin, found.end);
  if (words.size() == 1 && words.front().trimmed() == typed) return;
  begin_ = found.begin;
  rest_ = found.end - at;
  shown_ = words;
  area_->SendScintilla(QsciScintilla::SCI_AUTOCSHOW, static_cast<unsigned long>(at - begin_),
                       words.join(QLatin1Char(separator)).toUtf8().constData());
}

void Completion::take(const QByteArray& word) {
  area_->SendScintilla(QsciScintilla::SCI_AUTOCCANCEL);
  shown_.clear();
  const long at = area_->SendScintilla(QsciScintilla::SCI_GETCURRENTPOS);
  put(word, begin_, at + rest_);
}

void Completion::put(const QByteArray& word, long begin, long end) {
  area_->SendScintilla(QsciScintilla::SCI_SETTARGETRANGE, begin, end);
  area_->SendScintilla(QsciScintilla::SCI_REPLACETARGET, static_cast<unsigned long>(word.size()),
                       word.constData());
  area_->SendScintilla(QsciScintilla::SCI_GOTOPOS, static_cast<unsigned long>(begin + word.size()));
}

}  // namespace metamer::gui
