#pragma once

#include <QWidget>
#include <functional>

class QHBoxLayout;

namespace metamer::gui {

/// A sentence above a text, with buttons that answer it; each closes it.
class MessageBar : public QWidget {
  Q_OBJECT
 public:
  explicit MessageBar(const QString& sentence, QWidget* parent = nullptr);

  void add_answer(const QString& text, std::function<void()> done);

 private:
  QHBoxLayout* row_;
};

}  // namespace metamer::gui
