#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QWidget>
#include <functional>

#include "client/gui/editor/search.h"

class QPushButton;

namespace metamer::gui {

/// Find and replace, above the text that it is for; Escape closes it.
class FindBar : public QWidget {
  Q_OBJECT
 public:
  explicit FindBar(QsciScintilla* area, QWidget* parent = nullptr);

  /// Shows it, with what is selected on one line as what is looked for.
  void open(bool replace);
  void close_bar();
  SearchFor wanted() const;

  QLineEdit& what() { return *what_; }
  QLineEdit& by() { return *by_; }

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QPushButton* add_button(QLayout* row, const QString& text, std::function<void()> done);
  QCheckBox* add_option(QLayout* row, const QString& text);
  void step(bool backwards);
  void follow();
  void tell(bool found);

  QsciScintilla* area_;
  TextSearch search_;
  QLineEdit *what_, *by_;
  QWidget* replacing_;
  QCheckBox *match_case_, *whole_words_, *pattern_;
  QLabel* told_;
};

}  // namespace metamer::gui
