#include "server/service/ops/user_command.h"

#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "server/service/access/permit.h"
#include "server/service/access/users.h"
#include "server/service/ops/command_line.h"
#include "server/service/store/reserve.h"
#include "server/service/store/schema.h"
#include "server/service/wall_clock.h"

namespace metamer::service {

namespace {

constexpr double day_seconds = 86400;

/// "2026-11-27", in UTC.
std::string date(double time) {
  const auto seconds = static_cast<std::time_t>(time);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  char text[16];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d", &parts)};
}

/// What the words say.
struct UserWords {
  std::string state, name, token;
  std::optional<std::string> role;
  std::optional<double> expires;  ///< Days.
  UserChange change;
};

using UserAction = std::function<Result<void>(Users&, const UserWords&)>;

struct UserTask {
  enum class Kind {
    reads,
    writes,
    has_to_be,  ///< It writes, on a full disk, too: with what the daemon has kept there for this.
  };
  UserAction does;
  Kind kind = Kind::writes;
};

Result<void> add_user(Users& users, const UserWords& words) {
  UserChange change = words.change;
  change.name = words.name;
  if (words.role) change.role = role_of(*words.role);
  if (words.expires && words.token.empty())
    return problem("--expires is a token's: say --token LABEL, too");
  const double now = wall_clock();
  const auto user = users.add(change, now);
  if (!user) return tl::unexpected(user.error());
  if (words.token.empty()) return {};
  const auto expires =
      words.expires ? std::optional(now + *words.expires * day_seconds) : std::nullopt;
  const std::string token = users.add_token(user->name, words.token, expires, now);
  std::fprintf(stderr, "%s's token \"%s\", which is not kept and not shown again:\n",
               user->name.c_str(), words.token.c_str());
  std::printf("%s\n", token.c_str());
  return {};
}

std::string limits_text(const User& user) {
  std::string text;
  const auto add = [&](const char* name, const std::optional<std::int64_t>& limit) {
    if (limit) text += std::string(", ") + name + " " + std::to_string(*limit);
  };
  add("jobs", user.max_jobs);
  add("bytes", user.max_bytes);
  add("sessions", user.max_sessions);
  if (user.max_work) text += ", work " + number_text(*user.max_work) + " s";
  return text;
}

std::string expiry_text(const Token& token) {
  if (!token.expires_at) return {};
  return (*token.expires_at > wall_clock() ? ", expires " : ", expired ") + date(*token.expires_at);
}

Result<void> list_users(Users& users, const UserWords&) {
  for (const User& user : users.list()) {
    std::printf("%s: %s%s, share %g%s%s\n", user.name.c_str(), word(user.role),
                user.uid ? (", uid " + std::to_string(*user.uid)).c_str() : "", user.share,
                limits_text(user).c_str(),
                user.revoked_at ? (", revoked " + date(*user.revoked_at)).c_str() : "");
    for (const Token& token : users.tokens(user.name))
      std::printf("  token \"%s\" of %s%s%s\n", token.label.c_str(), date(token.created_at).c_str(),
                  expiry_text(token).c_str(),
                  token.revoked_at ? (", revoked " + date(*token.revoked_at)).c_str() : "");
  }
  return {};
}

Result<void> revoke_user(Users& users, const UserWords& words) {
  if (words.token.empty()) return users.revoke(words.name, wall_clock());
  return users.revoke_token(words.name, words.token, wall_clock());
}

void declare_limits(CLI::App& add, UserChange& change) {
  add.add_option("--uid", change.uid, "which user of this machine it is, by the Unix socket");
  add.add_option("--share", change.share, "its weight where several wait (1)")
      ->check(CLI::Range(0.001, 1000.0));
  const auto limit = [&](const char* name, std::optional<std::int64_t>& value, const char* what) {
    add.add_option(name, value, what)->check(CLI::NonNegativeNumber);
  };
  limit("--max-jobs", change.max_jobs, "jobs that have not ended");
  limit("--max-bytes", change.max_bytes, "bytes of assets that its sessions and jobs keep");
  limit("--max-sessions", change.max_sessions, "sessions at a time");
  add.add_option("--max-work", change.max_work,
                 "seconds that workers may spend on its jobs within a day; 0: as many as it wants")
      ->check(CLI::Range(0.0, 1e9));
}

/// The subcommands; each sets `task`.
void declare_users(CLI::App& app, UserWords& words, UserTask& task) {
  app.require_subcommand(1);
  const auto subcommand = [&](const char* name, const char* meaning, UserTask does) {
    CLI::App* command = app.add_subcommand(name, meaning);
    command->add_option("--state", words.state, "the folder that metamerd --state names")
        ->required()
        ->type_name("DIR");
    command->callback([&task, does = std::move(does)] { task = does; });
    return command;
  };
  const auto name = [&](CLI::App* command) {
    command->add_option("name", words.name, "the user's name")->required()->type_name("NAME");
  };
  CLI::App* add = subcommand(
      "add",
      "make a user, let a revoked one in again, or change one: what is not named stays. Prints the "
      "token that --token makes",
      {add_user});
  name(add);
  add->add_option("--role", words.role,
                  "viewer: looks; submitter: and submits; admin: and orders everybody's jobs")
      ->check(CLI::IsMember({"viewer", "submitter", "admin"}));
  add->add_option("--token", words.token, "make a token, which goes by this label")
      ->type_name("LABEL");
  add->add_option("--expires", words.expires, "the token's days (for ever)")
      ->check(CLI::Range(0.0, 36500.0))
      ->type_name("DAYS");
  declare_limits(*add, words.change);
  subcommand("list", "print the users and their tokens' labels",
             {list_users, UserTask::Kind::reads});
  CLI::App* revoke =
      subcommand("revoke", "let a user, or one of its tokens, in no more. Its jobs stay",
                 {revoke_user, UserTask::Kind::has_to_be});
  name(revoke);
  revoke->add_option("--token", words.token, "this one alone")->type_name("LABEL");
}

/// Root acts as the state's owner: what it made itself the daemon could not open. Any error is the
/// database's to tell.
void become_owner_of(const std::filesystem::path& folder) {
  struct stat status {};
  if (::geteuid() != 0 || ::stat(folder.c_str(), &status) != 0 || status.st_uid == 0) return;
  if (::setgroups(0, nullptr) == 0 && ::setgid(status.st_gid) == 0) [[maybe_unused]]
    const int became = ::setuid(status.st_uid);
}

Result<void> change_users(const std::filesystem::path& file, const UserWords& words,
                          const UserAction& action) {
  Database database(file);
  if (auto migrated = migrate(database); !migrated) return migrated;
  Users users(database);
  return action(users, words);
}

Result<void> write_users(const std::filesystem::path& file, const UserWords& words,
                         const UserTask& task) {
  try {
    return change_users(file, words, task.does);
  } catch (const DatabaseError& error) {
    if (!error.is_full() || task.kind != UserTask::Kind::has_to_be ||
        !give_up_reserve(file.parent_path()))
      throw;
  }
  return change_users(file, words, task.does);
}

Result<void> carry_out(const UserWords& words, const UserTask& task) {
  const std::filesystem::path folder = words.state;
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    return problem("there is no folder " + folder.string() +
                   "; metamerd --state makes one when it starts");
  become_owner_of(folder);
  const std::filesystem::path file = folder / database_name;
  try {
    if (task.kind == UserTask::Kind::reads) {
      Database database = Database::to_read(file);
      if (auto known = check_version(database); !known) return known;
      Users users(database);
      return task.does(users, words);
    }
    return write_users(file, words, task);
  } catch (const DatabaseError& error) {
    const char* const advice = error.is_full() ? "; make room on its disk first" : "";
    return problem(file.string() + ": " + error.what() + advice);
  }
}

}  // namespace

int run_user_command(int argc, const char* const* argv) {
  CLI::App app("Who may use a metamerd that keeps its state. A daemon that runs sees it at once.",
               "metamerd user");
  UserWords words;
  UserTask task;
  declare_users(app, words, task);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_usage;
  }
  if (const auto done = carry_out(words, task); !done) {
    std::fprintf(stderr, "metamerd: %s\n", done.error().message.c_str());
    return exit_failure;
  }
  return exit_ok;
}

}  // namespace metamer::service
