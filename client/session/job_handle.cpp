#include "client/session/job_handle.h"

#include <algorithm>
#include <charconv>

#include "common/problem.h"

namespace metamer::client {
namespace {

constexpr std::string_view hex_digits = "0123456789abcdef";
/// Two for each byte of Welcome.server_id.
constexpr std::size_t most_handle_digits = 32;

bool read_job_number(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number > 0;
}

bool read_server_digits(std::string_view text, std::string& digits) {
  for (const char c : text) {
    const char small = 'A' <= c && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c;
    if (hex_digits.find(small) == std::string_view::npos) return false;
    digits += small;
  }
  return least_handle_digits <= digits.size() && digits.size() <= most_handle_digits;
}

}  // namespace

Result<JobHandle> parse_job_handle(std::string_view text) {
  const std::size_t at = text.find('@');
  JobHandle job;
  if (read_job_number(text.substr(0, at), job.number) &&
      (at == std::string_view::npos || read_server_digits(text.substr(at + 1), job.server)))
    return job;
  return problem(quoted(std::string(text)) +
                 " is no job: one is named by its handle, as metamer jobs lists it, such as "
                 "7@3f9c2a1b, or by its number alone");
}

std::string to_text(const JobHandle& job) {
  const std::string number = std::to_string(job.number);
  return job.server.empty() ? number : number + '@' + job.server.substr(0, handle_digits);
}

std::string server_digits(const v1::Welcome& welcome) {
  std::string digits;
  for (const char c : welcome.server_id().substr(0, most_handle_digits / 2)) {
    const auto byte = static_cast<unsigned char>(c);
    digits += hex_digits[byte >> 4];
    digits += hex_digits[byte & 15];
  }
  return digits;
}

Answer<void> check_server(const JobHandle& job, const v1::Welcome& welcome) {
  const std::string here = server_digits(welcome);
  if (job.server.empty() || here.starts_with(job.server)) return {};
  return session_error(SessionError::Kind::input,
                       "job " + to_text(job) + " is of another server: " +
                           (here.empty() ? "this one's jobs have a number alone"
                                         : "this one's end in @" + here.substr(0, handle_digits)));
}

}  // namespace metamer::client
