#include "server/service/store/job_store.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>
#include <system_error>
#include <utility>

#include "server/service/store/durable_file.h"
#include "server/service/store/record_row.h"
#include "server/service/store/reserve.h"
#include "server/service/store/schema.h"

namespace metamer::service {

namespace fs = std::filesystem;

namespace {

bool has_ended(v1::JobState state) {
  return state == v1::FINISHED || state == v1::FAILED || state == v1::CANCELLED;
}

void write_record(Database& database, const v1::JobRecord& record) {
  Statement put = database.prepare(
      "INSERT INTO jobs(id, user, state, ended_at, record) VALUES(?,?,?,?,?) "
      "ON CONFLICT(id) DO UPDATE SET state=excluded.state, ended_at=excluded.ended_at, "
      "record=excluded.record");
  put.bind(1, static_cast<std::int64_t>(record.job_id()))
      .bind(2, record.user())
      .bind(3, static_cast<std::int64_t>(record.state()))
      .bind_bytes(5, encode_record(record));
  if (has_ended(record.state())) put.bind(4, record.ended_at());
  put.run();
}

std::vector<JobStore::Kept> read_records(Database& database) {
  std::vector<JobStore::Kept> kept;
  Statement all = database.prepare("SELECT id, user, record FROM jobs ORDER BY id");
  while (all.step()) {
    JobStore::Kept one{static_cast<std::uint64_t>(all.integer(0)), all.bytes(1), {}};
    one.record = decode_record(all.bytes(2));
    if (one.record && one.record->job_id() != one.id) one.record.reset();
    if (!one.record) spdlog::error("job {} can't be read from the state", one.id);
    kept.push_back(std::move(one));
  }
  return kept;
}

/// Of tiles that are written at once: a few of the largest.
constexpr std::size_t most_bytes_due = 4u << 20;

std::uint64_t last_id(Database& database) {
  Statement find = database.prepare("SELECT seq FROM sqlite_sequence WHERE name='jobs'");
  return find.step() ? static_cast<std::uint64_t>(find.integer(0)) : 0;
}

}  // namespace

Result<std::unique_ptr<JobStore>> JobStore::open(asio::any_io_executor loop,
                                                 const fs::path& folder) {
  auto store = std::unique_ptr<JobStore>(new JobStore(folder));
  for (const fs::path& one : {folder, store->assets(), folder / "jobs"}) {
    auto made = make_folder(one, "the state's folder");
    if (!made) return tl::unexpected(made.error());
  }
  std::error_code error;
  fs::permissions(folder, fs::perms::owner_all, error);
  if (error)
    return problem("can't keep the state's folder " + folder.string() +
                   " from others: " + error.message());
  if (auto locked = store->lock(); !locked) return tl::unexpected(locked.error());
  if (auto read = store->read(std::move(loop)); !read) return tl::unexpected(read.error());
  return store;
}

JobStore::~JobStore() {
  if (journal_) post_tiles();
  journal_.reset();
  if (lock_ >= 0) ::close(lock_);
}

Result<void> JobStore::lock() {
  const fs::path path = folder_ / "lock";
  lock_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_ < 0) return problem("can't open " + path.string() + ": " + std::strerror(errno));
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) return {};
  if (errno == EWOULDBLOCK)
    return problem("another metamerd has the state " + folder_.string() + " open");
  return problem("can't lock " + path.string() + ": " + std::strerror(errno));
}

Result<void> JobStore::read(asio::any_io_executor loop) {
  try {
    auto database = std::make_unique<Database>(folder_ / database_name);
    if (const auto damage = database->damage())
      return problem("the state's database is damaged: " + *damage);
    if (auto migrated = migrate(*database); !migrated) return migrated;
    server_id_ = service::server_id(*database);
    kept_ = read_records(*database);
    next_id_ = last_id(*database) + 1;
    leads_ = read_leads(*database);
    work_ = read_work(*database);
    remove_orphans();
    keep_reserve(folder_);
    sync_folder(folder_);
    loop_ = loop;
    journal_ = std::make_unique<Journal>(std::move(loop), std::move(database));
  } catch (const std::exception& error) {
    return problem("can't open the state's database " + (folder_ / database_name).string() + ": " +
                   error.what());
  }
  return {};
}

/// Files of jobs whose rows are gone: the daemon ended between the two.
void JobStore::remove_orphans() {
  std::set<fs::path> known;
  for (const Kept& kept : kept_) known.insert(tile_path(kept.id));
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_ / "jobs", ignored))
    if (!known.contains(entry.path())) fs::remove(entry.path(), ignored);
}

fs::path JobStore::tile_path(std::uint64_t id) const {
  return folder_ / "jobs" / (std::to_string(id) + ".tiles");
}

