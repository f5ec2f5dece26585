#include "common/mesh/ply/ply_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <type_traits>

#include "common/mesh/parallel.h"
#include "common/mesh/ply/cursor.h"
#include "common/mesh/ply/vertex_columns.h"
#include "common/mesh/polygon.h"
#include "common/mesh/vertex.h"
#include "common/scene/limits.h"

namespace metamer {
namespace ply {
namespace {

/// Rows of an element that one thread reads.
template <typename Cursor>
struct Block {
  Cursor begin;
  std::uint64_t row, rows;  ///< Which one is the first, and how many.
  std::uint64_t triangles;  ///< That the rows before may become.
};
constexpr std::uint64_t block_rows = 8192;
constexpr std::uint64_t most_vertices = 3 * limits::max_triangles;

/// Where an element is in the body.
template <typename Cursor>
struct Extent {
  const Element* element = nullptr;
  std::optional<std::size_t> corners = {};  ///< The property that lists a face's vertices.
  std::vector<Block<Cursor>> blocks = {};
  std::uint64_t triangles = 0;  ///< At most.
};

template <typename Cursor>
class Reader {
 public:
  Reader(std::string_view bytes, const Header& header, const std::string& name)
      : bytes_(bytes), header_(header), name_(name) {}

  Result<MeshFile> read() {
    if (auto found = find_elements(); !found) return tl::unexpected(found.error());
    if (faces_.empty()) return problem_at(0, "holds no faces with vertex_indices");
    const VertexColumns columns(*vertices_.element);
    if (!columns.position()) return problem_at(0, "its vertices have no x, y and z");
    if (vertices_.element->count > most_vertices)
      return problem_at(0, "holds " + std::to_string(vertices_.element->count) +
                               " vertices; at most " + std::to_string(most_vertices) +
                               " are allowed");
    read_vertices(columns);
    if (first_.get()) return tl::unexpected(*first_.get());
    for (const Extent<Cursor>& faces : faces_) read_faces(faces);
    if (first_.get()) return tl::unexpected(*first_.get());
    std::erase_if(mesh_.triangles, [](const Triangle& t) { return t[0] == t[1]; });
    if (mesh_.triangles.empty()) return problem_at(0, "holds no triangles");
    mesh_.pieces = {{.triangles = mesh_.triangles.size()}};
    mesh_.skipped_faces = skipped_;
    return std::move(mesh_);
  }

 private:
  tl::unexpected<Problem> problem_at(int line, std::string message) const {
    return mesh_text::problem_at(name_, line, std::move(message));
  }
  /// A problem at the value that a cursor stands before.
  Problem problem_before(const Cursor& at, std::string message) const {
    int line = 0;
    if (std::is_same_v<Cursor, TextCursor>)
      line = mesh_text::line_of(bytes_, static_cast<std::size_t>(at.place() - bytes_.data()));
    return problem_at(line, std::move(message)).value();
  }
  static std::string name_of(const Element& element) {
    return element.name.size() > 40 ? mesh_text::cited(element.name)
                                    : mesh_text::utf8_name(element.name);
  }
  /// Of a row whose value is none.
  Problem broken_row(const Cursor& at, const Element& element, std::uint64_t row) const {
    const std::string which = name_of(element) + " " + std::to_string(row);
    const bool ends =
        at.place() == bytes_.data() + bytes_.size() || !std::is_same_v<Cursor, TextCursor>;
    return problem_before(at, ends ? "ends in " + which + " of " + std::to_string(element.count)
                                   : which + " has something else than a number");
  }

  /// Finds the elements, and room for what they hold.
  Result<void> find_elements() {
    Cursor at(bytes_.substr(header_.size));
    for (const Element& element : header_.elements) {
      Extent<Cursor> extent{.element = &element};
      if (element.name == "face" || element.name == "tristrips") {
        extent.corners = element.find({"vertex_indices", "vertex_index"});
        if (extent.corners && !element.properties[*extent.corners].count) extent.corners.reset();
        if (element.find({"texcoord"}))
          mesh_.notes.push_back("texture coordinates of faces (texcoord) were left out");
      }
      note_colors(element);
      if (auto measured = measure(extent, at); !measured) return measured;
      if (element.name == "vertex" && vertices_.element != nullptr)
        return problem_at(0, "has two elements \"vertex\"");
      if (element.name == "vertex")
        vertices_ = std::move(extent);
      else if (extent.corners)
        faces_.push_back(std::move(extent));
    }
    if (vertices_.element == nullptr) return problem_at(0, "has no element \"vertex\"");
    return {};
  }

