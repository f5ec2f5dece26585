#include "common/spectral/files/cgats_words.h"

#include <cmath>
#include <string>

#include "common/spectral/files/labels.h"

namespace metamer::spectrum_text {

bool is_keyword(const Token& token, std::string_view keyword) {
  return token.text.size() == keyword.size() && lower(token.text) == lower(keyword);
}

Column make_column(const Token& token) {
  Column column{.token = token};
  if (is_keyword(token, "SAMPLE_ID")) column.kind = Column::Kind::id;
  if (is_keyword(token, "SAMPLE_NAME")) column.kind = Column::Kind::name;
  if (const auto label = labelled_wavelength(token.text)) {
    column.kind = Column::Kind::spectral;
    column.nm = label->value;
  }
  return column;
}

std::optional<Quantity> quantity_of_type(const Token& type) {
  const std::string word = lower(type.text);
  if (word.starts_with("reflect")) return Quantity::reflectance;
  if (word.starts_with("transmi")) return Quantity::transmittance;
  if (word.starts_with("emission") || word.starts_with("emissive") || word.starts_with("ambient") ||
      word.starts_with("flash"))
    return Quantity::emission;
  return std::nullopt;
}

bool names_position(const Column& column, double nm) {
  return std::abs(column.nm - nm) <= 1 || std::abs(column.nm / 1000 - nm) <= 1;
}

}  // namespace metamer::spectrum_text