std::unique_ptr<TileFile> JobStore::tiles(std::uint64_t id) const {
  return std::make_unique<TileFile>(tile_path(id));
}

void JobStore::put(v1::JobRecord record, const TileFile* tiles, Done done) {
  Journal::Work sync;
  const auto lost = tiles ? tiles->lost() : nullptr;
  if (tiles) {
    sync = [path = tiles->path(), lost](Database&) {
      // No room that is made now would bring them back.
      if (*lost) throw SyncError(ENOSPC, std::generic_category(), path.string());
      try {
        TileFile::sync(path);
      } catch (const std::system_error&) {
        *lost = true;
        throw;
      }
    };
  }
  post(
      [record = std::move(record), sync = std::move(sync)](Database& database) {
        if (sync) sync(database);
        write_record(database, record);
      },
      [this, lost, done = std::move(done)](const std::optional<StoreTrouble>& trouble) {
        const bool of_tiles = trouble && lost && *lost;
        note(of_tiles ? tiles_ : rows_, trouble);
        if (done) done(trouble);
      });
}

void JobStore::note(DiskTrouble& of, const std::optional<StoreTrouble>& trouble) {
  if (!trouble) return of.taken();
  ++refusals_;
  of.refused(trouble->message);
}

void JobStore::put_usage(v1::Backend backend, std::vector<KeptLead> leads,
                         std::vector<KeptWork> work, std::int64_t first) {
  post([backend, first, leads = std::move(leads), work = std::move(work)](Database& database) {
    write_leads(database, backend, leads);
    write_work(database, work, first);
  });
}

void JobStore::remove(std::uint64_t id) {
  post([id](Database& database) {
    Statement forget = database.prepare("DELETE FROM jobs WHERE id=?");
    forget.bind(1, static_cast<std::int64_t>(id)).run();
  });
  remove_tiles(id);
}

/// In the order in which all was asked for.
void JobStore::post(Journal::Work work, Done done) {
  post_tiles();
  journal_->post(std::move(work), std::move(done));
}

void JobStore::write_tile(const TileFile& file, std::uint64_t offset, std::string record,
                          Done done) {
  const auto goes_on = [&](const Tiles& due) {
    return due.lost == file.lost() && due.offset + due.records.size() == offset &&
           due.records.size() < most_bytes_due;
  };
  if (tiles_due_ && !goes_on(*tiles_due_)) post_tiles();
  if (!tiles_due_) {
    tiles_due_ = Tiles{file.path(), file.lost(), offset, {}, {}};
    asio::post(*loop_, [this, alive = std::weak_ptr(alive_)] {
      if (!alive.expired()) post_tiles();
    });
  }
  tiles_due_->records += record;
  tiles_due_->done.push_back(std::move(done));
}

void JobStore::post_tiles() {
  if (!tiles_due_) return;
  Tiles due = *std::exchange(tiles_due_, std::nullopt);
  const std::uint64_t bytes = due.records.size();
  journal_->post(
      [path = std::move(due.path), lost = due.lost, offset = due.offset,
       records = std::move(due.records), only_these = false](Database&) mutable {
        try {
          TileFile::write(path, offset, records);
          if (only_these) *lost = false;  // it was tried again, with more room
        } catch (const std::system_error&) {
          only_these = !lost->exchange(true) || only_these;
          throw;
        }
      },
      [this, bytes, all = std::move(due.done)](const std::optional<StoreTrouble>& trouble) {
        // What is taken does not say that the others were: see try_again().
        if (trouble) {
          refused_bytes_ = bytes;
          note(tiles_, trouble);
        }
        for (const Done& done : all)
          if (done) done(trouble);
      });
}

void JobStore::try_again(std::function<void()> again) {
  if (!trouble() || std::exchange(tries_, true)) return;
  post(
      [folder = folder_, path = folder_ / "jobs" / "try",
       bytes = refused_bytes_](Database& database) {
        database.run("UPDATE meta SET value=value");
        try_to_write(path, bytes);
        keep_reserve(folder);
      },
      [this, again = std::move(again)](const std::optional<StoreTrouble>& trouble) {
        tries_ = false;
        if (trouble) return;
        again();
        post({}, [this, before = refusals_](const std::optional<StoreTrouble>& last) {
          if (last || refusals_ != before) return;
          rows_.taken();
          tiles_.taken();
        });
      });
}

void JobStore::cut_tiles(std::uint64_t id, std::uint64_t size) {
  post([path = tile_path(id), size](Database&) { TileFile::cut(path, size); });
}

/// After the row that says so is on the disk: a transaction of its own comes later.
void JobStore::remove_tiles(std::uint64_t id) {
  post({}, [this, id](const std::optional<StoreTrouble>& trouble) {
    if (!trouble) post([path = tile_path(id)](Database&) { TileFile::remove(path); });
  });
}

}  // namespace metamer::service
