#include "common/mesh/obj/piece.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "common/mesh/obj/lines.h"
#include "common/mesh/text.h"
#include "common/mesh/vertex.h"

namespace metamer::obj {
namespace {

using mesh_text::skip_space;

enum class Statement { v, vt, vn, f, o, g, s, usemtl, free_form, points_or_lines, other };

/// What a line says; `line` becomes what follows its first word.
Statement take_statement(std::string_view& line) {
  const char* const end = line.data() + line.size();
  const char* const begin = skip_space(line.data(), end);
  const char* const after = mesh_text::skip_word(begin, end);
  const std::string_view word(begin, static_cast<std::size_t>(after - begin));
  line = {after, static_cast<std::size_t>(end - after)};
  if (word == "v") return Statement::v;
  if (word == "f") return Statement::f;
  if (word == "vn") return Statement::vn;
  if (word == "vt") return Statement::vt;
  if (word == "o") return Statement::o;
  if (word == "g") return Statement::g;
  if (word == "s") return Statement::s;
  if (word == "usemtl") return Statement::usemtl;
  if (word == "fo") return Statement::f;  // Of versions before 3.
  if (word == "curv" || word == "curv2" || word == "surf") return Statement::free_form;
  if (word == "p" || word == "l") return Statement::points_or_lines;
  return Statement::other;
}

std::string name_in(std::string_view line) {
  const char* const begin = skip_space(line.data(), line.data() + line.size());
  line.remove_prefix(static_cast<std::size_t>(begin - line.data()));
  while (!line.empty() && mesh_text::is_space(line.back())) line.remove_suffix(1);
  return mesh_text::utf8_name(line);
}

/// The number of a smoothing group; 0: off, or what is no number.
std::uint32_t smoothing_in(std::string_view line) {
  const char* const end = line.data() + line.size();
  std::uint32_t number = 0;
  std::from_chars(skip_space(line.data(), end), end, number);
  return number;
}

class PieceReader {
 public:
  PieceReader(const Counts& before, Vertices& vertices, Faces& faces)
      : now_(before), vertices_(vertices), faces_(faces) {
    faces_.runs.emplace_back();
  }

  /// Reads a line; what is wrong with it otherwise.
  std::optional<std::string> read(std::string_view line) {
    switch (take_statement(line)) {
      case Statement::v:
        return read_v(line);
      case Statement::vt:
        return read_vt(line);
      case Statement::vn:
        return read_vn(line);
      case Statement::f:
        return read_face(line);
      case Statement::o:
        run().object = name_in(line);
        run().group = "";
        break;
      case Statement::g:
        run().group = name_in(line);
        break;
      case Statement::s:
        run().smoothing = smoothing_in(line);
        break;
      case Statement::usemtl:
        run().material = name_in(line);
        break;
      case Statement::free_form:
        faces_.free_form = true;
        break;
      case Statement::points_or_lines:
        faces_.points_or_lines = true;
        break;
      case Statement::other:
        break;
    }
    return std::nullopt;
  }

 private:
  /// So many of a line's numbers, of which it has to have the first `least`; `line` becomes what
  /// follows them.
  template <std::size_t size>
  static bool read_numbers(std::string_view& line, std::size_t least,
                           std::array<double, size>& to) {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (std::size_t i = 0; i < size; ++i) {
      at = skip_space(at, end);
      const auto value = mesh_text::read_number(at, end);
      if (!value) return i >= least && (at == end || *at == '#');
      to[i] = *value;
    }
    line.remove_prefix(static_cast<std::size_t>(at - line.data()));
    return true;
  }

  std::optional<std::string> read_v(std::string_view line) {
    Double3 position{};
    if (!read_numbers(line, 3, position)) return "v has three numbers";
    if (!is_position(position)) return "v is not finite or too far out";
    vertices_.v[now_.v++] = position;
    std::array<double, 3> color;
    if (!line.empty() && !faces_.vertex_colors)
      faces_.vertex_colors = read_numbers(line, color.size(), color);
    return std::nullopt;
  }
  std::optional<std::string> read_vt(std::string_view line) {
    std::array<double, 2> uv{};
    if (!read_numbers(line, 1, uv)) return "vt has one to three numbers";
    const Float2 place = to_uv(uv[0], uv[1]);
    if (!is_uv(place)) return "vt is not finite or too far out";
    vertices_.vt[now_.vt++] = place;
    return std::nullopt;
  }
  std::optional<std::string> read_vn(std::string_view line) {
    Double3 normal{};
    if (!read_numbers(line, 3, normal)) return "vn has three numbers";
    vertices_.vn[now_.vn++] = unit_or_none(normal);
    return std::nullopt;
  }