  void note_colors(const Element& element) {
    const bool colored = element.find({"red", "diffuse_red"}) &&
                         element.find({"green", "diffuse_green"}) &&
                         element.find({"blue", "diffuse_blue"});
    const bool of_vertices = element.name == "vertex";
    if (colored && (of_vertices || element.name == "face"))
      mesh_.notes.push_back(std::string(of_vertices ? "vertex colours" : "colours of faces") +
                            " (red, green, blue) were left out");
  }

  /// Goes over an element's rows. Each value is at least one byte: nothing is allocated that the
  /// bytes can't hold.
  Result<void> measure(Extent<Cursor>& extent, Cursor& at) const {
    const Element& element = *extent.element;
    const std::size_t least = element.least_size(header_.format);
    if (least == 0) return {};
    if (element.count > (at.left() + 1) / least)
      return problem_at(0, "says that it holds " + std::to_string(element.count) + " of " +
                               mesh_text::cited(element.name) + "; its bytes are too few");
    const bool walk = std::is_same_v<Cursor, TextCursor> || element.has_lists();
    for (std::uint64_t row = 0; row < element.count; row += block_rows) {
      const std::uint64_t rows = std::min(block_rows, element.count - row);
      extent.blocks.push_back(
          {.begin = at, .row = row, .rows = rows, .triangles = extent.triangles});
      if (!walk && !at.skip(Scalar::u8, rows * least))
        return tl::unexpected(broken_row(at, element, row));
      for (std::uint64_t i = row; walk && i < row + rows; ++i)
        if (auto wrong = skip_row(extent, at, i)) return tl::unexpected(*std::move(wrong));
    }
    if (extent.triangles > limits::max_triangles)
      return problem_at(0, "holds " + std::to_string(extent.triangles) + " triangles; at most " +
                               std::to_string(limits::max_triangles) + " are allowed");
    return {};
  }

  std::optional<Problem> skip_row(Extent<Cursor>& extent, Cursor& at, std::uint64_t row) const {
    const Element& element = *extent.element;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const Property& property = element.properties[p];
      std::int64_t count = 1;
      if (property.count) {
        const Cursor before = at;
        const auto read = at.read_integer(*property.count);
        if (!read) return broken_row(at, element, row);
        if (*read < 0)
          return problem_before(before, "a list has " + std::to_string(*read) + " values");
        count = *read;
      }
      if (!at.skip(property.type, static_cast<std::uint64_t>(count)))
        return broken_row(at, element, row);
      if (p == extent.corners && count >= 3)
        extent.triangles += static_cast<std::uint64_t>(count) - 2;
    }
    return std::nullopt;
  }

  template <typename Work>
  void for_blocks(const Extent<Cursor>& extent, const Work& work) {
    tbb::parallel_for(std::size_t{0}, extent.blocks.size(), [&](std::size_t i) {
      const Block<Cursor>& block = extent.blocks[i];
      if (auto wrong = work(block)) first_.keep(i, *std::move(wrong));
    });
  }

  void read_vertices(const VertexColumns& columns) {
    const std::size_t count = vertices_.blocks.empty() ? 0 : vertices_.element->count;
    if (columns.wide())
      mesh_.positions_f64.resize(count);
    else
      mesh_.positions.resize(count);
    if (columns.normal()) mesh_.normals.resize(count);
    if (columns.uv()) mesh_.uvs.resize(count);
    for_blocks(vertices_,
               [&](const Block<Cursor>& block) { return read_vertices(columns, block); });
  }

  std::optional<Problem> read_vertices(const VertexColumns& columns, const Block<Cursor>& block) {
    const Element& element = *vertices_.element;
    Cursor at = block.begin;
    for (std::uint64_t i = block.row; i < block.row + block.rows; ++i) {
      const Cursor before = at;
      std::array<double, 8> row{};
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        const int slot = columns.slot(p);
        if (slot < 0) {
          const auto count = property.count ? at.read_integer(*property.count) : 1;
          at.skip(property.type, static_cast<std::uint64_t>(*count));  // Measured before.
        } else if (const auto value = at.read_number(property.type)) {
          row[static_cast<std::size_t>(slot)] = *value;
        } else {
          return broken_row(at, element, i);
        }
      }
      if (!is_position({row[0], row[1], row[2]}))
        return problem_before(before,
                              "vertex " + std::to_string(i) + " is not finite or too far out");
      if (columns.uv() && !is_uv(to_uv(row[6], row[7])))
        return problem_before(
            before, "the UV of vertex " + std::to_string(i) + " is not finite or too far out");
      keep(columns, row, i);
    }
    return std::nullopt;
  }

