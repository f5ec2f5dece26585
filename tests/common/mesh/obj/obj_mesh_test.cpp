#include <cmath>

#include "../mesh_text.h"

namespace metamer {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, FacesAreReadHoweverTheyAreSpelt) {
  const std::string with = "vt 0 0\nvt 1 0 0\nvt 1 1\nvn 0 0 2\n";
  for (const std::string& text : std::vector<std::string>{
           square + "f 1 2 3 4\n", square + "f -4 -3 -2 -1", square + "f 1 2 3\nf 1 3 4\n",
           square + "f 1 \\\n 2 3 \\\r\n4\n", square + "  f\t1 2 3 4 # a square\n",
           "f 1 2 3 4\n" + square, square + with + "f 1/1/1 2/2/1 3/3/1 4/1/1\n",
           square + with + "f 1//1 2//1 3//-1 4//1\n", square + with + "f 1/1 2/2 3/-1 4/1\n",
           square + with + "f 1/ 2// 3/3/ 4\n",
           "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\nf 1 2 3 4",
           "# from C:\\models\\\n" + square +
               "mtllib a b.mtl\ns off\nl 1 2\np 1\nvp 0 1\nf 1 2 3 4\n",
           "\xEF\xBB\xBF" + square + "f 1 2 3 4\n", square + "fo 1 2 3 4\n"}) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      std::string other;
      for (const char c : text) other += c == '\n' ? end : std::string(1, c);
      if (end != "\n" && text.find('\r') != text.npos) continue;
      const auto file = obj_of(other);
      ASSERT_TRUE(file) << other << problem_of(file);
      EXPECT_EQ(corners_of(used(file)), square_corners()) << other;
    }
  }
}

TEST(Obj, ACornerIsAVertexForEachOfItsIndices) {
  const auto file = obj_of(square +
                           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 0 3 4\n"
                           "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/2 4\n");
  ASSERT_TRUE(file) << problem_of(file);
  ASSERT_EQ(file->positions.size(), 5u) << "3/3/1 and 3/3/2 are two";
  EXPECT_EQ(file->triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}}));
  EXPECT_EQ(file->uvs[1], (Float2{1, 0}));
  EXPECT_TRUE(std::isnan(file->uvs[4][0]));
  EXPECT_EQ(file->normals[3], (Float3{0, 0.6f, 0.8f}));
  EXPECT_EQ(file->normals[4], (Float3{0, 0, 0})) << "none there";
  EXPECT_EQ(degrees_between(used(file).normals[4], {0, 0, 1}), 0) << "averaged there";
}

TEST(Obj, PiecesBearTheNamesOfObjectsGroupsAndMaterials) {
  const auto file =
      obj_of(square +
             "f 1 2 3\no Chair\nusemtl red leather \nf 1 2 3\nf 1 3 4\ng seat left\nf 2 3 4\n"
             "usemtl\tblue\nf 1 2 4\ng\nf 1 2 3\no Stuhl \xfc"
             "ber\nf 1 2 3\nf 2 2 2\nusemtl red "
             "leather\no Chair\n"
             "f 2 3 4\n");
  ASSERT_TRUE(file) << problem_of(file);
  std::string names;
  for (const MeshPiece& piece : file->pieces)
    names += piece.object + "|" + piece.material + "|" + std::to_string(piece.first_triangle) +
             "+" + std::to_string(piece.triangles) + "\n";
  EXPECT_EQ(names,
            "||0+1\nChair|red leather|1+3\nseat left|red leather|4+1\nseat left|blue|5+1\n"
            "Chair|blue|6+1\nStuhl \u00fcber|blue|7+1\n");
  EXPECT_EQ(file->skipped_faces, 1u);
}

TEST(Obj, PositionsAreF64WhereF32WouldLoseTheirDigits) {
  const std::string far =
      "v 412345.678 310 -5412345.678\nv 412346.678 310 -5412345.678\n"
      "v 412346.678 311.25 -5412345.678\nf 1 2 3\n";
  const auto file = obj_of(far);
  ASSERT_TRUE(file);
  ASSERT_EQ(file->positions_f64.size(), 3u);
  EXPECT_EQ(file->positions_f64[1], (Double3{412346.678, 310, -5412345.678}));
  const auto near = obj_of(square + "f 1 2 3\n");
  ASSERT_TRUE(near);
  EXPECT_EQ(near->positions.size(), 4u);
}

