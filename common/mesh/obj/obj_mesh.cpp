#include "common/mesh/obj/obj_mesh.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <set>

#include "common/mesh/obj/corner_vertices.h"
#include "common/mesh/obj/lines.h"
#include "common/mesh/obj/piece.h"
#include "common/mesh/parallel.h"
#include "common/mesh/polygon.h"
#include "common/mesh/text.h"
#include "common/mesh/vertex.h"
#include "common/scene/limits.h"

namespace metamer {
namespace obj {
namespace {

constexpr std::size_t piece_size = std::size_t{1} << 18;  // Bytes: a millisecond's work.
constexpr std::size_t most_names = limits::max_objects;   // Of objects with materials.

class FileReader {
 public:
  FileReader(Bytes bytes, const std::string& file)
      : bytes_(std::move(bytes)), text_(bytes_.data(), bytes_.size()), file_(file) {}

  Result<MeshFile> read() {
    split();
    if (auto counted = count_all(); !counted) return tl::unexpected(counted.error());
    if (auto read = read_all(); !read) return tl::unexpected(read.error());
    if (auto named = name_runs(); !named) return tl::unexpected(named.error());
    note(&Faces::free_form, "curves and surfaces (curv, surf)");
    note(&Faces::points_or_lines, "points and lines (p, l)");
    note(&Faces::vertex_colors, "vertex colours (v x y z r g b)");
    make_vertices();
    make_triangles();
    if (mesh_.triangles.empty()) return problem_in("holds no triangles");
    return std::move(mesh_);
  }

 private:
  tl::unexpected<Problem> problem_in(std::string message) const {
    return mesh_text::problem_at(file_, 0, std::move(message));
  }

  void note(bool Faces::*has, const std::string& what) {
    if (std::any_of(faces_.begin(), faces_.end(), [&](const Faces& one) { return one.*has; }))
      mesh_.notes.push_back(what + " were left out");
  }

  /// Cuts the file into pieces for the threads.
  void split() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // UTF-8's mark.
    line_end_ = line_end(text_);
    for (std::size_t begin = 0; begin < text_.size();) {
      const std::size_t end = piece_end(text_, begin + piece_size, line_end_);
      pieces_.push_back(text_.substr(begin, end - begin));
      begin = end;
    }
    faces_.resize(pieces_.size());
  }

  template <typename Work>
  void for_pieces(const Work& work) {
    tbb::parallel_for(std::size_t{0}, faces_.size(), work);
  }

  /// Counts what each piece holds, so that all can be read into their places at once.
  Result<void> count_all() {
    std::vector<Counts> counts(pieces_.size());
    for_pieces([&](std::size_t i) { counts[i] = count(pieces_[i], line_end_); });
    Counts sum;
    for (const Counts& piece : counts) {
      before_.push_back(sum);
      sum.v += piece.v;
      sum.vt += piece.vt;
      sum.vn += piece.vn;
      sum.lines += piece.lines;
    }
    constexpr std::uint64_t most = 3 * limits::max_triangles;
    if (const std::uint64_t largest = std::max({sum.v, sum.vt, sum.vn}); largest > most)
      return problem_in("holds " + std::to_string(largest) + " vertices; at most " +
                        std::to_string(most) + " are allowed");
    vertices_.v.resize(sum.v);
    vertices_.vt.resize(sum.vt);
    vertices_.vn.resize(sum.vn);
    return {};
  }

  Result<void> read_all() {
    FirstProblem first;
    for_pieces([&](std::size_t i) {
      auto wrong = read_piece(pieces_[i], line_end_, before_[i], file_, vertices_, faces_[i]);
      if (wrong) first.keep(i, *std::move(wrong));
    });
    if (first.get()) return tl::unexpected(*first.get());
    pieces_.clear();
    bytes_ = {};
    return {};
  }

  /// Gives each run the place of its triangles: those of equal names lie in a row.
  Result<void> name_runs() {
    std::map<std::pair<std::string, std::string>, std::size_t> numbers;
    std::string object, group, material;
    std::uint32_t smoothing = none;  // Before any s: one group.
    std::set<std::uint32_t> groups;
    for (const Faces& faces : faces_)
      for (const Run& run : faces.runs) {
        object = run.object.value_or(object);
        group = run.group.value_or(group);
        material = run.material.value_or(material);
        smoothing = run.smoothing.value_or(smoothing);
        std::size_t number = 0;
        if (run.triangles > 0) {
          const std::string& name = group.empty() ? object : group;
          const auto [found, added] = numbers.try_emplace({name, material}, mesh_.pieces.size());
          if (added) mesh_.pieces.push_back({.object = name, .material = material});
          if (numbers.size() > most_names)
            return problem_in("names more than " + std::to_string(most_names) + " parts");
          number = found->second;
          mesh_.pieces[number].triangles += run.triangles;
        }
        run_pieces_.push_back(number);
        run_smoothing_.push_back(run.triangles > 0 ? smoothing : none);
        if (run.triangles > 0) groups.insert(smoothing);
      }
    std::uint64_t triangles = 0;
    for (MeshPiece& piece : mesh_.pieces) {
      piece.first_triangle = triangles;
      triangles += piece.triangles;
    }
    if (triangles > limits::max_triangles)
      return problem_in("holds " + std::to_string(triangles) + " triangles; at most " +
                        std::to_string(limits::max_triangles) + " are allowed");
    mesh_.triangles.resize(triangles);  // Those that no face becomes are {0, 0, 0}.
    if (groups.size() > 1)
      mesh_.smoothing.resize(triangles);
    else if (groups.contains(0))
      mesh_.crease_angle = 0;
    return {};
  }

