#include "server/service/ops/log.h"

#include <fmt/chrono.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "common/printable.h"
#include "server/service/ops/notify.h"

namespace metamer::service {

namespace {

/// Of the line that this thread is about to write: loggers here write at once.
thread_local const LogFields* current_fields = nullptr;

std::vector<std::pair<const char*, std::string>> fields_of_line() {
  std::vector<std::pair<const char*, std::string>> said;
  if (!current_fields) return said;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) said.emplace_back(name, printable(value));
  };
  add("peer", current_fields->peer);
  add("user", current_fields->user);
  if (current_fields->job > 0) add("job", std::to_string(current_fields->job));
  add("reason", current_fields->reason);
  return said;
}

/// As it is where a word can't be mistaken; else in quotes, in which quotes and `\` have a `\`.
std::string field_text(const std::string& value) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._:/@+-";
  if (value.find_first_not_of(plain) == std::string::npos) return value;
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

std::string text_of(const spdlog::details::log_msg& message) {
  std::string text = printable({message.payload.data(), message.payload.size()});
  for (const auto& [name, value] : fields_of_line()) {
    text += ' ';
    text += name;
    text += '=' + field_text(value);
  }
  return text;
}

class TextFormatter : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& to) override {
    const std::string payload = text_of(message);
    spdlog::details::log_msg shown = message;
    shown.payload = payload;
    lines_.format(shown, to);
    // It has left there where the colours go.
    message.color_range_start = shown.color_range_start;
    message.color_range_end = shown.color_range_end;
  }
  std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<TextFormatter>();
  }

 private:
  spdlog::pattern_formatter lines_;
};

/// syslog(3)'s number of a level, as the journal reads it at the beginning of a line.
int priority(spdlog::level::level_enum level) {
  constexpr int debug = 7, info = 6, warning = 4, error = 3, critical = 2;
  if (level <= spdlog::level::debug) return debug;
  if (level == spdlog::level::info) return info;
  if (level == spdlog::level::warn) return warning;
  return level == spdlog::level::err ? error : critical;
}

class JournalFormatter : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& to) override {
    fmt::format_to(std::back_inserter(to), "<{}>{}\n", priority(message.level), text_of(message));
  }
  std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<JournalFormatter>();
  }
};

class JsonFormatter : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& to) override {
    const auto since = message.time.time_since_epoch();
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
    nlohmann::ordered_json line;
    line["time"] =
        fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                    fmt::gmtime(spdlog::log_clock::to_time_t(message.time)), milliseconds % 1000);
    const auto level = spdlog::level::to_string_view(message.level);
    line["level"] = std::string(level.data(), level.size());
    line["message"] = printable({message.payload.data(), message.payload.size()});
    for (const auto& [name, value] : fields_of_line()) line[name] = value;
    if (current_fields && current_fields->job > 0) line["job"] = current_fields->job;
    const std::string text = line.dump() + "\n";
    to.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<JsonFormatter>();
  }
};

std::unique_ptr<spdlog::formatter> make_formatter(LogFormat format) {
  if (format == LogFormat::json) return std::make_unique<JsonFormatter>();
  if (notify::logs_to_journal()) return std::make_unique<JournalFormatter>();
  return std::make_unique<TextFormatter>();
}

}  // namespace

void log_to_stderr(const std::string& level, LogFormat format) {
  auto logger = spdlog::stderr_color_st("metamerd");
  logger->set_formatter(make_formatter(format));
  spdlog::set_default_logger(std::move(logger));
  spdlog::set_level(spdlog::level::from_str(level));
}

void log_line(spdlog::level::level_enum level, const LogFields& fields,
              const std::string& message) {
  current_fields = &fields;
  spdlog::log(level, "{}", message);
  current_fields = nullptr;
}

}  // namespace metamer::service
