#pragma once

#include <Qsci/qscilexercustom.h>

#include <QPalette>

namespace metamer::gui {

/// Colours a scene's text, and says where it folds. Only what is to be seen is asked for, from
/// where the text was changed.
class SceneLexer : public QsciLexerCustom {
  Q_OBJECT
 public:
  explicit SceneLexer(QObject* parent);

  /// On the text's ground, light or dark.
  void set_colors(const QPalette& palette);

  const char* language() const override { return "Scene"; }
  const char* wordCharacters() const override;
  QString description(int style) const override;
  const char* blockStart(int* style) const override;
  const char* blockEnd(int* style) const override;
  void styleText(int start, int end) override;

 private:
  void fold(int line, const QByteArray& text, const std::string& styles);
};

}  // namespace metamer::gui