  void keep(const VertexColumns& columns, const std::array<double, 8>& row, std::size_t i) {
    if (columns.wide())
      mesh_.positions_f64[i] = {row[0], row[1], row[2]};
    else
      mesh_.positions[i] = to_f32({row[0], row[1], row[2]});
    if (columns.normal()) mesh_.normals[i] = unit_or_none({row[3], row[4], row[5]});
    if (columns.uv()) mesh_.uvs[i] = to_uv(row[6], row[7]);
  }

  void read_faces(const Extent<Cursor>& faces) {
    const std::size_t first = mesh_.triangles.size();
    mesh_.triangles.resize(first + faces.triangles);  // Those that are left are {0, 0, 0}.
    for_blocks(faces, [&](const Block<Cursor>& block) {
      return read_faces(faces, block, mesh_.triangles.data() + first + block.triangles);
    });
  }

  std::optional<Problem> read_faces(const Extent<Cursor>& faces, const Block<Cursor>& block,
                                    Triangle* to) {
    const Element& element = *faces.element;
    const bool strips = element.name == "tristrips";
    FaceSplitter splitter(mesh_);
    std::uint64_t skipped = 0;
    Corners corners;
    Cursor at = block.begin;
    for (std::uint64_t i = block.row; i < block.row + block.rows; ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        const auto count = property.count ? at.read_integer(*property.count) : 1;
        if (p != faces.corners) {
          at.skip(property.type, static_cast<std::uint64_t>(*count));  // Measured before.
          continue;
        }
        if (auto wrong = read_corners(property.type, static_cast<std::size_t>(*count), i, strips,
                                      at, corners))
          return wrong;
        if ((strips ? strip(corners.vertices, to) : splitter(corners.vertices, to)) == to)
          ++skipped;
        to += *count < 3 ? 0 : *count - 2;
      }
    }
    skipped_ += skipped;
    return std::nullopt;
  }

  /// Of one face after the other.
  struct Corners {
    std::vector<std::int64_t> numbers;  ///< As the file has them.
    std::vector<std::uint32_t> vertices;
  };

  std::optional<Problem> read_corners(Scalar type, std::size_t count, std::uint64_t row,
                                      bool strips, Cursor& at, Corners& corners) const {
    const Cursor before = at;
    if (!at.read_integers(type, count, corners.numbers))
      return problem_before(at,
                            "face " + std::to_string(row) + " names no vertex by a whole number");
    const std::uint64_t vertices = vertices_.blocks.empty() ? 0 : vertices_.element->count;
    corners.vertices.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t number = corners.numbers[i];
      const bool ends_strip = strips && number == -1;
      corners.vertices[i] = ends_strip ? strip_end : static_cast<std::uint32_t>(number);
      if (static_cast<std::uint64_t>(number) < vertices || ends_strip) continue;
      Cursor there = before;
      there.skip(type, i);
      return problem_before(there, "face " + std::to_string(row) + " names vertex " +
                                       std::to_string(number) + "; there are " +
                                       std::to_string(vertices));
    }
    return std::nullopt;
  }

  /// The triangles of a strip, every second of which runs the other way; returns their end.
  static Triangle* strip(const std::vector<std::uint32_t>& corners, Triangle* to) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] == strip_end) begin = i + 1;
      if (i < begin + 2) continue;
      const std::uint32_t a = corners[i - 2], b = corners[i - 1], c = corners[i];
      if (a == b || b == c || c == a) continue;  // Strips are turned so.
      *to++ = (i - begin) % 2 == 0 ? Triangle{a, b, c} : Triangle{b, a, c};
    }
    return to;
  }

  static constexpr std::uint32_t strip_end = 0xFFFFFFFF;

  std::string_view bytes_;
  const Header& header_;
  const std::string& name_;
  Extent<Cursor> vertices_;
  std::vector<Extent<Cursor>> faces_;
  MeshFile mesh_;
  FirstProblem first_;
  std::atomic<std::uint64_t> skipped_{0};
};

}  // namespace
}  // namespace ply

Result<MeshFile> read_ply(const Bytes& bytes, const std::string& name) {
  const std::string_view view(bytes.data(), bytes.size());
  const auto header = ply::read_header(view, name);
  if (!header) return tl::unexpected(header.error());
  switch (header->format) {
    case ply::Format::ascii:
      return ply::Reader<ply::TextCursor>(view, *header, name).read();
    case ply::Format::little_endian:
      return ply::Reader<ply::BinaryCursor<false>>(view, *header, name).read();
    case ply::Format::big_endian:
      break;
  }
  return ply::Reader<ply::BinaryCursor<true>>(view, *header, name).read();
}

}  // namespace metamer
