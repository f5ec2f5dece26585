#include "client/tools/scene/settings_change.h"

#include <google/protobuf/util/message_differencer.h>

#include <utility>
#include <vector>

#include "common/scene/settings.h"

namespace metamer::client {
namespace {

namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;
using Paths = std::vector<std::string>;

bool same(const pb::Message& a, const pb::Message& b, const Field& field) {
  // A depth of 0 is not one that is left out.
  if (field.has_presence() &&
      a.GetReflection()->HasField(a, &field) != b.GetReflection()->HasField(b, &field))
    return false;
  pb::util::MessageDifferencer differencer;
  const std::vector<const Field*> one{&field};
  return differencer.CompareWithFields(a, b, one, one);
}

/// Whether the field is the choice of a oneof in `own`, and `wanted` has chosen another.
bool is_passed_over(const pb::Message& wanted, const Field& field) {
  const pb::OneofDescriptor* oneof = field.real_containing_oneof();
  return oneof != nullptr && wanted.GetReflection()->HasOneof(wanted, oneof) &&
         !wanted.GetReflection()->HasField(wanted, &field);
}

void collect_changes(const pb::Message& own, const pb::Message& wanted, const std::string& before,
                     Paths& paths) {
  const pb::Descriptor& type = *own.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const Field& field = *type.field(i);
    if (same(own, wanted, field) || is_passed_over(wanted, field)) continue;
    const std::string path = before + field.name();
    const bool inside = field.message_type() != nullptr && !field.is_repeated() &&
                        own.GetReflection()->HasField(own, &field);
    if (inside)
      collect_changes(own.GetReflection()->GetMessage(own, &field),
                      wanted.GetReflection()->GetMessage(wanted, &field), path + '.', paths);
    else
      paths.push_back(path);
  }
}

/// Where the one is to take the place of the other, the look names it, and apply makes room.
void name_choices(const v1::Settings& own, v1::Settings& wanted) {
  const auto chooses = [](const v1::Settings& settings) {
    return settings.has_goal() || settings.method().method_case() != v1::Method::METHOD_NOT_SET;
  };
  if (chooses(own) && !chooses(wanted)) wanted.mutable_method()->mutable_exact();
  const bool space = wanted.development().space_case() != v1::Development::SPACE_NOT_SET;
  if (own.development().space_case() != v1::Development::SPACE_NOT_SET && !space)
    wanted.mutable_development()->set_rgb_space(v1::SRGB);
  const bool bright = wanted.development().brightness_case() != v1::Development::BRIGHTNESS_NOT_SET;
  if (own.development().brightness_case() != v1::Development::BRIGHTNESS_NOT_SET && !bright)
    wanted.mutable_development()->set_exposure(0);
}

}  // namespace

void set_settings(const v1::Settings& own, v1::Settings wanted, const std::string& by, Look& look) {
  v1::Settings from = own;
  take_older_goal(from);
  take_older_goal(wanted);
  name_choices(from, wanted);
  // A goal that goes is cleared by the method that comes, and the other way round.
  if (!wanted.has_goal()) from.clear_goal();
  if (!wanted.has_method()) from.clear_method();
  Paths paths;
  collect_changes(from, wanted, "", paths);

  look.mask.clear_paths();
  std::erase_if(look.replaced,
                [](const Replaced& one) { return one.field.rfind("settings.", 0) == 0; });
  look.settings = std::move(wanted);
  for (const std::string& path : paths) look.set(path, by);
}

}  // namespace metamer::client
