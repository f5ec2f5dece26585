#include "client/gui/forms/settings_form.h"

#include <QComboBox>
#include <QStandardItemModel>
#include <QVBoxLayout>
#include <algorithm>

#include "common/scene/feature_sets.h"
#include "common/scene/parts.h"
#include "common/scene/settings.h"

namespace metamer::gui {
namespace {

bool names(const google::protobuf::RepeatedPtrField<std::string>& list, const std::string& name) {
  return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
}

/// Lets an item of a list be chosen, or says why it cannot.
void allow(QComboBox& list, int item, const QString& why_not) {
  auto* model = qobject_cast<QStandardItemModel*>(list.model());
  if (model == nullptr || item < 0) return;
  model->item(item)->setEnabled(why_not.isEmpty());
  if (!why_not.isEmpty()) model->item(item)->setToolTip(why_not);
}

/// What of the settings only backends with a feature have: a field, and of a list the value that
/// needs nothing.
struct NeedsFeature {
  const char* path;
  Feature feature;
};
constexpr NeedsFeature needs_feature[] = {
    {"depth", Feature::mirrors},
    {"cutoff", Feature::transmission},
    {"shading", Feature::corner_shading},
    {"light_samples", Feature::area_lights},
    {"bounces", Feature::inter_reflection},
    {"bounce_samples", Feature::inter_reflection},
    {"method.point.multi_pass", Feature::multi_pass},
};

}  // namespace

bool has_settings_row(const std::string& path) { return path != "method.auto"; }

SettingsForm::SettingsForm(QWidget* parent)
    : QWidget(parent),
      form_(new SchemaForm(*v1::Settings::descriptor(), "", settings_facts, has_settings_row)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(form_);
  connect(form_, &SchemaForm::changed, this, &SettingsForm::take_change);
}

void SettingsForm::set_capabilities(const v1::Capabilities& capabilities) {
  capabilities_ = capabilities;
  update_choices();
}

void SettingsForm::show_settings(const v1::Settings& settings) {
  shown_ = settings;
  take_older_goal(shown_);
  // What a goal without a number means.
  if (shown_.has_goal()) *shown_.mutable_goal() = with_defaults(shown_).goal();
  form_->show_message(shown_);
  update_choices();
}

v1::Settings SettingsForm::settings() const {
  v1::Settings settings = shown_;
  form_->store(settings);
  return settings;
}

QStringList SettingsForm::problems() const {
  Findings findings;
  check_settings(settings(), "settings", findings);
  QStringList texts;
  for (const Problem& problem : findings.take()) texts << QString::fromStdString(problem.message);
  return texts;
}

/// A method and a goal exclude each other: the one that is chosen clears the other.
void SettingsForm::take_change(const QString& path) {
  v1::Settings settings = this->settings();
  if (path.startsWith(QStringLiteral("method")) &&
      settings.method().method_case() != v1::Method::METHOD_NOT_SET && settings.has_goal()) {
    settings.clear_goal();
    show_settings(settings);
  } else if (path.startsWith(QStringLiteral("goal")) && settings.has_goal() &&
             settings.has_method()) {
    settings.clear_method();
    show_settings(settings);
  }
  update_choices();
  Q_EMIT changed();
}

void SettingsForm::update_choices() {
  const v1::Backend backend = settings().backend();
  const QString backend_name = QString::fromStdString(name_of(backend)).toUpper();
  if (auto* list = qobject_cast<QComboBox*>(form_->editor("backend")))
    for (int i = 0; i < list->count(); ++i) {
      const auto one = static_cast<v1::Backend>(list->itemData(i).toInt());
      allow(*list, i,
            names(capabilities_.backend(), name_of(one))
                ? QString()
                : tr("this server has no %1 backend")
                      .arg(QString::fromStdString(name_of(one)).toUpper()));
    }
  if (auto* list = qobject_cast<QComboBox*>(form_->editor("method.method")))
    for (int i = 1; i < list->count(); ++i)
      allow(*list, i,
            names(capabilities_.method(), list->itemText(i).toStdString())
                ? QString()
                : tr("this server does not have the method %1").arg(list->itemText(i)));
  for (const auto& [path, feature] : needs_feature) {
    QWidget* editor = form_->editor(path);
    if (editor == nullptr) continue;
    const bool there = has_feature(capabilities_, backend, feature);
    editor->setEnabled(there);
    editor->setToolTip(there ? settings_facts(path).help
                             : tr("the %1 backend does not have it (%2)")
                                   .arg(backend_name, QString::fromLatin1(name_of(feature))));
  }
}

}  // namespace metamer::gui