  std::optional<std::string> read_face(std::string_view line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    std::uint32_t corners = 0;
    while ((at = skip_space(at, end)) != end && *at != '#') {
      if (auto wrong = read_corner(at, end)) return wrong;
      ++corners;
    }
    faces_.corners.push_back(corners);
    if (corners >= 3) faces_.runs.back().triangles += corners - 2;
    return std::nullopt;
  }

  /// v, v/vt, v//vn or v/vt/vn.
  std::optional<std::string> read_corner(const char*& at, const char* end) {
    const char* const begin = at;
    std::array<std::int64_t, 3> numbers{};  // 0: it has none.
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [rest, error] = std::from_chars(at, end, numbers[i]);
      if (error == std::errc() && numbers[i] == 0)
        return "counts from 1; 0 is no number of a vertex";
      if (error == std::errc::result_out_of_range || (error != std::errc() && i == 0)) break;
      at = rest;
      if (at == end || *at != '/') break;
      ++at;
    }
    if (numbers[0] == 0 || (at != end && !mesh_text::is_space(*at))) {
      const char* const word = mesh_text::skip_word(begin, end);
      return "corner " + mesh_text::cited({begin, static_cast<std::size_t>(word - begin)}) +
             " is none of v, v/vt, v//vn and v/vt/vn";
    }
    if (auto wrong = add(numbers[0], "v", now_.v, vertices_.v.size(), faces_.v)) return wrong;
    if (auto wrong = add(numbers[1], "vt", now_.vt, vertices_.vt.size(), faces_.vt)) return wrong;
    return add(numbers[2], "vn", now_.vn, vertices_.vn.size(), faces_.vn);
  }

  /// Adds an index: from 1 for the file's first, from -1 for the last one before.
  static std::optional<std::string> add(std::int64_t number, const char* what, std::uint64_t before,
                                        std::uint64_t all, std::vector<std::uint32_t>& to) {
    if (number == 0) {
      if (all > 0) to.push_back(none);
      return std::nullopt;
    }
    const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(before) + number;
    if (index < 0 || static_cast<std::uint64_t>(index) >= all)
      return "names " + std::string(what) + " " + std::to_string(number) + "; there are " +
             std::to_string(number > 0 ? all : before) + (number > 0 ? "" : " before it");
    to.push_back(static_cast<std::uint32_t>(index));
    return std::nullopt;
  }

  /// The run of the faces that follow a name.
  Run& run() {
    if (faces_.corners.size() != faces_.runs.back().first_face)
      faces_.runs.push_back({.object = {},
                             .group = {},
                             .material = {},
                             .smoothing = {},
                             .first_face = faces_.corners.size(),
                             .first_corner = faces_.v.size()});
    return faces_.runs.back();
  }

  Counts now_;
  Vertices& vertices_;
  Faces& faces_;
};

}  // namespace

Counts count(std::string_view piece, char line_end) {
  Counts counts;
  Lines lines(piece, line_end);
  std::string_view line;
  while (lines.next(line)) {
    const Statement statement = take_statement(line);
    counts.v += statement == Statement::v ? 1 : 0;
    counts.vt += statement == Statement::vt ? 1 : 0;
    counts.vn += statement == Statement::vn ? 1 : 0;
  }
  counts.lines = lines.count();
  return counts;
}

std::optional<Problem> read_piece(std::string_view piece, char line_end, const Counts& before,
                                  const std::string& file, Vertices& vertices, Faces& faces) {
  PieceReader reader(before, vertices, faces);
  Lines lines(piece, line_end);
  std::string_view line;
  while (lines.next(line))
    if (auto wrong = reader.read(line))
      return mesh_text::problem_at(file, before.lines + lines.number() + 1, *std::move(wrong))
          .value();
  return std::nullopt;
}

}  // namespace metamer::obj
