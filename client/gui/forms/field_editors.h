#pragma once

#include <google/protobuf/message.h>

#include <QWidget>
#include <functional>
#include <string>

#include "client/gui/forms/field_facts.h"

namespace metamer::gui {

/// What edits one field of a message.
struct FieldEditor {
  QWidget* widget = nullptr;  ///< With an accessible name; its tool tip is the help.
  /// Shows what the holder has in the field; sets the holder's field to what is shown, or clears it
  /// where it is left out.
  std::function<void(const google::protobuf::Message& holder)> show;
  std::function<void(google::protobuf::Message& holder)> store;
};

/// "tile size" of tile_size.
QString field_label(const google::protobuf::FieldDescriptor& field);

/// An editor for a field that is no message: a list of words, a check box, a spin box, or a line
/// for real numbers, lists and text. `changed` is called when a person changes it.
FieldEditor make_field_editor(const google::protobuf::FieldDescriptor& field,
                              const FieldFacts& facts, const std::function<void()>& changed);

}  // namespace metamer::gui
