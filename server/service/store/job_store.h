#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/record.pb.h"
#include "server/service/store/disk_trouble.h"
#include "server/service/store/journal.h"
#include "server/service/store/tile_file.h"
#include "server/service/store/usage_rows.h"

namespace metamer::service {

/// What a daemon keeps in its state's folder, which it alone has open:
///
///     lock  metamer.db  reserve  assets/SHA-256…  jobs/ID.tiles
///
/// What is asked for is carried out in that order, by the journal's thread. For the loop's thread.
class JobStore {
 public:
  using Done = Journal::Done;

  /// Makes the folder (mode 0700) where there is none, and brings its tables up to date. Errors:
  /// another daemon has it; it can't be written; its database is damaged or of a later version.
  static Result<std::unique_ptr<JobStore>> open(asio::any_io_executor loop,
                                                const std::filesystem::path& folder);
  ~JobStore();
  JobStore(const JobStore&) = delete;
  JobStore& operator=(const JobStore&) = delete;

  /// 16 bytes, for ever.
  const std::string& server_id() const { return server_id_; }
  std::filesystem::path assets() const { return folder_ / "assets"; }
  /// Greater than that of any job that ever was.
  std::uint64_t next_id() const { return next_id_; }

  /// A job as it was kept last; without a record where that can't be read.
  struct Kept {
    std::uint64_t id = 0;
    std::string user;
    std::optional<v1::JobRecord> record;
  };
  /// All jobs, by their numbers; given once, at the start.
  std::vector<Kept> take_kept() { return std::move(kept_); }
  /// Of all backends, and of all users; given once, at the start.
  std::vector<KeptLead> take_leads() { return std::move(leads_); }
  std::vector<KeptWork> take_work() { return std::move(work_); }
  /// Keeps the leads of a backend, in the place of what was kept of it, and these hours; what is
  /// of hours before `first` is forgotten.
  void put_usage(v1::Backend backend, std::vector<KeptLead> leads, std::vector<KeptWork> work,
                 std::int64_t first);

  /// Keeps a job as it is now. With `tiles` all of these are on the disk before; trouble where one
  /// could not be written.
  void put(v1::JobRecord record, const TileFile* tiles, Done done);
  /// Forgets a job, then its tiles.
  void remove(std::uint64_t id);
  std::unique_ptr<TileFile> tiles(std::uint64_t id) const;
  /// Writes a record of a tile; those of one file that come in one turn of the loop are written at
  /// once.
  void write_tile(const TileFile& file, std::uint64_t offset, std::string record, Done done);
  /// Cuts a job's tiles off behind `size` bytes; they are void.
  void cut_tiles(std::uint64_t id, std::uint64_t size);
  void remove_tiles(std::uint64_t id);

  /// Once all that was asked for so far has been carried out.
  void settle(Done done) { post({}, std::move(done)); }
  /// The same for other files and tables of the state.
  asio::awaitable<std::optional<StoreTrouble>> carry_out(Journal::Work work) {
    post_tiles();
    return journal_->carry_out(std::move(work));
  }
  /// Why jobs or tiles can't be kept; nothing while they can.
  const std::optional<std::string>& trouble() const {
    return rows_.text() ? rows_.text() : tiles_.text();
  }
  /// While there is trouble, now and then: writes something that is of no use. Where that goes well
  /// `again` puts what could not be kept, and unless that is refused the trouble is over.
  void try_again(std::function<void()> again);
  /// See Journal.
  void make_room_by(std::function<bool()> make_room) {
    journal_->make_room_by(std::move(make_room));
  }

 private:
  /// Records that follow each other in a file.
  struct Tiles {
    std::filesystem::path path;
    std::shared_ptr<std::atomic<bool>> lost;
    std::uint64_t offset = 0;
    std::string records;
    std::vector<Done> done;
  };

  explicit JobStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Result<void> lock();
  Result<void> read(asio::any_io_executor loop);
  void remove_orphans();
  void note(DiskTrouble& of, const std::optional<StoreTrouble>& trouble);
  void post(Journal::Work work, Done done = {});
  void post_tiles();
  std::filesystem::path tile_path(std::uint64_t id) const;

  std::filesystem::path folder_;
  int lock_ = -1;
  std::string server_id_;
  std::uint64_t next_id_ = 1;
  std::vector<Kept> kept_;
  std::vector<KeptLead> leads_;
  std::vector<KeptWork> work_;
  DiskTrouble rows_{"the state"}, tiles_{"the tiles of jobs"};
  std::uint64_t refusals_ = 0;       // so far
  std::uint64_t refused_bytes_ = 0;  // of the last tile that was
  bool tries_ = false;               // try_again() is under way
  std::unique_ptr<Journal> journal_;
  std::optional<asio::any_io_executor> loop_;
  std::optional<Tiles> tiles_due_;  // that the journal has not been given yet
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);  // watched by what was posted to the loop
};

}  // namespace metamer::service
