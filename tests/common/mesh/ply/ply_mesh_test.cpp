#include <cmath>
#include <cstring>

#include "../mesh_text.h"

namespace metamer {
namespace {

const std::string square_vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

/// A header of floats x y z and of faces, and what follows it.
std::string ascii(int vertices, int faces, const std::string& body,
                  const std::string& list = "list uchar int vertex_indices") {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(faces) + "\nproperty " + list + "\nend_header\n" + body;
}

TEST(Ply, AFaceIsSkippedThatSpansNoTriangle) {
  for (const char* other :
       {"0\n", "1 2\n", "2 0 1\n", "3 0 1 1\n", "3 2 2 2\n", "4 1 3 1 3\n", "3 0 1 0\n"})
    for (const bool first : {false, true}) {
      const std::string squares = "3 0 1 2\n3 0 2 3\n";
      const auto file =
          ply_of(ascii(4, 3, square_vertices + (first ? other + squares : squares + other)));
      ASSERT_TRUE(file) << other << problem_of(file);
      EXPECT_EQ(file->skipped_faces, 1u) << other;
      EXPECT_EQ(corners_of(used(file)), square_corners()) << other;
    }
}

TEST(Ply, PropertiesStandInAnyOrderAndOthersArePassedOver) {
  const std::string face =
      "element face 1\nproperty uchar red\nproperty list uchar float texcoord\n"
      "property list int uint vertex_index\nend_header\n";
  const auto file = ply_of(
      "ply\ncomment of nothing\nformat ascii 1.0\nobj_info num_cols 512\nelement camera 1\n"
      "property list uint8 float32 view\nproperty float focal\nelement vertex 4\nproperty uchar "
      "red\n"
      "property float64 z\nproperty list uchar short tags\nproperty float32 t\nproperty short y\n"
      "property float s\nproperty int8 x\n" +
      face +
      "3 1 2 3 0.5\n7 0 0 0.1 0 0.2 0\n7 0 2 5 5 0.1 0 0.2 1\n7 0 0 0.3 1 0.4 1\n7 0 1 3 0.3 1 0.4 "
      "0\n"
      "9 8 0 0 1 0 1 1 0 1 4 0 1 2 3\n");
  ASSERT_TRUE(file) << problem_of(file);
  EXPECT_EQ(corners_of(used(file)), square_corners());
  ASSERT_EQ(file->uvs.size(), 4u);
  EXPECT_EQ(file->uvs[2], (Float2{0.4f, 0.3f}));
  EXPECT_EQ(file->positions_f64.size(), 4u) << "z is f64";
  EXPECT_EQ(file->notes,
            std::vector<std::string>{"texture coordinates of faces (texcoord) were left out"});
}

TEST(Ply, AUvThatIsNotFiniteHasItsLine) {
  for (const char* bad : {"nan 0", "0 inf", "-1e39 0"}) {
    const auto file = ply_of(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
        "float z\nproperty double s\nproperty double t\nelement face 1\nproperty list uchar uint "
        "vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 " +
        std::string(bad) + "\n0 1 0 1 1\n3 0 1 2\n");
    EXPECT_EQ(problem_of(file), "a.ply:13: error: the UV of vertex 1 is not finite or too far out");
  }
}

TEST(Ply, ColoursAndEdgesAreLeftOutWithANote) {
  const auto notes = [](const std::string& of_vertex, const std::string& of_face,
                        const std::string& last) {
    const auto colors = [](const std::string& prefix) {
      std::string text;
      for (const char* one : {"red", "green", "blue"})
        text += "property uchar " + prefix + one + "\n";
      return text;
    };
    const bool vertex = of_vertex != "none", face = of_face != "none";
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\n" +
        (vertex ? colors(of_vertex) : "") +
        "element face 1\nproperty list uchar int vertex_index\n" + (face ? colors(of_face) : "") +
        last + "end_header\n";
    for (const char* position : {"0 0 0", "1 0 0", "0 1 0"})
      text += position + std::string(vertex ? " 255 0 0\n" : "\n");
    text += "3 0 1 2" + std::string(face ? " 0 0 255\n" : "\n");
    const auto file = ply_of(text);
    EXPECT_TRUE(file) << problem_of(file);
    return file ? file->notes : std::vector<std::string>();
  };
  using Notes = std::vector<std::string>;
  EXPECT_EQ(notes("none", "none", ""), Notes());
  const std::string of_vertices = "vertex colours (red, green, blue) were left out";
  EXPECT_EQ(notes("", "none", ""), Notes{of_vertices});
  EXPECT_EQ(notes("diffuse_", "none", ""), Notes{of_vertices});
  EXPECT_EQ(notes("none", "", ""), Notes{"colours of faces (red, green, blue) were left out"});
  EXPECT_EQ(notes("none", "none", "element edge 0\nproperty int vertex1\n"), Notes());
  EXPECT_EQ(notes("", "", "").size(), 2u);
}

TEST(Ply, LinesEndInAnyWayAndValuesStandOnAnyLine) {
  const std::string text = ascii(4, 2, square_vertices + "3 0 1 2\n3 0 2 3");
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? end : std::string(1, c);
    const auto file = ply_of(other);
    ASSERT_TRUE(file) << problem_of(file);
    EXPECT_EQ(corners_of(used(file)), square_corners());
  }
  const auto one_line = ply_of(ascii(4, 1, "0 0 0 1 0 0 1 1\t0\n\n0 1\n0 4 0 1 2 3.0"));
  ASSERT_TRUE(one_line) << problem_of(one_line);
  EXPECT_EQ(corners_of(used(one_line)), square_corners());
}

TEST(Ply, StripsTurnAtMinusOne) {
  const auto file = ply_of(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 1 2 3 -1 0 0 1 2\n");
  ASSERT_TRUE(file) << problem_of(file);
  EXPECT_EQ(file->triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {1, 0, 2}}));
}

