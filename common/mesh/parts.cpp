#include "common/mesh/parts.h"

#include <algorithm>
#include <initializer_list>
#include <set>

#include "common/mesh/used_vertices.h"

namespace metamer {
namespace {

constexpr std::size_t most_listed = 20;

using Pieces = std::vector<MeshPiece>;

template <typename NameOf>
Pieces called(const Pieces& pieces, const std::string& name, const NameOf& name_of) {
  Pieces result;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(result),
               [&](const MeshPiece& piece) { return name_of(piece) == name; });
  return result;
}

std::string object_of(const MeshPiece& piece) { return piece.object; }
std::string material_of(const MeshPiece& piece) { return piece.material; }
std::string both_of(const MeshPiece& piece) { return piece.object + "/" + piece.material; }

bool same_pieces(const Pieces& a, const Pieces& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.first_triangle == other.first_triangle;
  });
}

/// The file's names in their order, each once.
std::vector<std::string> names_in(const Pieces& pieces) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const auto name_of : {object_of, material_of})
    for (const MeshPiece& piece : pieces)
      if (const std::string name = name_of(piece); !name.empty() && seen.insert(name).second)
        names.push_back(name);
  return names;
}

tl::unexpected<Problem> no_part(const Pieces& pieces, const std::string& part) {
  const std::vector<std::string> names = names_in(pieces);
  if (names.empty()) return problem("has no part " + quoted(part) + ": nothing in it has a name");
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most_listed); ++i)
    list += (i > 0 ? ", " : "") + quoted(names[i]);
  if (names.size() > most_listed)
    list += " and " + std::to_string(names.size() - most_listed) + " more";
  return tl::unexpected(
      unknown_name("has no part " + quoted(part) + " (it has " + list + ")", part, names));
}

void keep_pieces(MeshFile& file, Pieces pieces) {
  // Move the triangles together.
  std::uint64_t count = 0;
  for (MeshPiece& piece : pieces) {
    const auto move = [&](auto& of_triangles) {
      if (of_triangles.empty()) return;
      const auto first = of_triangles.begin() + static_cast<std::ptrdiff_t>(piece.first_triangle);
      std::copy(first, first + static_cast<std::ptrdiff_t>(piece.triangles),
                of_triangles.begin() + static_cast<std::ptrdiff_t>(count));
    };
    move(file.triangles);
    move(file.smoothing);
    piece.first_triangle = count;
    count += piece.triangles;
  }
  file.triangles.resize(count);
  file.triangles.shrink_to_fit();
  if (!file.smoothing.empty()) file.smoothing.resize(count);
  file.pieces = std::move(pieces);
  keep_used_vertices(file);
}

}  // namespace

Result<void> select_part(MeshFile& file, const std::string& part) {
  Pieces found;
  for (const auto name_of : {object_of, material_of, both_of}) {
    Pieces pieces = called(file.pieces, part, name_of);
    if (!pieces.empty() && !found.empty() && !same_pieces(pieces, found))
      return problem("part " + quoted(part) +
                     " is an object and another's material; write \"object/material\"");
    if (!pieces.empty()) found = std::move(pieces);
  }
  if (found.empty()) return no_part(file.pieces, part);
  if (!same_pieces(found, file.pieces)) keep_pieces(file, std::move(found));
  return {};
}

}  // namespace metamer
