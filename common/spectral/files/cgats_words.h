#pragma once

#include <optional>
#include <string_view>

#include "common/spectral/files/spectrum_file.h"
#include "common/spectral/files/tokens.h"

/// What the words of a CGATS file mean.
namespace metamer::spectrum_text {

/// Whether a word is that keyword, in any case.
bool is_keyword(const Token& token, std::string_view keyword);

struct Column {
  enum class Kind { spectral, id, name, other };
  Kind kind = Kind::other;
  double nm = 0;  ///< As the name of a spectral column says.
  Token token;
};

/// A column by its name. The number in a spectral one's only has to be one: the header's positions
/// go before it.
Column make_column(const Token& token);

/// Whether a column may stand where the header puts it: names carry whole nanometres, rounded
/// either way, or (colord's CIE-A.sp) thousandths.
bool names_position(const Column& column, double nm);

/// MEAS_TYPE as Argyll writes it. Nothing: it is another word.
std::optional<Quantity> quantity_of_type(const Token& type);

}  // namespace metamer::spectrum_text
