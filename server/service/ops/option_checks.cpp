#include "server/service/ops/option_checks.h"

#include <charconv>

#include "common/wire/endpoint.h"

namespace metamer::service {

Result<void> check_endpoint(const std::string& text) {
  if (const auto endpoint = wire::parse_endpoint(text); !endpoint)
    return tl::unexpected(endpoint.error());
  return {};
}

Result<void> check_mode(const std::string& text) {
  if (socket_mode_of(text)) return {};
  return problem("expected a mode such as 0660, not " + quoted(text));
}

Result<void> check_gl_device(const std::string& text) {
  constexpr unsigned last_device = 15;
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  if (text == "auto" || text == "reference" || (is_number && number <= last_device)) return {};
  return problem("expected auto, reference, or a number from 0 to " + std::to_string(last_device) +
                 ", not " + quoted(text));
}

std::optional<mode_t> socket_mode_of(const std::string& text) {
  constexpr mode_t any = 0777;
  mode_t mode = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), mode, 8);
  if (error != std::errc{} || end != text.data() + text.size() || mode > any) return std::nullopt;
  return mode;
}

}  // namespace metamer::service