  /// Vertices as renderers have them: one index for v, vt and vn.
  void make_vertices() {
    const bool only_v = vertices_.vt.empty() && vertices_.vn.empty();
    const std::vector<Corner> corners =
        only_v ? std::vector<Corner>() : join_corners(faces_, vertices_.v.size());
    const std::size_t count = only_v ? vertices_.v.size() : corners.size();
    const auto v = [&](std::size_t i) { return vertices_.v[only_v ? i : corners[i].v]; };
    if (needs_f64(vertices_.v)) {
      mesh_.positions_f64.resize(count);
      for_ranges(count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) mesh_.positions_f64[i] = v(i);
      });
    } else {
      mesh_.positions.resize(count);
      for_ranges(count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) mesh_.positions[i] = to_f32(v(i));
      });
    }
    if (!vertices_.vt.empty()) mesh_.uvs.resize(count);
    if (!vertices_.vn.empty()) mesh_.normals.resize(count);
    for_ranges(corners.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto [_, vt, vn] = corners[i];
        if (!mesh_.uvs.empty()) mesh_.uvs[i] = vt == none ? no_uv : vertices_.vt[vt];
        if (!mesh_.normals.empty()) mesh_.normals[i] = vn == none ? Float3{} : vertices_.vn[vn];
      }
    });
    vertices_ = {};
  }

  void make_triangles() {
    // Find where each run's triangles go.
    std::vector<std::uint64_t> next;
    for (const MeshPiece& piece : mesh_.pieces) next.push_back(piece.first_triangle);
    std::vector<std::vector<std::uint64_t>> places(faces_.size());
    for (std::size_t i = 0, number = 0; i < faces_.size(); ++i)
      for (const Run& run : faces_[i].runs) {
        std::uint64_t& place =
            next.empty() ? places[i].emplace_back() : next[run_pieces_[number++]];
        if (next.empty()) continue;
        places[i].push_back(place);
        place += run.triangles;
      }

    // Write them.
    if (!mesh_.smoothing.empty()) keep_smoothing(places);
    std::atomic<std::uint64_t> skipped{0};
    for_pieces([&](std::size_t i) {
      skipped += split_faces(faces_[i], places[i]);
      faces_[i] = {};
    });
    mesh_.skipped_faces = skipped;
    close_gaps();
  }

  void keep_smoothing(const std::vector<std::vector<std::uint64_t>>& places) {
    auto smoothing = run_smoothing_.begin();
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (std::size_t r = 0; r < faces_[i].runs.size(); ++r)
        std::fill_n(mesh_.smoothing.begin() + static_cast<std::ptrdiff_t>(places[i][r]),
                    faces_[i].runs[r].triangles, *smoothing++);
  }

  std::uint64_t split_faces(const Faces& faces, const std::vector<std::uint64_t>& places) {
    FaceSplitter splitter(mesh_);
    std::uint64_t skipped = 0;
    for (std::size_t r = 0; r < faces.runs.size(); ++r) {
      const bool last = r + 1 == faces.runs.size();
      const std::size_t end = last ? faces.corners.size() : faces.runs[r + 1].first_face;
      std::size_t corner = faces.runs[r].first_corner;
      Triangle* to = mesh_.triangles.data() + places[r];
      for (std::size_t f = faces.runs[r].first_face; f < end; ++f) {
        const std::uint32_t count = faces.corners[f];
        if (splitter({faces.v.data() + corner, count}, to) == to) ++skipped;
        to += count < 3 ? 0 : count - 2;
        corner += count;
      }
    }
    return skipped;
  }

  /// Takes out the places that no triangle has taken.
  void close_gaps() {
    const auto is_gap = [](const Triangle& t) { return t[0] == t[1]; };
    std::vector<Triangle>& triangles = mesh_.triangles;
    if (std::none_of(triangles.begin(), triangles.end(), is_gap)) return;
    std::uint64_t kept = 0;
    for (MeshPiece& piece : mesh_.pieces) {
      const std::uint64_t first = std::exchange(piece.first_triangle, kept);
      for (std::uint64_t i = first; i < first + piece.triangles; ++i)
        if (!is_gap(triangles[i])) {
          if (!mesh_.smoothing.empty()) mesh_.smoothing[kept] = mesh_.smoothing[i];
          triangles[kept++] = triangles[i];
        }
      piece.triangles = kept - piece.first_triangle;
    }
    triangles.resize(kept);
    if (!mesh_.smoothing.empty()) mesh_.smoothing.resize(kept);
    std::erase_if(mesh_.pieces, [](const MeshPiece& piece) { return piece.triangles == 0; });
  }

  Bytes bytes_;
  std::string_view text_;  ///< Of them.
  const std::string& file_;
  char line_end_ = '\n';
  std::vector<std::string_view> pieces_;
  std::vector<Counts> before_;
  std::vector<Faces> faces_;
  std::vector<std::size_t> run_pieces_;       ///< Of each run, its number in the file's pieces.
  std::vector<std::uint32_t> run_smoothing_;  ///< And its group; `none` where there is no s.
  Vertices vertices_;
  MeshFile mesh_;
};

}  // namespace
}  // namespace obj

Result<MeshFile> read_obj(Bytes bytes, const std::string& name) {
  return obj::FileReader(std::move(bytes), name).read();
}

}  // namespace metamer
