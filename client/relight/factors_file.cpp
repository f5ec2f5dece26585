#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>

#include "client/relight/factors.h"
#include "client/relight/scene_sources.h"
#include "common/digest.h"
#include "common/image/whole_file.h"
#include "common/scene/limits.h"

namespace metamer::client {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr std::array<char, 8> magic{'M', 'T', 'M', 'R', 'F', 'A', 'C', 'T'};
constexpr std::uint32_t version = 1;
/// Of the messages together: protobuf reads no more than 2 GiB, and a head that large is none.
constexpr std::uint64_t max_messages = 512u << 20;

struct Head {
  std::array<char, 8> magic;
  std::uint32_t version, width, height, reserved;
  std::uint64_t plan_bytes, scene_bytes, tables_bytes, pairs;
  Digest digest;  ///< Of all that follows, and of this with zeros here.
};
static_assert(sizeof(Head) == 88);

using Piece = std::span<const std::byte>;

Digest digest_of(Head head, std::initializer_list<Piece> pieces) {
  head.digest = {};
  DigestStream sum;
  const auto add = [&](const Piece& piece) {
    sum.update({reinterpret_cast<const char*>(piece.data()), piece.size()});
  };
  add(std::as_bytes(std::span(&head, 1)));
  for (const Piece& piece : pieces) add(piece);
  return sum.finish();
}

template <class List>
Piece bytes_of(const List& list) {
  return std::as_bytes(std::span(list));
}

Problem file_problem(const std::filesystem::path& file, std::string message) {
  Problem problem;
  problem.file = file.string();
  problem.message = std::move(message);
  return problem;
}

std::uint64_t file_size(const Head& head) {
  return sizeof(Head) + head.plan_bytes + head.scene_bytes + head.tables_bytes +
         4 * std::uint64_t{head.width} * head.height + 8 * head.pairs;
}

/// What is wrong with the head of a file of `size` bytes; empty: nothing.
std::string head_fault(const Head& head, std::uint64_t size) {
  if (head.magic != magic) return "is no file of factors";
  if (head.version != version)
    return "is a file of factors of version " + std::to_string(head.version) +
           "; this program reads version " + std::to_string(version);
  const std::uint64_t pixels = std::uint64_t{head.width} * head.height;
  if (pixels == 0 || head.width > limits::max_side || head.height > limits::max_side ||
      pixels > limits::max_pixels)
    return "has a picture of " + std::to_string(head.width) + " x " + std::to_string(head.height) +
           " pixels";
  if (head.plan_bytes > max_messages || head.scene_bytes > max_messages ||
      head.tables_bytes > max_messages || head.pairs > size || file_size(head) != size)
    return "is cut short, or longer than its head says";
  return {};
}

/// What is wrong with the pixels' pairs; empty: nothing.
std::string pair_fault(const Factors& factors) {
  if (!std::is_sorted(factors.end.begin(), factors.end.end()) ||
      factors.end.back() != factors.signature.size())
    return "has pixels whose pairs do not follow each other";
  const auto signatures = static_cast<std::uint32_t>(factors.tables.signature_product_size());
  std::uint32_t largest = 0;
  for (const std::uint32_t signature : factors.signature) largest = std::max(largest, signature);
  if (!factors.signature.empty() && largest >= signatures)
    return "has a pixel that names a signature that does not exist";
  // NaN and infinity times 0 are NaN, and stay so.
  float sum = 0;
  for (const float weight : factors.weight) sum += weight * 0;
  if (!std::isfinite(sum)) return "has a weight that is not finite";
  return {};
}

}  // namespace

Result<void> write_factors(const Factors& factors, const std::filesystem::path& file) {
  const std::string plan = factors.plan.SerializeAsString();
  const std::string scene = factors.scene.SerializeAsString();
  const std::string tables = factors.tables.SerializeAsString();
  Head head{magic,       version,      factors.width, factors.height,           0,
            plan.size(), scene.size(), tables.size(), factors.signature.size(), {}};
  const std::initializer_list<Piece> pieces = {bytes_of(plan),
                                               bytes_of(scene),
                                               bytes_of(tables),
                                               bytes_of(factors.end),
                                               bytes_of(factors.signature),
                                               bytes_of(factors.weight)};
  head.digest = digest_of(head, pieces);
  std::vector<Piece> all = {std::as_bytes(std::span(&head, 1))};
  all.insert(all.end(), pieces.begin(), pieces.end());
  return write_whole_file(file, all).map_error(
      [&](const Problem& wrong) { return file_problem(file, wrong.message); });
}

Result<Factors> read_factors(const std::filesystem::path& file) {
  const auto fail = [&](std::string message) {
    return tl::unexpected(file_problem(file, std::move(message)));
  };
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) return fail("can't be read: " + error.message());
  std::ifstream in(file, std::ios::binary);
  const auto read = [&](void* to, std::uint64_t bytes) {
    return bytes == 0 || in.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
  };
  Head head{};
  if (size < sizeof head || !read(&head, sizeof head)) return fail("is no file of factors");
  if (const std::string fault = head_fault(head, size); !fault.empty()) return fail(fault);

  // Read all of it, and trust no byte before the sum is right.
  Factors factors;
  std::string plan(head.plan_bytes, '\0'), scene(head.scene_bytes, '\0'),
      tables(head.tables_bytes, '\0');
  factors.width = head.width;
  factors.height = head.height;
  factors.end.resize(std::size_t{head.width} * head.height);
  factors.signature.resize(head.pairs);
  factors.weight.resize(head.pairs);
  if (!read(plan.data(), plan.size()) || !read(scene.data(), scene.size()) ||
      !read(tables.data(), tables.size()) || !read(factors.end.data(), 4 * factors.end.size()) ||
      !read(factors.signature.data(), 4 * head.pairs) ||
      !read(factors.weight.data(), 4 * head.pairs))
    return fail("can't be read");
  if (digest_of(head, {bytes_of(plan), bytes_of(scene), bytes_of(tables), bytes_of(factors.end),
                       bytes_of(factors.signature), bytes_of(factors.weight)}) != head.digest)
    return fail("is damaged");
  if (!factors.plan.ParseFromString(plan) || !factors.scene.ParseFromString(scene) ||
      !factors.tables.ParseFromString(tables))
    return fail("has a head that can't be read");

  std::string fault = scene_fault(factors.scene);
  if (fault.empty())
    fault = table_fault(factors.tables, static_cast<std::size_t>(factors.scene.light_size()),
                        SceneSources(factors.scene).factors());
  if (!fault.empty()) return fail("is damaged: " + fault);
  if (fault = pair_fault(factors); !fault.empty()) return fail(fault);
  return factors;
}

}  // namespace metamer::client
