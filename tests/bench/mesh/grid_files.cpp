#include "grid_files.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace metamer {
namespace {

/// A square of so many vertices a side.
struct Grid {
  std::uint32_t side;

  std::size_t vertices() const { return std::size_t{side} * side; }
  std::size_t triangles() const { return 2 * std::size_t{side - 1} * (side - 1); }

  template <typename Visit>  // (x y z, nx ny nz)
  void for_vertices(const Visit& visit) const {
    for (std::uint32_t row = 0; row < side; ++row)
      for (std::uint32_t column = 0; column < side; ++column) {
        const double x = column / (side - 1.0), y = row / (side - 1.0);
        const double dx = 1.3 * std::cos(13 * x) * std::cos(9 * y);
        const double dy = -0.9 * std::sin(13 * x) * std::sin(9 * y);
        const double length = std::sqrt(dx * dx + dy * dy + 1);
        visit(
            std::array<float, 3>{static_cast<float>(x), static_cast<float>(y),
                                 static_cast<float>(0.1 * std::sin(13 * x) * std::cos(9 * y))},
            std::array<float, 3>{static_cast<float>(-dx / length), static_cast<float>(-dy / length),
                                 static_cast<float>(1 / length)});
      }
  }
  template <typename Visit>  // (a, b, c)
  void for_triangles(const Visit& visit) const {
    for (std::uint32_t row = 0; row + 1 < side; ++row)
      for (std::uint32_t column = 0; column + 1 < side; ++column) {
        const std::uint32_t a = row * side + column;
        visit(std::array<std::uint32_t, 3>{a, a + 1, a + side + 1});
        visit(std::array<std::uint32_t, 3>{a, a + side + 1, a + side});
      }
  }
};

/// Bytes of a vertex and its two triangles, about.
double bytes_per_vertex(GridFormat format, bool normals) {
  switch (format) {
    case GridFormat::ply:
      return normals ? 50 : 38;
    case GridFormat::ply_text:
      return normals ? 100 : 72;
    case GridFormat::obj:
      return normals ? 158 : 74;
    case GridFormat::glb:
      break;
  }
  return normals ? 48 : 36;
}

/// A file that is written in large blocks.
class Writer {
 public:
  explicit Writer(const std::filesystem::path& path) : file_(path, std::ios::binary) {}
  ~Writer() { file_.write(text_.data(), static_cast<std::streamsize>(text_.size())); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void add(const std::string& text) { append(text.data(), text.size()); }
  template <typename T, std::size_t n>
  void add_bytes(const std::array<T, n>& values) {
    append(reinterpret_cast<const char*>(values.data()), sizeof values);
  }
  template <typename... Arguments>
  void print(const char* format, Arguments... arguments) {
    std::array<char, 200> line{};
    const int size = std::snprintf(line.data(), line.size(), format, arguments...);
    append(line.data(), static_cast<std::size_t>(size));
  }

 private:
  void append(const char* bytes, std::size_t size) {
    text_.append(bytes, size);
    if (text_.size() < (std::size_t{1} << 20)) return;
    file_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    if (!file_) throw std::runtime_error("the folder is full");
    text_.clear();
  }
  std::ofstream file_;
  std::string text_;
};

void write_ply(const Grid& grid, bool text, bool normals, Writer& to) {
  to.print("ply\nformat %s 1.0\nelement vertex %zu\n", text ? "ascii" : "binary_little_endian",
           grid.vertices());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    if (normals || name[0] != 'n') to.print("property float %s\n", name);
  to.print("element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
           grid.triangles());
  grid.for_vertices([&](const auto& p, const auto& n) {
    if (!text) {
      to.add_bytes(p);
      if (normals) to.add_bytes(n);
    } else {
      to.print("%.6f %.6f %.6f", p[0], p[1], p[2]);
      if (normals) to.print(" %.6f %.6f %.6f", n[0], n[1], n[2]);
      to.add("\n");
    }
  });
  grid.for_triangles([&](const auto& t) {
    if (text) return to.print("3 %u %u %u\n", t[0], t[1], t[2]);
    to.add("\3");
    to.add_bytes(t);
  });
}

void write_obj(const Grid& grid, bool normals, Writer& to) {
  grid.for_vertices([&](const auto& p, const auto& n) {
    to.print("v %.6f %.6f %.6f\n", p[0], p[1], p[2]);
    if (normals) to.print("vn %.4f %.4f %.4f\n", n[0], n[1], n[2]);
  });
  grid.for_triangles([&](const auto& t) {
    const auto a = t[0] + 1, b = t[1] + 1, c = t[2] + 1;
    if (normals)
      to.print("f %u//%u %u//%u %u//%u\n", a, a, b, b, c, c);
    else
      to.print("f %u %u %u\n", a, b, c);
  });
}

std::string accessor(std::size_t view, int component, std::size_t count, const char* type) {
  return "{\"bufferView\":" + std::to_string(view) +
         ",\"componentType\":" + std::to_string(component) + ",\"count\":" + std::to_string(count) +
         ",\"type\":\"" + type + "\"" +
         (view == 0 ? ",\"min\":[0,0,-0.1],\"max\":[1,1,0.1]}" : "}");
}

void write_glb(const Grid& grid, bool normals, Writer& to) {
  // Positions, normals where there are any, indices: a view and an accessor each.
  const std::size_t vectors = normals ? 2 : 1;
  std::string views, accessors;
  for (std::size_t i = 0; i <= vectors; ++i) {
    const std::size_t size = i < vectors ? 12 * grid.vertices() : 12 * grid.triangles();
    views += (i > 0 ? "," : "") + std::string("{\"buffer\":0,\"byteOffset\":") +
             std::to_string(12 * grid.vertices() * i) + ",\"byteLength\":" + std::to_string(size) +
             "}";
    accessors +=
        (i > 0 ? "," : "") + (i < vectors ? accessor(i, 5126, grid.vertices(), "VEC3")
                                          : accessor(i, 5125, 3 * grid.triangles(), "SCALAR"));
  }
  const std::size_t size = 12 * (vectors * grid.vertices() + grid.triangles());
  std::string json =
      "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
      "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0" +
      std::string(normals ? ",\"NORMAL\":1" : "") + "},\"indices\":" + std::to_string(vectors) +
      "}]}],\"buffers\":[{\"byteLength\":" + std::to_string(size) + "}],\"bufferViews\":[" + views +
      "],\"accessors\":[" + accessors + "]}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto u32 = [](std::size_t value) { return static_cast<std::uint32_t>(value); };
  to.add_bytes(std::array<std::uint32_t, 5>{0x46546C67, 2, u32(28 + json.size() + size),
                                            u32(json.size()), 0x4E4F534A});
  to.add(json);
  to.add_bytes(std::array<std::uint32_t, 2>{u32(size), 0x004E4942});
  grid.for_vertices([&](const auto& p, const auto&) { to.add_bytes(p); });
  if (normals) grid.for_vertices([&](const auto&, const auto& n) { to.add_bytes(n); });
  grid.for_triangles([&](const auto& t) { to.add_bytes(t); });
}

}  // namespace

std::string format_name(GridFormat format) {
  switch (format) {
    case GridFormat::ply:
      return "PLY";
    case GridFormat::ply_text:
      return "PLY, ascii";
    case GridFormat::obj:
      return "OBJ";
    case GridFormat::glb:
      break;
  }
  return "GLB";
}

std::filesystem::path write_grid(GridFormat format, bool normals, std::size_t bytes,
                                 const std::filesystem::path& folder) {
  const double vertices = static_cast<double>(bytes) / bytes_per_vertex(format, normals);
  const Grid grid{.side = static_cast<std::uint32_t>(std::sqrt(vertices)) + 2};
  const char* const extension = format == GridFormat::obj   ? "obj"
                                : format == GridFormat::glb ? "glb"
                                                            : "ply";
  const std::filesystem::path path = folder / (std::string("grid.") + extension);
  Writer to(path);
  if (format == GridFormat::obj)
    write_obj(grid, normals, to);
  else if (format == GridFormat::glb)
    write_glb(grid, normals, to);
  else
    write_ply(grid, format == GridFormat::ply_text, normals, to);
  return path;
}

}  // namespace metamer
