#include "client/gui/forms/field_editors.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QLineEdit>
#include <QRegularExpression>
#include <QRegularExpressionValidator>
#include <QSpinBox>

#include "client/tools/scene/words.h"

namespace metamer::gui {
namespace {

namespace pb = google::protobuf;
using Holder = pb::Message;

QString form_words(const char* text) { return QCoreApplication::translate("Forms", text); }

QString left_out_text(const FieldFacts& facts) {
  return facts.left_out.isEmpty() ? form_words("left out")
                                  : form_words("left out: %1").arg(facts.left_out);
}

FieldEditor choice_editor(const pb::FieldDescriptor& field, const FieldFacts& facts,
                          const std::function<void()>& changed) {
  auto* box = new QComboBox;
  constexpr int none = -1;
  if (field.has_presence() && field.real_containing_oneof() == nullptr)
    box->addItem(left_out_text(facts), none);
  for (int i = 0; i < field.enum_type()->value_count(); ++i) {
    const pb::EnumValueDescriptor& value = *field.enum_type()->value(i);
    box->addItem(QString::fromStdString(client::word_of(value)), value.number());
  }
  QObject::connect(box, &QComboBox::activated, box, changed);
  return {.widget = box,
          .show =
              [box, &field](const Holder& holder) {
                const pb::Reflection& values = *holder.GetReflection();
                const bool is_set = !field.has_presence() || values.HasField(holder, &field);
                const int at = box->findData(is_set ? values.GetEnumValue(holder, &field) : none);
                box->setCurrentIndex(std::max(0, at));
              },
          .store =
              [box, &field](Holder& holder) {
                const int value = box->currentData().toInt();
                if (value == none)
                  holder.GetReflection()->ClearField(&holder, &field);
                else
                  holder.GetReflection()->SetEnumValue(&holder, &field, value);
              }};
}

FieldEditor flag_editor(const pb::FieldDescriptor& field, const std::function<void()>& changed) {
  auto* box = new QCheckBox;
  QObject::connect(box, &QCheckBox::clicked, box, changed);
  return {.widget = box,
          .show =
              [box, &field](const Holder& holder) {
                box->setChecked(holder.GetReflection()->GetBool(holder, &field));
              },
          .store =
              [box, &field](Holder& holder) {
                holder.GetReflection()->SetBool(&holder, &field, box->isChecked());
              }};
}

/// The number below the range stands for a field that is left out.
FieldEditor count_editor(const pb::FieldDescriptor& field, const FieldFacts& facts,
                         const std::function<void()>& changed) {
  auto* box = new QSpinBox;
  const NumberRange range = facts.range.value_or(NumberRange{0, 1'000'000'000});
  const bool optional = field.has_presence();
  const int least = static_cast<int>(range.least) - (optional ? 1 : 0);
  box->setRange(least, static_cast<int>(range.greatest));
  if (optional) box->setSpecialValueText(left_out_text(facts));
  if (field.name() == "tile_size") box->setSingleStep(8);
  QObject::connect(box, &QSpinBox::valueChanged, box, changed);
  return {.widget = box,
          .show =
              [box, &field, optional, least](const Holder& holder) {
                const pb::Reflection& values = *holder.GetReflection();
                const bool is_set = !optional || values.HasField(holder, &field);
                const QSignalBlocker quiet(box);
                box->setValue(is_set ? static_cast<int>(values.GetUInt32(holder, &field)) : least);
              },
          .store =
              [box, &field, optional, least](Holder& holder) {
                if (optional && box->value() == least)
                  holder.GetReflection()->ClearField(&holder, &field);
                else
                  holder.GetReflection()->SetUInt32(&holder, &field,
                                                    static_cast<std::uint32_t>(box->value()));
              }};
}

QLineEdit* number_line(const char* pattern, const FieldFacts& facts,
                       const std::function<void()>& changed) {
  auto* line = new QLineEdit;
  line->setValidator(
      new QRegularExpressionValidator(QRegularExpression(QString::fromLatin1(pattern)), line));
  line->setPlaceholderText(left_out_text(facts));
  QObject::connect(line, &QLineEdit::textEdited, line, changed);
  return line;
}

FieldEditor number_editor(const pb::FieldDescriptor& field, const FieldFacts& facts,
                          const std::function<void()>& changed) {
  QLineEdit* line = number_line(R"([-+0-9.eE]*)", facts, changed);
  return {.widget = line,
          .show =
              [line, &field](const Holder& holder) {
                const pb::Reflection& values = *holder.GetReflection();
                line->setText(values.HasField(holder, &field)
                                  ? QString::number(values.GetDouble(holder, &field), 'g', 10)
                                  : QString());
              },
          .store =
              [line, &field](Holder& holder) {
                bool whole = false;
                const double value = line->text().toDouble(&whole);
                if (whole)
                  holder.GetReflection()->SetDouble(&holder, &field, value);
                else
                  holder.GetReflection()->ClearField(&holder, &field);
              }};
}

FieldEditor numbers_editor(const pb::FieldDescriptor& field, const FieldFacts& facts,
                           const std::function<void()>& changed) {
  QLineEdit* line = number_line(R"([-+0-9.eE, ]*)", facts, changed);
  return {.widget = line,
          .show =
              [line, &field](const Holder& holder) {
                QStringList texts;
                for (int i = 0; i < holder.GetReflection()->FieldSize(holder, &field); ++i)
                  texts << QString::number(
                      holder.GetReflection()->GetRepeatedDouble(holder, &field, i), 'g', 10);
                line->setText(texts.join(QStringLiteral(", ")));
              },
          .store =
              [line, &field](Holder& holder) {
                static const QRegularExpression between(QStringLiteral("[, ]+"));
                holder.GetReflection()->ClearField(&holder, &field);
                for (const QString& text : line->text().split(between, Qt::SkipEmptyParts))
                  holder.GetReflection()->AddDouble(&holder, &field, text.toDouble());
              }};
}

FieldEditor text_editor(const pb::FieldDescriptor& field, const FieldFacts& facts,
                        const std::function<void()>& changed) {
  auto* line = new QLineEdit;
  line->setPlaceholderText(left_out_text(facts));
  QObject::connect(line, &QLineEdit::textEdited, line, changed);
  return {.widget = line,
          .show =
              [line, &field](const Holder& holder) {
                line->setText(
                    QString::fromStdString(holder.GetReflection()->GetString(holder, &field)));
              },
          .store =
              [line, &field](Holder& holder) {
                holder.GetReflection()->SetString(&holder, &field, line->text().toStdString());
              }};
}

FieldEditor editor_of_kind(const pb::FieldDescriptor& field, const FieldFacts& facts,
                           const std::function<void()>& changed) {
  if (field.is_repeated()) return numbers_editor(field, facts, changed);
  switch (field.cpp_type()) {
    case pb::FieldDescriptor::CPPTYPE_ENUM:
      return choice_editor(field, facts, changed);
    case pb::FieldDescriptor::CPPTYPE_BOOL:
      return flag_editor(field, changed);
    case pb::FieldDescriptor::CPPTYPE_UINT32:
      return count_editor(field, facts, changed);
    case pb::FieldDescriptor::CPPTYPE_DOUBLE:
      return number_editor(field, facts, changed);
    case pb::FieldDescriptor::CPPTYPE_STRING:
      return text_editor(field, facts, changed);
    case pb::FieldDescriptor::CPPTYPE_INT32:
    case pb::FieldDescriptor::CPPTYPE_INT64:
    case pb::FieldDescriptor::CPPTYPE_UINT64:
    case pb::FieldDescriptor::CPPTYPE_FLOAT:
    case pb::FieldDescriptor::CPPTYPE_MESSAGE:
      break;
  }
  return {};
}

}  // namespace

QString field_label(const pb::FieldDescriptor& field) {
  return QString::fromStdString(field.name()).replace(QLatin1Char('_'), QLatin1Char(' '));
}

FieldEditor make_field_editor(const pb::FieldDescriptor& field, const FieldFacts& facts,
                              const std::function<void()>& changed) {
  FieldEditor editor = editor_of_kind(field, facts, changed);
  // A kind that no form has yet: the law over all fields finds it.
  if (editor.widget == nullptr) return editor;
  editor.widget->setAccessibleName(field_label(field));
  editor.widget->setToolTip(facts.help);
  return editor;
}

}  // namespace metamer::gui
