#pragma once

#include <string>

namespace metamer::client {

/// A field of a table (RFC 4180): quoted where it has to be.
std::string csv_field(const std::string& text);

}  // namespace metamer::client