TEST(Obj, AProblemIsLocatedByItsLine) {
  const std::pair<std::string, std::string> broken[] = {
      {"", "a.obj: error: holds no triangles"},
      {"\xff\xfe\n\n", "a.obj: error: holds no triangles"},
      {square, "a.obj: error: holds no triangles"},
      {square + "f 1 2\nf\n", "a.obj: error: holds no triangles"},
      {square + "f 1 2 5\n", "a.obj:5: error: names v 5; there are 4"},
      {square + "f 1 2 -5\n", "a.obj:5: error: names v -5; there are 4 before it"},
      {"f 1 2 -1\n" + square, "a.obj:1: error: names v -1; there are 0 before it"},
      {square + "f 1 2 0\n", "a.obj:5: error: counts from 1; 0 is no number of a vertex"},
      {square + "f 1/1 2/1 3/1\n", "a.obj:5: error: names vt 1; there are 0"},
      {square + "f 1//2 2//1 3//1\nvn 0 0 1", "a.obj:5: error: names vn 2; there are 1"},
      {square + "f 1 2 x\xff\n",
       "a.obj:5: error: corner \"x\u00ff\" is none of v, v/vt, v//vn and v/vt/vn"},
      {square + "f 1 2 99999999999999999999\n",
       "a.obj:5: error: corner \"99999999999999999999\" is none of v, v/vt, v//vn and v/vt/vn"},
      {"v 0 \\\n0\n" + square + "f 1 2 3", "a.obj:1: error: v has three numbers"},
      {square + "\n# a\nv 1 2 \\\n3\nv 1 nan 2\n",
       "a.obj:9: error: v is not finite or too far out"},
      {square + "v 1e16 0 0\n", "a.obj:5: error: v is not finite or too far out"},
      {square + "v 1,5 0 0\n", "a.obj:5: error: v has three numbers"},
      {square + "vt\n", "a.obj:5: error: vt has one to three numbers"},
      {square + "vt nan 0\n", "a.obj:5: error: vt is not finite or too far out"},
      {square + "vt 0 -inf\n", "a.obj:5: error: vt is not finite or too far out"},
      {square + "vt 1e39 0\n", "a.obj:5: error: vt is not finite or too far out"},
      {square + "vn 0 1\n", "a.obj:5: error: vn has three numbers"},
  };
  for (const auto& [text, message] : broken) EXPECT_EQ(problem_of(obj_of(text)), message) << text;
}

TEST(Obj, ALargeFileIsReadAsItsPiecesWouldBe) {
  std::string text;
  for (int i = 0; i < 40000; ++i) {
    const std::string x = std::to_string(i);
    text += "v " + x + " 0 0\nv " + x + " 1 0\nv " + x + " 0 1\n" +
            (i % 2 == 0 ? "usemtl even\n" : "usemtl odd\n") + "f -3 -2 \\\n -1\n";
  }
  const auto file = obj_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  ASSERT_EQ(file->pieces.size(), 2u);
  EXPECT_EQ(file->pieces[1].material, "odd");
  EXPECT_EQ(file->pieces[1].first_triangle, 20000u);
  for (std::uint32_t i = 0; i < 20000; ++i)
    ASSERT_EQ(file->triangles[20000 + i], (Triangle{6 * i + 3, 6 * i + 4, 6 * i + 5}));
  EXPECT_EQ(problem_of(obj_of(text + "f 1 2 120001")),
            "a.obj:240001: error: names v 120001; there are 120000");
}

TEST(Obj, CurvedSurfacesAreLeftOutWithANote) {
  const auto file = obj_of(square + "f 1 2 3\ncstype bezier\nsurf 0 1 0 1 1 2 3 4\nend\n");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->notes,
            std::vector<std::string>{"curves and surfaces (curv, surf) were left out"});
}

TEST(Obj, VertexColoursPointsAndLinesAreLeftOutWithANote) {
  const auto notes = [](const std::string& end_of_v, const std::string& last) {
    const auto file = obj_of("v 0 0 0\nv 1 0 0\nv 0 1 0" + end_of_v + "\nf 1 2 3\n" + last);
    EXPECT_TRUE(file) << problem_of(file);
    return file ? file->notes : std::vector<std::string>();
  };
  using Notes = std::vector<std::string>;
  for (const char* none : {"", " ", " 1", " # 1 0 0", " 1 0"}) EXPECT_EQ(notes(none, ""), Notes());
  for (const char* color : {" 1 0 0", " 0.5 .25 1e-1", "\t1 0 0 1", " 1 0 0 # red"})
    EXPECT_EQ(notes(color, ""), Notes{"vertex colours (v x y z r g b) were left out"}) << color;
  for (const char* line : {"l 1 2\n", "p 1\n"})
    EXPECT_EQ(notes("", line), Notes{"points and lines (p, l) were left out"}) << line;
}

TEST(Obj, NoByteBreaksTheReader) {
  expect_no_byte_breaks(
      square +
          "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\no a\nusemtl b\nf 1/1/1 2/2/1 3/3/-1\n"
          "g c\nf 1 2 \\\n 3 4\nf -1 -2 -3\nf 1 2\n",
      obj_of);
}

}  // namespace
}  // namespace metamer
