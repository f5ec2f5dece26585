#include "client/gui/forms/schema_form.h"

#include <QGroupBox>
#include <QLabel>
#include <QVBoxLayout>
#include <utility>

namespace metamer::gui {
namespace {

namespace pb = google::protobuf;

/// Whether there is anything that a message says: a choice without values is something.
bool says_something(const pb::Message& message) {
  std::vector<const pb::FieldDescriptor*> set;
  message.GetReflection()->ListFields(message, &set);
  return !set.empty();
}

}  // namespace

SchemaForm::SchemaForm(const pb::Descriptor& type, std::string path, const Facts& facts,
                       const Wanted& wanted, QWidget* parent)
    : QWidget(parent),
      path_(std::move(path)),
      facts_(facts),
      wanted_(wanted),
      layout_(new QFormLayout(this)) {
  if (!path_.empty()) layout_->setContentsMargins(0, 0, 0, 0);
  for (int i = 0; i < type.field_count(); ++i) {
    const Field& field = *type.field(i);
    const pb::OneofDescriptor* oneof = field.real_containing_oneof();
    if (oneof == nullptr)
      add_field(field);
    else if (oneof->field(0) == &field)
      add_choice(*oneof);
  }
}

std::string SchemaForm::inner(const std::string& name) const {
  return path_.empty() ? name : path_ + '.' + name;
}

SchemaForm::Row SchemaForm::make_row(const Field& field) {
  const std::string path = inner(field.name());
  Row row{.field = &field, .editor = {}};
  if (field.message_type() == nullptr || field.is_repeated()) {
    row.editor = make_field_editor(field, facts_(path),
                                   [this, path] { Q_EMIT changed(QString::fromStdString(path)); });
    if (row.editor.widget != nullptr) editors_[path] = row.editor.widget;
    return row;
  }
  row.form = new SchemaForm(*field.message_type(), path, facts_, wanted_);
  row.form->setToolTip(facts_(path).help);
  connect(row.form, &SchemaForm::changed, this, &SchemaForm::changed);
  editors_[path] = row.form;
  editors_.insert(row.form->editors_.begin(), row.form->editors_.end());
  return row;
}

void SchemaForm::add_field(const Field& field) {
  if (!wanted_(inner(field.name()))) return;
  const Row row = make_row(field);
  if (row.widget() == nullptr) return;
  rows_.push_back(row);
  if (row.form == nullptr) return layout_->addRow(field_label(field), row.widget());
  auto* box = new QGroupBox(field_label(field));
  auto* inside = new QVBoxLayout(box);
  inside->addWidget(row.form);
  layout_->addRow(box);
}

void SchemaForm::add_choice(const pb::OneofDescriptor& oneof) {
  Choice choice{.oneof = &oneof, .list = new QComboBox, .rows = {}};
  const QString name =
      QString::fromStdString(oneof.name()).replace(QLatin1Char('_'), QLatin1Char(' '));
  choice.list->setAccessibleName(name);
  choice.list->setToolTip(facts_(path_).help);
  choice.list->addItem(tr("left out"), 0);
  layout_->addRow(name, choice.list);
  for (int i = 0; i < oneof.field_count(); ++i) {
    const Field& field = *oneof.field(i);
    const Row row = make_row(field);
    if (row.widget() == nullptr) continue;
    choice.list->addItem(field_label(field), field.number());
    choice.list->setItemData(choice.list->count() - 1, facts_(inner(field.name())).help,
                             Qt::ToolTipRole);
    layout_->addRow(row.form == nullptr ? field_label(field) : QString(), row.widget());
    choice.rows.push_back(row);
  }
  const std::string path = inner(oneof.name());
  editors_.emplace(path, choice.list);
  connect(choice.list, &QComboBox::activated, this, [this, path, at = choices_.size()] {
    show_chosen(choices_[at]);
    Q_EMIT changed(QString::fromStdString(path));
  });
  choices_.push_back(std::move(choice));
  show_chosen(choices_.back());
}

void SchemaForm::show_chosen(const Choice& choice) {
  const int chosen = choice.list->currentData().toInt();
  for (const Row& row : choice.rows) {
    const bool empty = row.form != nullptr && row.form->editors_.empty();
    layout_->setRowVisible(row.widget(), row.field->number() == chosen && !empty);
  }
}

void SchemaForm::show_row(const Row& row, const pb::Message& message) {
  if (row.form == nullptr) return row.editor.show(message);
  row.form->show_message(message.GetReflection()->GetMessage(message, row.field));
}

void SchemaForm::store_row(const Row& row, pb::Message& message) {
  if (row.form == nullptr) return row.editor.store(message);
  row.form->store(*message.GetReflection()->MutableMessage(&message, row.field));
}

void SchemaForm::show_message(const pb::Message& message) {
  for (const Row& row : rows_) show_row(row, message);
  for (const Choice& choice : choices_) {
    const Field* set = message.GetReflection()->GetOneofFieldDescriptor(message, choice.oneof);
    choice.list->setCurrentIndex(
        std::max(0, choice.list->findData(set == nullptr ? 0 : set->number())));
    for (const Row& row : choice.rows) show_row(row, message);
    show_chosen(choice);
  }
}

void SchemaForm::store(pb::Message& message) const {
  const pb::Reflection& values = *message.GetReflection();
  for (const Row& row : rows_) {
    store_row(row, message);
    if (row.form != nullptr && !says_something(values.GetMessage(message, row.field)))
      values.ClearField(&message, row.field);
  }
  for (const Choice& choice : choices_) {
    values.ClearOneof(&message, choice.oneof);
    const int chosen = choice.list->currentData().toInt();
    for (const Row& row : choice.rows)
      if (row.field->number() == chosen) store_row(row, message);
  }
}

QWidget* SchemaForm::editor(const std::string& path) const {
  const auto found = editors_.find(path);
  return found == editors_.end() ? nullptr : found->second;
}

std::vector<std::string> SchemaForm::paths() const {
  std::vector<std::string> paths;
  for (const auto& [path, widget] : editors_) paths.push_back(path);
  return paths;
}

}  // namespace metamer::gui
