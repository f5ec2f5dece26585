#include "client/gui/forms/settings_dialog.h"

#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QVBoxLayout>

#include "client/gui/forms/presets.h"

namespace metamer::gui {

SettingsDialog::SettingsDialog(const v1::Settings& settings, const v1::Capabilities& capabilities,
                               QWidget* parent)
    : QDialog(parent), form_(new SettingsForm), problems_(new QLabel) {
  setWindowTitle(tr("Settings"));
  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel(tr("Presets:")));
  for (const Preset& preset : presets()) {
    auto* button = new QPushButton(QCoreApplication::translate("Presets", preset.name));
    button->setToolTip(QCoreApplication::translate("Presets", preset.text));
    button->setAutoDefault(false);
    connect(button, &QPushButton::clicked, this, [this, preset] {
      v1::Settings changed = form_->settings();
      apply(preset, changed);
      form_->show_settings(changed);
      show_problems();
    });
    row->addWidget(button);
  }
  row->addStretch();

  auto* scroll = new QScrollArea;
  scroll->setWidget(form_);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setFocusPolicy(Qt::NoFocus);  // the fields in it have it

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  render_ = buttons->addButton(tr("Render"), QDialogButtonBox::AcceptRole);
  live_ = buttons->addButton(tr("Use for the live view"), QDialogButtonBox::ApplyRole);
  render_->setDefault(true);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(render_, &QPushButton::clicked, this, [this] {
    Q_EMIT render_asked();
    accept();
  });
  connect(live_, &QPushButton::clicked, this, &SettingsDialog::live_asked);

  problems_->setWordWrap(true);
  problems_->setTextFormat(Qt::PlainText);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(row);
  layout->addWidget(scroll, 1);
  layout->addWidget(problems_);
  layout->addWidget(buttons);
  connect(form_, &SettingsForm::changed, this, &SettingsDialog::show_problems);
  form_->set_capabilities(capabilities);
  form_->show_settings(settings);
  show_problems();
  resize(480, 680);
}

void SettingsDialog::show_problems() {
  const QStringList problems = form_->problems();
  problems_->setText(problems.join(QLatin1Char('\n')));
  problems_->setVisible(!problems.isEmpty());
  render_->setEnabled(problems.isEmpty());
  live_->setEnabled(problems.isEmpty());
}

}  // namespace metamer::gui
