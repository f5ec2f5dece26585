#include "mesh_text.h"

namespace metamer {
namespace {

const std::string chairs =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 1 1 5\n"
    "o chair\nusemtl wood\nf 5 6 7\nusemtl fabric\nf 1 2 3\n"
    "o table\nusemtl wood\nf 1 3 4\nusemtl glass\nf 2 3 4\no wood\nusemtl glass\nf 2 5 6\n";

/// A corner of each triangle of a part, or what is wrong with it.
std::string part(const std::string& file, const std::string& name) {
  const auto read = obj_of(file);
  const auto mesh = triangles_of(*read, {.part = name});
  if (!mesh) return mesh.error().message;
  std::string text;
  for (const Triangle& t : mesh->triangles) {
    for (const std::uint32_t vertex : t)
      for (const double x : mesh->positions[vertex]) text += number_text(x);
    text += " ";
  }
  return text + std::to_string(mesh->positions.size());
}

TEST(Parts, AreOneObjectsOneMaterialsOrBoth) {
  EXPECT_EQ(part(chairs, "chair"), "005105115 000100110 6");
  EXPECT_EQ(part(chairs, "fabric"), "000100110 3") << "only the vertices that are used";
  EXPECT_EQ(part(chairs, "table"), "000110010 100110010 4");
  EXPECT_EQ(part(chairs, "table/wood"), "000110010 3");
  EXPECT_EQ(part(chairs, "glass"), "100110010 100005105 5") << "of both objects";
}

TEST(Parts, AnUnknownNameSaysWhichThereAre) {
  EXPECT_EQ(
      part(chairs, "fabirc"),
      "has no part \"fabirc\" (it has \"chair\", \"table\", \"wood\", \"fabric\", \"glass\"); "
      "did you mean \"fabric\"?");
  EXPECT_EQ(part(chairs, "chair/glass"),
            "has no part \"chair/glass\" (it has \"chair\", \"table\", \"wood\", \"fabric\", "
            "\"glass\")");
  EXPECT_EQ(part("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "a"),
            "has no part \"a\": nothing in it has a name");
  std::string many = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (int i = 0; i < 25; ++i) many += "g g" + std::to_string(i) + "\nf 1 2 3\n";
  EXPECT_TRUE(part(many, "x").ends_with("\"g19\" and 5 more)")) << part(many, "x");
}

TEST(Parts, ANameOfAnObjectAndOfAnothersMaterialIsAmbiguous) {
  EXPECT_EQ(part(chairs, "wood"),
            "part \"wood\" is an object and another's material; write \"object/material\"");
  EXPECT_EQ(part(chairs, "wood/glass"), "100005105 3");
  const std::string one = "v 0 0 0\nv 1 0 0\nv 1 1 0\no wood\nusemtl wood\nf 1 2 3\n";
  EXPECT_EQ(part(one, "wood"), "000100110 3") << "the same triangles by either";
}

TEST(Parts, AFileOfSeveralMaterialsThatIsUsedWholeSaysSo) {
  EXPECT_EQ(used(obj_of(chairs)).notes,
            std::vector<std::string>{"its materials (\"wood\", \"fabric\", \"glass\") are all the "
                                     "object's; a part has its own"});
  EXPECT_TRUE(used(obj_of(chairs), {.part = "fabric"}).notes.empty());
}

TEST(Parts, NormalsAreOfThePartAlone) {
  // Beside a wall at right angles, the floor stays level.
  const std::string room =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nusemtl floor\n"
      "f 1 2 3 4\nusemtl wall\nf 1 5 6 2\n";
  for (const Float3& normal : used(obj_of(room), {.part = "floor"}).normals)
    EXPECT_EQ(normal, (Float3{0, 0, 1}));
}

TEST(Parts, VerticesThatAFileRepeatsForEachTriangleAreJoined) {
  const std::string twice = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv -0 1 0\n";
  const TriangleMesh mesh = used(obj_of(twice + "f 1 2 3\nf 4 5 6\n"));
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(corners_of(mesh), square_corners());
  const TriangleMesh own = used(obj_of(twice + "vn 0 0 1\nf 1//1 2//1 3//1\nf 4//1 5//1 6//1\n"));
  EXPECT_EQ(own.positions.size(), 6u) << "with normals of their own they stay";
}

}  // namespace
}  // namespace metamer
