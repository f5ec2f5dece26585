#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/session/credentials.h"
#include "client/tools/text/formatted.h"
#include "common/wire/endpoint.h"

namespace metamer::cli {
namespace {

struct LoginOptions {
  bool json = false;
  std::string server;
  std::string token_file;
  Credentials credentials;
};

/// What is typed is not shown meanwhile, where somebody types.
class QuietTerminal {
 public:
  QuietTerminal() : there_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!there_) return;
    termios quiet = before_;
    quiet.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &quiet);
    std::fputs("token: ", stderr);
  }
  ~QuietTerminal() {
    if (!there_) return;
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
    std::fputc('\n', stderr);
  }
  QuietTerminal(const QuietTerminal&) = delete;

 private:
  termios before_{};
  bool there_;
};

/// As ssh has it of keys: what others may read is no secret any more. Pipes are theirs who made
/// them.
Result<void> check_own(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  if (status.st_uid != ::geteuid() || (status.st_mode & 077) == 0) return {};
  return problem("others may read " + path +
                 client::formatted(" (mode %04o)", unsigned{status.st_mode & 07777}) +
                 ": have the token revoked, or chmod 600 it if nobody has");
}

/// The first line: of a file, or of stdin. A token on the command line would be seen by all who
/// list processes.
Result<std::string> read_token(const LoginOptions& options) {
  std::string token;
  if (options.token_file.empty()) {
    const QuietTerminal quiet;
    std::getline(std::cin, token);
  } else {
    std::ifstream file(options.token_file);
    if (!file) return problem("can't read " + options.token_file);
    if (auto own = check_own(options.token_file); !own) return tl::unexpected(own.error());
    std::getline(file, token);
  }
  while (!token.empty() && (token.back() == '\r' || token.back() == ' ')) token.pop_back();
  constexpr std::size_t longest = 1000;
  if (token.empty()) return problem("there is no token on the first line");
  if (token.size() > longest) return problem("a token has less than 1000 characters");
  return token;
}

/// "AB:CD:…", as openssl writes it, or the digits alone.
Result<std::string> read_fingerprint(const std::string& text) {
  std::string digits;
  for (const char c : text)
    if (c != ':') digits += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool hex = digits.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (text.empty() || (hex && digits.size() == 64)) return digits;
  return problem("a fingerprint is the SHA-256 of the certificate, 64 hexadecimal digits");
}

Result<Credentials> gather(const LoginOptions& options) {
  Credentials credentials = options.credentials;
  const auto fingerprint = read_fingerprint(credentials.fingerprint);
  if (!fingerprint) return tl::unexpected(fingerprint.error());
  credentials.fingerprint = *fingerprint;
  std::error_code ignored;
  for (std::string* file : {&credentials.authorities, &credentials.certificate, &credentials.key})
    if (!file->empty()) *file = std::filesystem::absolute(*file, ignored).string();
  if (credentials.certificate.empty() != credentials.key.empty())
    return problem("--cert and --key belong together");
  if (!credentials.certificate.empty() && options.token_file.empty()) return credentials;
  const auto token = read_token(options);
  if (!token) return tl::unexpected(token.error());
  credentials.token = *token;
  return credentials;
}

ExitCode log_in(const std::string& server, const Credentials& credentials, Report& report) {
  const auto try_it = [&](Session& session) -> boost::asio::awaitable<ExitCode> {
    const auto kept = keep_credentials(server, credentials);
    if (!kept) {
      report.error(kept.error().message);
      co_return ExitCode::other;
    }
    const v1::Welcome& welcome = session.welcome();
    report.document()["server"] = server;
    report.document()["user"] = welcome.user();
    report.document()["role"] = v1::Role_Name(welcome.role());
    report.line("logged in to " + server + " as " + welcome.user() + "; kept in " +
                credentials_file().string());
    co_return ExitCode::done;
  };
  return with_named_server(server, credentials, report, try_it);
}

ExitCode run(const LoginOptions& options) {
  Report report(options.json);
  const auto refuse = [&](const Problem& problem) {
    report.error(problem.message);
    return report.finish(ExitCode::bad_input);
  };
  const auto endpoint = wire::parse_endpoint(options.server);
  if (!endpoint) return refuse(endpoint.error());
  const auto credentials = gather(options);
  if (!credentials) return refuse(credentials.error());
  return report.finish(log_in(wire::to_string(*endpoint), *credentials, report));
}

void declare(LoginOptions& values, Options& options) {
  options.push_back({.names = "server",
                     .target = &values.server,
                     .meaning = "tls:HOST:PORT; without tls: on this machine alone",
                     .required = true});
  options.push_back({.names = "--token-file",
                     .target = &values.token_file,
                     .meaning = "read the token from this file in place of stdin; it is refused "
                                "where others may read it"});
  options.push_back({.names = "--ca",
                     .target = &values.credentials.authorities,
                     .meaning = "who signs the server's certificate, a PEM file in place of the "
                                "system's authorities"});
  options.push_back({.names = "--fingerprint",
                     .target = &values.credentials.fingerprint,
                     .meaning = "of the server's certificate (SHA-256), as its administrator says "
                                "it; then no authority is needed"});
  options.push_back({.names = "--cert",
                     .target = &values.credentials.certificate,
                     .meaning = "your certificate, a PEM file; a server that knows it needs no "
                                "token"});
  options.push_back(
      {.names = "--key", .target = &values.credentials.key, .meaning = "its key, a PEM file"});
  declare_json(values.json, options);
}

}  // namespace

Command commands::login() {
  return make_command<LoginOptions>(
      "login", "say who you are to a server, once: the token is read from stdin and kept", declare,
      run);
}

}  // namespace metamer::cli
