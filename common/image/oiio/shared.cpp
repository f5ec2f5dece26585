#include "common/image/oiio/shared.h"

namespace metamer::oiio {

std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "no reason given" : line;
}

}  // namespace metamer::oiio
