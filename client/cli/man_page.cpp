#include "client/cli/man_page.h"

#include "client/cli/commands.h"
#include "common/roff.h"

namespace metamer::cli {
namespace {

std::string item(const std::string& head, const std::string& text) {
  return ".TP\n.B " + roff(head) + "\n" + roff(text) + "\n";
}

std::string words_of(const Option& option) {
  std::string words = option.names;
  if (!option.type.empty()) words += " " + option.type;
  return words;
}

constexpr const char* beginning = R"(.SH NAME
metamer \- spectral pictures: render, look, compare
.SH SYNOPSIS
.B metamer
.I COMMAND
.RI [ OPTION ]...
.SH DESCRIPTION
.B metamer
sends scenes to a
.BR metamerd (8)
and takes pictures from it. Without
.B \-\-server
or METAMER_SERVER the commands render, turntable, sweep, check, bench and tradeoff start a private one; models, spectra, relight and
compare need none; the others need one that runs.
.B metamer
.I COMMAND
.B \-\-help
says the same as this page, with defaults.
.SH COMMANDS
)";

constexpr const char* ending = R"(.SH EXIT STATUS
.TP
.B 0
done.
.TP
.B 1
anything that has no number of its own.
.TP
.B 2
bad input or usage.
.TP
.B 3
no server there, or it was lost.
.TP
.B 4
the job failed.
.TP
.B 5
cancelled.
.TP
.B 6
the picture is there, and is not as accurate, or as quick, as asked for.
.SH ENVIRONMENT
.TP
.B METAMER_SERVER
the server where no
.B \-\-server
names one.
.SH FILES
.TP
.I ~/.config/metamer/servers.toml
what
.B metamer login
keeps of each server: the token, and how its certificate is known. Only its owner may be able to read it. Without a
server's section its token is forgotten.
.SH SEE ALSO
.BR metamerd (8)
)";

}  // namespace

std::string man_page() {
  std::string page = ".TH METAMER 1 \"\" \"Metamer " METAMER_VERSION "\" \"Metamer\"\n";
  page += beginning;
  for (const Command& command : all_commands()) {
    page += ".SS \"metamer " + roff(command.name) + "\"\n" + roff(command.meaning) + "\n";
    for (const Option& option : command.options) page += item(words_of(option), option.meaning);
  }
  return page + ending;
}

}  // namespace metamer::cli
