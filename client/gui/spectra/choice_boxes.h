#pragma once

#include <QComboBox>

namespace metamer::gui {

/// The CIE's observers, and any file of colour matching functions.
class ObserverBox : public QComboBox {
  Q_OBJECT
 public:
  explicit ObserverBox(QWidget* parent = nullptr);
  /// As the command line has it: "cie-1931-2deg", or a file.
  QString word() const { return currentData().toString(); }
  void set_word(const QString& word);

 Q_SIGNALS:
  void chosen(const QString& word);

 private:
  void choose_file();
  QString last_;
};

/// A spectrum by its word: one of the names, or any other as parse_spectrum_word takes it.
class SpectrumBox : public QComboBox {
  Q_OBJECT
 public:
  SpectrumBox(const QStringList& names, const QString& word, QWidget* parent = nullptr);
  QString word() const { return currentText().trimmed(); }

 Q_SIGNALS:
  void chosen(const QString& word);

 private:
  QString last_;
};

/// "A" … "F12", and "TCS01" … "TCS15".
QStringList illuminant_names();
QStringList test_color_names();

}  // namespace metamer::gui
