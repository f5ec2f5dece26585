#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "client/cli/exit_code.h"
#include "client/cli/json.h"
#include "client/session/error.h"
#include "common/problem.h"

namespace metamer::cli {

/// Prints a text and ends its line. Whoever wrote the text, a server or a file, it commands no
/// terminal; names and reasons in it go through printable() before, so that they forge no lines.
void say(std::ostream& stream, std::string_view text);

/// What a subcommand has to say. People read errors and notes on stderr as they come; with --json
/// the same facts also stand in the one document that finish() prints on stdout.
class Report {
 public:
  explicit Report(bool json) : json_(json) {}

  bool json() const { return json_; }
  /// The answer's own fields, for --json.
  Json& document() { return document_; }

  /// Something that is wrong with nobody's file.
  void error(const std::string& message);
  /// Something wrong at a place; `source` is the text of problem.file, for the line and caret.
  void problem(const Problem& problem, std::string_view source = {});
  /// The same, where it is known how a person reads it.
  void described_problem(const Problem& problem, const std::string& text);
  /// Something worth knowing.
  void note(const Problem& note);
  /// A session's failure, with the problems that came with it. Returns the exit code it means.
  ExitCode session_error(const SessionError& error);

  /// A line of the answer on stdout; nothing with --json.
  void line(const std::string& text);
  /// The same in pieces of 80 characters at most, parted at blanks; those after the first are
  /// indented.
  void wrapped(const std::string& text);

  /// The last call: prints the document with --json. Error: stdout can't be written.
  ExitCode finish(ExitCode code);

 private:
  bool json_;
  Json document_ = Json::object();
};

}  // namespace metamer::cli
