#pragma once

#include <QLabel>
#include <QPointer>
#include <QTableView>
#include <QWidget>

#include "client/gui/document/document.h"
#include "client/gui/problems/problem_table.h"

namespace metamer::gui {

class MainWindow;

/// What is wrong with the scene that is in front, or was last; a click or Enter goes there.
class ProblemsDock : public QWidget {
  Q_OBJECT
 public:
  explicit ProblemsDock(MainWindow& window);

  QTableView& view() { return *view_; }
  ProblemTable& table() { return *table_; }

  /// Goes to the problem after the caret, or before it.
  void step(bool backwards);
  void go_to(int row);
  /// Mends a problem in the text, as one step to undo, or asks for its file.
  void fix(int row);
  /// The one at the caret or, where the list has the focus, the one chosen there.
  void fix_here();

 Q_SIGNALS:
  void counted(int problems);

 private:
  void follow();
  void show_problems();
  void mark(int tab);
  void put(const Problem& problem, const QString& by);

  MainWindow& window_;
  QPointer<Document> document_;
  ProblemTable* table_;
  QTableView* view_;
};

}  // namespace metamer::gui
