#include "server/service/executors/slurm/spool.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>

#include "common/printable.h"
#include "common/wire/batch_file.h"

namespace metamer::service {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_taken = 64u << 20;  // bytes of files, in one look
constexpr std::string_view result_ending = ".result";

/// Of a result's file, whole: tasks write under other names.
std::optional<std::uint64_t> attempt_of(const std::string& name) {
  std::uint64_t attempt = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), attempt);
  const bool whole =
      error == std::errc{} && std::string_view(end, name.data() + name.size()) == result_ending;
  return whole ? std::optional(attempt) : std::nullopt;
}

FoundResult read_result(const fs::path& folder, std::uint64_t attempt) {
  FoundResult found{.folder = folder, .attempt = attempt, .message = {}, .range = {}, .damage = {}};
  auto message = wire::read_batch_result(result_file(folder, attempt));
  if (!message) {
    found.damage = message.error().message;
    return found;
  }
  found.message = *std::move(message);
  for (v1::BatchTile& tile : *found.message.mutable_tile())
    found.range.tiles.push_back({.rays = tile.rays(),
                                 .xyz = std::move(*tile.mutable_xyz()),
                                 .factors = std::move(*tile.mutable_factors())});
  found.message.clear_tile();
  // The file's own digest has been checked, so this one says whose tiles they are.
  found.range.attempt = attempt;
  const auto count = static_cast<std::uint32_t>(found.range.tiles.size());
  found.range.digest =
      digest_of({found.message.job_id(), found.message.attempt(), {found.message.first(), count}},
                found.range.tiles);
  return found;
}

}  // namespace

fs::path result_file(const fs::path& folder, std::uint64_t attempt) {
  return folder / (std::to_string(attempt) + std::string(result_ending));
}

Result<void> write_orders(const fs::path& folder, const std::vector<v1::BatchOrder>& orders) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) fs::permissions(folder.parent_path(), fs::perms::owner_all, error);
  if (error) return problem("can't make " + folder.string() + ": " + error.message());
  for (std::size_t i = 0; i < orders.size(); ++i)
    if (auto written = wire::write_batch_file(folder / (std::to_string(i) + ".order"), orders[i]);
        !written)
      return written;
  return {};
}

Result<void> write_picture(const fs::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) return problem("can't write " + file.string());
  return {};
}

std::vector<FoundResult> take_results(const std::vector<fs::path>& folders) {
  std::vector<FoundResult> results;
  std::uint64_t taken = 0;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (fs::directory_iterator file(folder, error), end; !error && file != end;
         file.increment(error)) {
      const auto attempt = attempt_of(file->path().filename().string());
      std::error_code unknown;
      const std::uint64_t size = attempt ? file->file_size(unknown) : 0;
      if (!attempt || unknown || (taken > 0 && taken + size > most_taken)) continue;
      taken += size;
      results.push_back(read_result(folder, *attempt));
      fs::remove(file->path(), unknown);
    }
  }
  return results;
}

std::string last_words(const fs::path& log) {
  constexpr std::size_t most = 300;
  std::ifstream in(log, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : 0;
  std::string text(
      std::min<std::size_t>(most, static_cast<std::size_t>(std::max<std::streamoff>(size, 0))),
      '\0');
  in.seekg(-static_cast<std::streamoff>(text.size()), std::ios::end);
  if (!in.read(text.data(), static_cast<std::streamsize>(text.size()))) return {};
  const auto end = text.find_last_not_of(" \n");
  if (end == text.npos) return {};
  const auto before = text.rfind('\n', end);
  const auto begin = before == text.npos ? 0 : before + 1;
  return printable(text.substr(begin, end + 1 - begin));
}

void remove_leavings(const fs::path& folder, const std::string& prefix) {
  std::error_code error, ignored;
  for (fs::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error))
    if (file->path().filename().string().starts_with(prefix)) fs::remove_all(file->path(), ignored);
}

}  // namespace metamer::service
