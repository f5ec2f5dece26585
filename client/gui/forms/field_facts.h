#pragma once

#include <QString>
#include <optional>

namespace metamer::gui {

/// The least and the greatest number that a field of the settings takes.
struct NumberRange {
  double least, greatest;
};

/// What a form says of a field, beside its name and kind.
struct FieldFacts {
  QString help;      ///< The schema's own words.
  QString left_out;  ///< What holds where it is left out: "640"; empty: that depends.
  std::optional<NumberRange> range = {};  ///< Of numbers; nothing: any that is finite.
};

/// Of a field of Settings by its path: "method.point.step". Ranges are those of check_settings.
FieldFacts settings_facts(const std::string& path);

}  // namespace metamer::gui
