#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>

#include "client/gui/forms/settings_form.h"

namespace metamer::gui {

/// The settings of a render, or of the live view: a form with presets.
class SettingsDialog : public QDialog {
  Q_OBJECT
 public:
  SettingsDialog(const v1::Settings& settings, const v1::Capabilities& capabilities,
                 QWidget* parent = nullptr);

  SettingsForm& form() { return *form_; }
  v1::Settings settings() const { return form_->settings(); }

 Q_SIGNALS:
  void render_asked();
  void live_asked();  ///< The live view is to use them.

 private:
  void show_problems();

  SettingsForm* form_;
  QLabel* problems_;
  QPushButton *render_, *live_;
};

}  // namespace metamer::gui
