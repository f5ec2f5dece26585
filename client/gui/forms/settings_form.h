#pragma once

#include <QWidget>

#include "client/gui/forms/schema_form.h"
#include "metamer/v1/scene.pb.h"
#include "metamer/v1/session.pb.h"

namespace metamer::gui {

/// A form of a scene's settings. What the server's backends and methods lack cannot be chosen, and
/// says why.
class SettingsForm : public QWidget {
  Q_OBJECT
 public:
  explicit SettingsForm(QWidget* parent = nullptr);

  /// Of the server; by default everything can be chosen.
  void set_capabilities(const v1::Capabilities& capabilities);
  void show_settings(const v1::Settings& settings);
  v1::Settings settings() const;
  /// What is wrong with them, a sentence each, by check_settings; empty: nothing.
  QStringList problems() const;

  const SchemaForm& form() const { return *form_; }

 Q_SIGNALS:
  void changed();  ///< By hand.

 private:
  void take_change(const QString& path);
  void update_choices();

  SchemaForm* form_;
  v1::Settings shown_;  ///< Holds what has no row.
  v1::Capabilities capabilities_;
};

/// Whether a field of Settings has a row of its own: all but method.auto, the older name of goal.
bool has_settings_row(const std::string& path);

}  // namespace metamer::gui
