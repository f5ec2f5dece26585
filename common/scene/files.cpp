#include "common/scene/files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

namespace metamer {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t piece = 1u << 20;           // Large enough that reading is not call-bound.
constexpr std::size_t max_names_compared = 1000;  // For "did you mean": a folder may be huge.

/// Feeds the bytes of `file` to `take`, at most `limit` of them; the number of bytes read.
template <class Take>
Result<std::uint64_t> for_each_piece(const fs::path& file, std::uint64_t limit, Take take) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return problem(std::string("can't be read: ") + std::strerror(errno));
  std::string buffer(piece, '\0');
  std::uint64_t size = 0;
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto count = static_cast<std::size_t>(stream.gcount());
    size += count;
    if (size > limit)
      return problem("is too large (more than " + std::to_string(limit) + " bytes)");
    take(std::string_view(buffer).substr(0, count));
  }
  if (stream.bad()) return problem("can't be read to its end");
  return size;
}

/// What keeps `file` from being read as a file of at most `limit` bytes, as the end of a sentence;
/// empty: nothing.
std::string obstacle(const fs::path& file, std::uint64_t limit) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return "does not exist";
  if (error) return "can't be read: " + error.message();
  if (status.type() == fs::file_type::directory) return "is a folder";
  if (status.type() != fs::file_type::regular) return "is not a regular file";
  const std::uint64_t size = fs::file_size(file, error);
  if (error) return "can't be read: " + error.message();
  if (size > limit) return "is too large " + size_and_limit(size, limit);
  return {};
}

/// True when `path` lies below `folder`; both absolute and free of links and dots.
bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [in_folder, in_path] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end() && in_path != path.end();
}

/// The files beside `file`, as a scene would write them, in alphabetical order.
std::vector<std::string> neighbours(const std::string& name, const fs::path& folder) {
  const fs::path parent = fs::path(name).parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder / parent, error), end;
       !error && entry != end && names.size() < max_names_compared; entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) {
      names.push_back((parent / entry->path().filename()).string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string size_and_limit(std::uint64_t size, std::uint64_t limit) {
  std::string text = std::to_string(size);
  return text.insert(0, 1, '(') + " bytes; at most " + std::to_string(limit) + ")";
}

Result<std::string> read_file(const fs::path& file, std::uint64_t limit) {
  const auto failed = [&](const std::string& what) {
    return tl::unexpected(Problem{.field = {}, .file = file.string(), .message = "file " + what});
  };
  if (const std::string what = obstacle(file, limit); !what.empty()) return failed(what);
  std::string text;
  const auto size =
      for_each_piece(file, limit, [&](std::string_view bytes) { text.append(bytes); });
  if (!size) return failed(size.error().message);
  return text;
}

Result<fs::path> find_in_folder(const std::string& name, const fs::path& folder,
                                std::uint64_t limit, bool guess) {
  const std::string file = "file " + quoted(name) + " ";
  const fs::path relative(name);
  if (name.find('\0') != std::string::npos) return problem(file + "has a NUL in its name");
  if (relative.is_absolute()) return problem(file + "must be relative to the scene's folder");
  if (*relative.lexically_normal().begin() == "..") {
    return problem(file + "leads out of the scene's folder");
  }

  // Follow the links on the way before looking at anything else.
  std::error_code error;
  const fs::path base = fs::canonical(folder, error);
  if (error) return problem("the scene's folder can't be read: " + error.message());
  const fs::path path = fs::canonical(base / relative, error);
  if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory) {
    const auto known = guess ? neighbours(name, base) : std::vector<std::string>();
    Problem missing = unknown_name(file + "does not exist", name, known);
    missing.was = name;
    return tl::unexpected(std::move(missing));
  }
  if (error) return problem(file + "can't be read: " + error.message());
  if (path == base) return problem(file + "is a folder");
  if (!is_below(path, base)) {
    return problem(file + "leads out of the scene's folder through a symbolic link");
  }

  if (const std::string what = obstacle(path, limit); !what.empty()) return problem(file + what);
  return path;
}

Result<fs::path> find_file(const fs::path& path, std::uint64_t limit) {
  const std::string what = obstacle(path, limit);
  if (!what.empty()) return problem("file " + quoted(path.string()) + " " + what);
  return path;
}

Result<FileDigest> digest_file(const fs::path& file, std::uint64_t limit) {
  DigestStream digest;
  const auto size =
      for_each_piece(file, limit, [&](std::string_view bytes) { digest.update(bytes); });
  if (!size) return tl::unexpected(size.error());
  return FileDigest{*size, digest.finish()};
}

}  // namespace metamer
