#include "server/service/ops/man_page.h"

#include <fmt/format.h>

#include "common/roff.h"
#include "server/service/ops/config_file.h"
#include "server/service/ops/option_value.h"

namespace metamer::service {

namespace {

std::string heading(const char* name, const char* section) {
  return fmt::format(".TH {} {} \"\" \"Metamer {}\" \"Metamer\"\n", name, section, METAMER_VERSION);
}

std::string item(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + roff(text) + ".\n";
}

std::string option_item(const Option& option) {
  const std::string value = value_name(option);
  std::string head = ".B \\-\\-" + roff(option.name);
  if (!value.empty()) head = ".BI \\-\\-" + roff(option.name) + " \" " + value + "\"";
  return item(head, option.meaning);
}

std::string key_item(const Option& option) {
  const Settings defaults;
  const auto value = toml_text(option, defaults);
  std::string text = option.meaning + ". Value: " + expected_value(option) + ". " +
                     (value ? "Default: " + *value : "Not set by default");
  if (option.reloads) text += ". SIGHUP changes it";
  return item(".B " + roff(option.name), text);
}

constexpr const char* before_options = R"(.SH NAME
metamerd \- the Metamer render service
.SH SYNOPSIS
.B metamerd
.RI [ OPTION ]...
.br
.B metamerd \-\-check\-config
.I FILE
.br
.B metamerd \-\-print\-config
.RI [ OPTION ]...
.br
.B metamerd user add
.I NAME
.B \-\-state
.I DIR
.RI [ OPTION ]...
.br
.B metamerd user revoke
.I NAME
.B \-\-state
.I DIR
.RB [ \-\-token
.IR LABEL ]
.br
.B metamerd user list \-\-state
.I DIR
.SH DESCRIPTION
.B metamerd
takes jobs and views of spectral scenes over sockets, starts workers that render them inside a sandbox, and
sends pictures as they grow. How to install it, let users in, upgrade and back up is told by deploy/README.md.
.SH OPTIONS
What stands here overrides the file of
.BR \-\-config ,
which has the same names: see
.BR metamerd.toml (5).
.TP
.BI \-\-config " \fR[\fPFILE\fR]\fP"
read this file first; without a name /etc/metamer/metamerd.toml, where that exists.
.TP
.B \-\-print\-config
print the configuration in force, with comments, and end.
.TP
.BI \-\-check\-config " FILE"
say what is wrong with this file, by line and column, and end. The certificates that it names are read, too: call
it as the daemon's user.
.TP
.B \-\-help\fR, \fP\-\-version
say what the options are, or which version it is.
)";

constexpr const char* after_options = R"(.SH USERS
.B metamerd user
says who may use a daemon that keeps its state in
.IR DIR ;
one that runs sees each change within seconds. Root acts as the owner of
.IR DIR .
The options of
.BR "user add" :
.TP
.BI \-\-role " viewer|submitter|admin"
look at the server and at views; submit jobs, too; order everybody's jobs, too. A new user needs one.
.TP
.BI \-\-uid " NUMBER"
the user of this machine who comes in as NAME by a Unix socket.
.TP
.BI \-\-token " LABEL"
print a new token, which is kept as a hash and can't be printed again. One label may be that of several tokens, which
.B user revoke \-\-token
then revokes together.
.TP
.BI \-\-expires " DAYS"
after which that token is no longer valid.
.TP
.BI \-\-share " WEIGHT"
the user's part of each worker beside others'; 1 at first.
.TP
.B \-\-max\-jobs\fR, \fP\-\-max\-bytes\fR, \fP\-\-max\-sessions\fR " NUMBER"
jobs that have not ended, bytes of assets, sessions at a time: where not set, 7/8 of what is free.
.PP
Of a user who is there already, what is not named stays; one who was revoked is let in again, his old tokens are not.
A revoked user's sessions are closed and his jobs go on: an admin cancels them.
.SH SIGNALS
.TP
.B SIGTERM\fR, \fPSIGINT
take no more jobs, tell those who watch, let them take what is on its way for at most
.B drain\-seconds
and end. A second one ends it at once.
.TP
.B SIGHUP
read the configuration again: what can change while it runs does, the log names the rest.
.SH EXIT STATUS
.TP
.B 0
done.
.TP
.B 1
failed: an address in use, a state that can't be read.
.TP
.B 2
a wrong command line or configuration.
.SH FILES
.TP
.I /etc/metamer/metamerd.toml
the configuration.
.TP
.I /var/lib/metamer
the state of the unit: metamer.db, assets, jobs.
.TP
.I /run/metamer/metamerd.sock
where clients of this machine connect.
.SH SEE ALSO
.BR metamer (1),
.BR metamerd.toml (5)
)";

constexpr const char* before_keys = R"(.SH NAME
metamerd.toml \- what metamerd is told
.SH DESCRIPTION
A file in TOML 1.0, which
.B metamerd \-\-config
reads. Each key is an option of
.BR metamerd (8),
which on the command line has the last word. Bytes are numbers or texts ("300MiB", powers of 1,024); times are
seconds.
.B metamerd \-\-print\-config
writes the file with comments;
.B metamerd \-\-check\-config
says what is wrong with one.
)";

}  // namespace

std::string metamerd_man_page() {
  std::string page = heading("METAMERD", "8") + before_options;
  for (const Option& option : all_options()) page += option_item(option);
  return page + after_options;
}

std::string config_man_page() {
  std::string page = heading("METAMERD.TOML", "5") + before_keys;
  for (const Section& section : all_sections()) {
    page += ".SH [" + section.name + "]\n" + roff(section.meaning) + "\n";
    for (const Option& option : all_options())
      if (option.section == section.name) page += key_item(option);
  }
  return page + ".SH SEE ALSO\n.BR metamerd (8)\n";
}

}  // namespace metamer::service
