#include "client/cli/report.h"

#include <cstdio>
#include <iostream>

#include "client/session/problems.h"
#include "common/printable.h"

namespace metamer::cli {
namespace {

ExitCode exit_code(const SessionError& error) {
  switch (error.kind) {
    case SessionError::Kind::no_server:
    case SessionError::Kind::version:
    case SessionError::Kind::disconnected:
      return ExitCode::no_server;
    case SessionError::Kind::input:
      return ExitCode::bad_input;
    case SessionError::Kind::refused:
      break;
  }
  switch (error.code) {
    case v1::Error::NOT_FOUND:
    case v1::Error::STATE:
    case v1::Error::LIMIT:
      return ExitCode::bad_input;
    default:
      return ExitCode::other;
  }
}

}  // namespace

void say(std::ostream& stream, std::string_view text) { stream << printable(text, "\n\t") << '\n'; }

void Report::error(const std::string& message) {
  say(std::cerr, "error: " + message);
  document_["errors"].push_back(message);
}

void Report::problem(const Problem& problem, std::string_view source) {
  described_problem(problem, format(problem, source));
}

void Report::described_problem(const Problem& problem, const std::string& text) {
  say(std::cerr, text);
  document_["problems"].push_back(to_json(problem));
}

void Report::note(const Problem& note) {
  std::string text;
  if (!note.file.empty()) {
    text = printable(note.file) + ':';
    if (note.line > 0) text += std::to_string(note.line) + ':';
    if (note.line > 0 && note.column > 0) text += std::to_string(note.column) + ':';
    text += ' ';
  }
  say(std::cerr, text + "note: " + note.message);
  document_["notes"].push_back(to_json(note));
}

ExitCode Report::session_error(const SessionError& failure) {
  error(failure.message);
  for (const v1::Problem& one : failure.problems) problem(from_wire(one), {});
  return exit_code(failure);
}

void Report::line(const std::string& text) {
  if (json_) return;
  say(std::cout, text);
  std::cout.flush();
}

void Report::wrapped(const std::string& text) {
  constexpr std::size_t width = 80, indent = 2;
  std::string rest = text;
  while (rest.size() > width) {
    const std::size_t blank = rest.rfind(' ', width);
    if (blank == std::string::npos || blank <= indent) break;
    line(rest.substr(0, blank));
    rest = std::string(indent, ' ') + rest.substr(blank + 1);
  }
  line(rest);
}

ExitCode Report::finish(ExitCode code) {
  if (json_) {
    document_["exit_code"] = static_cast<int>(code);
    // Bytes of a file's text may be no UTF-8: write a mark in their place rather than nothing.
    std::cout << document_.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  }
  std::cout.flush();
  if (!std::cout && code == ExitCode::done) return ExitCode::other;
  return code;
}

}  // namespace metamer::cli
