#pragma once

#include <QString>
#include <QTimer>
#include <QWidget>
#include <memory>

#include "client/gui/editor/problem_marks.h"
#include "client/gui/editor/providers.h"

class QLabel;
class QsciScintilla;
class QVBoxLayout;

namespace metamer::gui {

class Completion;
class FindBar;
class SceneLexer;

/// The text of a scene: highlighted, with problems at their places, completion, and help on what
/// stands at the caret and under the mouse. Or another text, plain.
class SceneEditor : public QWidget {
  Q_OBJECT
 public:
  enum class Kind { scene, plain };

  explicit SceneEditor(QWidget* parent = nullptr, Kind kind = Kind::scene);
  ~SceneEditor() override;

  void set_providers(EditorProviders providers);

  QString text() const;
  /// Replaces all; what was is no longer to be undone.
  void set_text(const QString& text);
  /// The same as one step to undo, of the part alone that differs: caret and folds stay elsewhere.
  void change_text(const QString& text);
  void show_problems(const QList<EditorProblem>& problems);
  /// Puts the caret there and, where problems are on the line, opens the box that tells them.
  void go_to(int line, int column);
  /// The sentences of the box that is open.
  QString box() const;
  /// Puts a text in the place of the selection, or at the caret.
  void insert(const QString& text);
  /// The same of bytes of the text, as one step to undo. A caret that was in them stands behind it.
  void replace(int begin, int end, const QString& by);
  QString selected() const;
  void toggle_fold(int line);
  bool shows_line(int line) const;  ///< It is in no message that is folded.
  int line() const;                 ///< Of the caret, from 1.
  int column() const;               ///< Of the caret, in bytes, from 1.

  void undo();
  void redo();
  void complete();
  void find(bool replace);
  /// Something that is to be said of the text, above it.
  void add_bar(QWidget* bar);

  QsciScintilla& area() { return *area_; }
  QWidget& viewport();  ///< What gets the text's keys and clicks.
  Completion& completion() { return *completion_; }
  FindBar& find_bar() { return *find_bar_; }
  QString help_line() const { return help_line_; }

 Q_SIGNALS:
  void text_changed();
  void caret_moved(int line, int column);

 protected:
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void set_up_area();
  void set_colors();
  void show_tip(int byte);
  void ask_help(int byte, std::function<void(const EditorHelp&)> answer);
  void show_help_line();

  QsciScintilla* area_;
  SceneLexer* lexer_ = nullptr;  ///< Null of a plain text.
  QVBoxLayout* rows_;
  QLabel* help_;
  QString help_line_;
  QTimer help_timer_;
  EditorProviders providers_;
  std::unique_ptr<ProblemMarks> marks_;
  Completion* completion_;
  FindBar* find_bar_;
};

}  // namespace metamer::gui