TEST(Ply, AProblemIsLocated) {
  const std::pair<std::string, std::string> broken[] = {
      {"", "a.ply:1: error: a PLY begins with the line \"ply\""},
      {"plyx\nformat ascii 1.0\n", "a.ply:1: error: a PLY begins with the line \"ply\""},
      {"ply\nformat ascii 1.0\n", "a.ply:2: error: the header has no end_header"},
      {"ply\nformat binary 1.0\nend_header\n",
       "a.ply:2: error: format \"binary\" is neither ascii, binary_little_endian nor "
       "binary_big_endian"},
      {"ply\nformat ascii 1.0\nelement vertex -4\nend_header\n",
       "a.ply:3: error: element count \"-4\" is no whole number from 0"},
      {"ply\nformat ascii 1.0\nelement vertex 1e39\nend_header\n",
       "a.ply:3: error: element count \"1e39\" is no whole number from 0"},
      {"ply\nformat ascii 1.0\nelement vertex 4\nproperty half x\nend_header\n",
       "a.ply:4: error: type \"half\" is none of PLY's"},
      {"ply\nformat ascii 1.0\nwhat\xff\xfe\nend_header\n",
       "a.ply:3: error: word \"what\u00ff\u00fe\" is none of a PLY's header"},
      {ascii(4, 1, square_vertices + "3 0 1 4\n"),
       "a.ply:14: error: face 0 names vertex 4; there are 4"},
      {ascii(4, 2, square_vertices + "3 0 1 2\n3 0 1 -1\n"),
       "a.ply:15: error: face 1 names vertex -1; there are 4"},
      {ascii(4, 1, square_vertices + "-3 0 1 2\n"), "a.ply:14: error: a list has -3 values"},
      {ascii(4, 1, square_vertices + "3 0 1\n"), "a.ply:15: error: ends in face 0 of 1"},
      {ascii(4, 1, square_vertices + "3 0 1 x\n"),
       "a.ply:14: error: face 0 names no vertex by a whole number"},
      {ascii(4, 1, square_vertices + "3 0 1 1.5\n"),
       "a.ply:14: error: face 0 names no vertex by a whole number"},
      {ascii(4, 1, "0 0 0\n1 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
       "a.ply:12: error: vertex 2 is not finite or too far out"},
      {ascii(4, 1, "0 0 0\n1 0 0\n1 1e39 0\n0 1 0\n3 0 1 2\n"),
       "a.ply:12: error: vertex 2 is not finite or too far out"},
      {ascii(4, 1, "0 0 0\n1 0 0\n1 1 zero\n0 1 0\n3 0 1 2\n"),
       "a.ply:12: error: vertex 2 has something else than a number"},
      {ascii(2000000000, 1, square_vertices + "3 0 1 2\n"),
       "a.ply: error: says that it holds 2000000000 of \"vertex\"; its bytes are too few"},
      {ascii(4, 0, square_vertices), "a.ply: error: holds no triangles"},
      {ascii(4, 1, square_vertices + "3 0 1 1\n"), "a.ply: error: holds no triangles"},
      {"ply\nformat ascii 1.0\nelement vertex 0\nend_header\n",
       "a.ply: error: holds no faces with vertex_indices"},
  };
  for (const auto& [text, message] : broken) EXPECT_EQ(problem_of(ply_of(text)), message) << text;
}

TEST(Ply, AFaceOutOfManyIsNamedWhicheverThreadMeetsItFirst) {
  std::string faces;
  for (int i = 0; i < 50000; ++i) faces += i == 40000 || i == 49999 ? "3 0 1 7\n" : "3 0 1 2\n";
  EXPECT_EQ(problem_of(ply_of(ascii(4, 50000, square_vertices + faces))),
            "a.ply:40014: error: face 40000 names vertex 7; there are 4");
}

// What is written is read: each type of a position, in each format.

template <typename T>
void put(std::string& to, T value, const std::string& format) {
  if (format == "ascii") {
    to += number_text(static_cast<double>(value)) + " ";
    return;
  }
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (format == "binary_big_endian") std::reverse(bytes, bytes + sizeof(T));
  to.append(bytes, sizeof(T));
}

template <typename T>
void expect_read_back(const std::string& type) {
  constexpr bool real = std::is_floating_point_v<T>;
  const T high = static_cast<T>(real ? T(12345.678901234)
                                     : std::min<double>(1e9, std::numeric_limits<T>::max()));
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const std::string index :
         {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"}) {
      std::string body;
      const T positions[] = {0, 0, 0, high, 1, 2, 3, high, 5};
      for (const T value : positions) put(body, value, format);
      put(body, std::uint8_t{3}, format);
      for (int i = 0; i < 3; ++i) {
        const int size = index == "double"          ? 8
                         : index.ends_with("char")  ? 1
                         : index.ends_with("short") ? 2
                                                    : 4;
        if (index == "float")
          put(body, static_cast<float>(i), format);
        else if (size == 8)
          put(body, static_cast<double>(i), format);
        else if (size == 4)
          put(body, std::int32_t{i}, format);
        else if (size == 2)
          put(body, static_cast<std::int16_t>(i), format);
        else
          put(body, static_cast<std::int8_t>(i), format);
      }
      std::string text = "ply\nformat " + format + " 1.0\nelement vertex 3\n";
      for (const char* name : {"x", "y", "z"}) text += "property " + type + " " + name + "\n";
      text +=
          "element face 1\nproperty list uchar " + index + " vertex_indices\nend_header\n" + body;
      const auto file = ply_of(text);
      ASSERT_TRUE(file) << type << format << index << problem_of(file);
      const TriangleMesh mesh = used(file);
      ASSERT_EQ(mesh.positions.size(), 3u);
      for (std::size_t i = 0; i < 9; ++i)
        EXPECT_EQ(mesh.positions[i / 3][i % 3], static_cast<double>(positions[i]))
            << type << " " << format << " " << index << " " << i;
    }
}

TEST(Ply, EachTypeIsReadInEachFormatAsItWasWritten) {
  for (const char* type : {"char", "int8"}) expect_read_back<std::int8_t>(type);
  for (const char* type : {"uchar", "uint8"}) expect_read_back<std::uint8_t>(type);
  for (const char* type : {"short", "int16"}) expect_read_back<std::int16_t>(type);
  for (const char* type : {"ushort", "uint16"}) expect_read_back<std::uint16_t>(type);
  for (const char* type : {"int", "int32"}) expect_read_back<std::int32_t>(type);
  for (const char* type : {"uint", "uint32"}) expect_read_back<std::uint32_t>(type);
  for (const char* type : {"float", "float32"}) expect_read_back<float>(type);
  for (const char* type : {"double", "float64"}) expect_read_back<double>(type);
}

TEST(Ply, ABinaryFileThatIsCutShortIsRefused) {
  std::string body;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
    put(body, value, "little");
  put(body, std::uint8_t{3}, "little");
  for (const int i : {0, 1, 2}) put(body, i, "little");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_TRUE(ply_of(header + body));
  for (std::size_t size = 0; size < body.size(); ++size)
    EXPECT_FALSE(ply_of(header + body.substr(0, size))) << size;
  EXPECT_EQ(problem_of(ply_of(header + body.substr(0, 40))), "a.ply: error: ends in face 0 of 1");
}

TEST(Ply, ASurveysCoordinatesKeepTheirDigits) {
  // The case's own spelling: a file in f64, 5,400 km from its origin, and the same beside it.
  std::string far, near;
  for (int i = 0; i < 900; ++i) {
    const int x = i % 30, y = i / 30;
    char line[100];
    std::snprintf(line, sizeof line, "%.3f %.3f %.3f\n", 412345.678 + x * 0.04, 310.25 + y * 0.04,
                  -5412345.678);
    far += line;
    std::snprintf(line, sizeof line, "%.3f %.3f 0\n", x * 0.04, y * 0.04);
    near += line;
  }
  std::string faces;
  for (int i = 0; i < 29; ++i)
    faces += "3 " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 31) +
             "\n";
  std::string wide = ascii(900, 29, far + faces);
  for (std::size_t at; (at = wide.find("float")) != wide.npos;) wide.replace(at, 5, "double");
  const TriangleMesh survey = used(ply_of(wide)),
                     local = used(ply_of(ascii(900, 29, near + faces)));
  ASSERT_EQ(survey.triangles.size(), local.triangles.size());
  const Double3 origin{412345.678, 310.25, -5412345.678};
  for (std::size_t i = 0; i < 900; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(survey.positions[i][k] - origin[k], local.positions[i][k], 1e-6);
  for (std::size_t i = 0; i < 29; ++i)
    EXPECT_LT(degrees_between(survey.normals[i], local.normals[i]), 1e-3);
}

TEST(Ply, MutatedFilesEndInMeshesOrProblems) {
  for (const char* name : {"crash-1-0-m.ply", "crash-1-18-m.ply", "crash-1-36-m.ply",
                           "crash-2-2-m.ply", "crash-2-38-m.ply"}) {
    const auto file = ply_of(case_text(name));
    if (file)
      used(file);
    else
      EXPECT_FALSE(file.error().message.empty()) << name;
  }
}

TEST(Ply, NoByteBreaksTheReader) {
  std::string body;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
    put(body, value, "little");
  put(body, std::uint8_t{4}, "little");
  for (const int i : {0, 1, 2, 3}) put(body, i, "little");
  expect_no_byte_breaks(
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
          body,
      ply_of);
  expect_no_byte_breaks(ascii(4, 3, square_vertices + "3 0 1 2\n0\n4 0 1 2 3\n"), ply_of);
  expect_no_byte_breaks(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty int "
      "z\n"
      "property float u\nproperty float v\nelement tristrips 1\nproperty list int int "
      "vertex_index\n"
      "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n1 1 0 1 1\n9 0 1 2 3 -1 0 0 1 2\n",
      ply_of);
}

}  // namespace
}  // namespace metamer
