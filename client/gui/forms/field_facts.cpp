#include "client/gui/forms/field_facts.h"

#include <algorithm>
#include <map>

#include "client/gui/document/schema_texts.h"
#include "common/scene/limits.h"
#include "common/scene/methods.h"
#include "common/scene/settings.h"

namespace metamer::gui {
namespace {

namespace pb = google::protobuf;

/// The least number above 0 that is worth typing.
constexpr double above_nothing = 1e-6;

const std::map<std::string, NumberRange>& ranges() {
  static const std::map<std::string, NumberRange> table{
      {"width", {1, limits::max_side}},
      {"height", {1, limits::max_side}},
      {"spp", {1, limits::max_spp}},
      {"depth", {0, limits::max_depth}},
      {"cutoff", {limits::min_cutoff, 1}},
      {"light_samples", {1, limits::max_light_samples}},
      {"bounces", {0, limits::max_bounces}},
      {"bounce_samples", {1, limits::max_bounce_samples}},
      {"threads", {0, limits::max_threads}},
      {"tile_size", {8, limits::max_tile}},
      {"method.point.from", {limits::min_wavelength, limits::max_wavelength}},
      {"method.point.to", {limits::min_wavelength, limits::max_wavelength}},
      {"method.point.step", {above_nothing, limits::max_wavelength}},
      {"method.point.fitted", {1, limits::max_fitted}},
      {"method.linear.bases", {1, limits::max_bases}},
      {"goal.tolerance", {above_nothing, limits::max_coordinate}},
      {"goal.deadline", {above_nothing, limits::max_coordinate}},
      {"development.primaries.gamma", {above_nothing, limits::max_coordinate}},
      {"development.white_luminance", {above_nothing, limits::max_luminance}},
  };
  return table;
}

QString number_of(const pb::Message& message, const pb::FieldDescriptor& field) {
  const pb::Reflection& values = *message.GetReflection();
  if (field.cpp_type() == pb::FieldDescriptor::CPPTYPE_UINT32)
    return QString::number(values.GetUInt32(message, &field));
  if (field.cpp_type() == pb::FieldDescriptor::CPPTYPE_DOUBLE)
    return QString::number(values.GetDouble(message, &field), 'g', 6);
  return {};
}

/// Of each number that with_defaults fills in, what it is.
void collect_defaults(const pb::Message& message, const std::string& path,
                      std::map<std::string, QString>& defaults) {
  std::vector<const pb::FieldDescriptor*> set;
  message.GetReflection()->ListFields(message, &set);
  for (const pb::FieldDescriptor* field : set) {
    if (field->is_repeated()) continue;
    const std::string inner = path.empty() ? field->name() : path + '.' + field->name();
    if (field->message_type() != nullptr)
      collect_defaults(message.GetReflection()->GetMessage(message, field), inner, defaults);
    else if (const QString number = number_of(message, *field); !number.isEmpty())
      defaults.emplace(inner, number);
  }
}

std::map<std::string, QString> all_defaults() {
  std::map<std::string, QString> defaults;
  for (const MethodEntry& entry : method_entries()) {
    v1::Settings settings;
    *settings.mutable_method() = default_method(entry);
    collect_defaults(with_defaults(settings), "", defaults);
  }
  v1::Settings goal;
  goal.mutable_goal();
  collect_defaults(with_defaults(goal), "", defaults);
  return defaults;
}

/// Null: there is none of that path.
const pb::FieldDescriptor* field_at(const std::string& path) {
  const pb::Descriptor* type = v1::Settings::descriptor();
  const pb::FieldDescriptor* field = nullptr;
  for (std::size_t at = 0; at <= path.size() && type != nullptr;) {
    const std::size_t dot = std::min(path.find('.', at), path.size());
    field = type->FindFieldByName(path.substr(at, dot - at));
    if (field == nullptr) return nullptr;
    type = field->message_type();
    at = dot + 1;
  }
  return field;
}

}  // namespace

FieldFacts settings_facts(const std::string& path) {
  static const std::map<std::string, QString> defaults = all_defaults();
  FieldFacts facts;
  if (const auto range = ranges().find(path); range != ranges().end()) facts.range = range->second;
  if (const auto one = defaults.find(path); one != defaults.end()) facts.left_out = one->second;
  const pb::FieldDescriptor* field = field_at(path);
  if (const client::SchemaHelp* help = schema_help(); help != nullptr && field != nullptr)
    facts.help = help_tip(help->of(*field));
  return facts;
}

}  // namespace metamer::gui
