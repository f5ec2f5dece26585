#include "client/gui/spectra/choice_boxes.h"

#include <QCompleter>
#include <QFileDialog>
#include <QLineEdit>

#include "client/tools/scene/words.h"
#include "common/spectral/cie.h"

namespace metamer::gui {
namespace {

QString observer_text(const QString& word) {
  if (word == QStringLiteral("cie-1931-2deg")) return ObserverBox::tr("2° (CIE 1931)");
  if (word == QStringLiteral("cie-1964-10deg")) return ObserverBox::tr("10° (CIE 1964)");
  return word;
}

}  // namespace

ObserverBox::ObserverBox(QWidget* parent) : QComboBox(parent) {
  setAccessibleName(tr("Observer"));
  for (const std::string& one : client::words_of(*v1::Observer_descriptor())) {
    const QString word = QString::fromStdString(one);
    addItem(observer_text(word), word);
  }
  addItem(tr("Another, of a file…"));
  last_ = word();
  connect(this, &QComboBox::activated, this, [this] {
    if (!currentData().isValid()) return choose_file();
    last_ = word();
    Q_EMIT chosen(last_);
  });
}

void ObserverBox::choose_file() {
  set_word(last_);
  const QString file = QFileDialog::getOpenFileName(this, tr("Colour matching functions"));
  if (file.isEmpty()) return;
  set_word(file);
  Q_EMIT chosen(file);
}

void ObserverBox::set_word(const QString& word) {
  if (findData(word) < 0) insertItem(count() - 1, observer_text(word), word);
  setCurrentIndex(findData(word));
  last_ = word;
}

SpectrumBox::SpectrumBox(const QStringList& names, const QString& word, QWidget* parent)
    : QComboBox(parent), last_(word) {
  setEditable(true);
  setInsertPolicy(QComboBox::NoInsert);
  addItems(names);
  setMinimumContentsLength(8);
  completer()->setCaseSensitivity(Qt::CaseSensitive);
  setCurrentText(word);
  const auto tell = [this] {
    if (this->word().isEmpty() || this->word() == last_) return;
    last_ = this->word();
    Q_EMIT chosen(last_);
  };
  connect(this, &QComboBox::activated, this, tell);
  connect(lineEdit(), &QLineEdit::editingFinished, this, tell);
}

QStringList illuminant_names() {
  QStringList names;
  for (const std::string& one : cie::illuminant_names()) names << QString::fromStdString(one);
  return names;
}

QStringList test_color_names() {
  QStringList names;
  for (const std::string& one : cie::test_color_names()) names << QString::fromStdString(one);
  return names;
}

}  // namespace metamer::gui
