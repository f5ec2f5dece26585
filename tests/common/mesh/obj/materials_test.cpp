// What a .mtl says is read as far as it can be, and what can't is told.
#include "common/mesh/obj/materials.h"

#include <gtest/gtest.h>

namespace metamer {
namespace {

using Strings = std::vector<std::string>;

TEST(Mtl, SaysColoursHighlightsAndWhatElseThereIs) {
  const MtlFile file = read_mtl(
      "\xEF\xBB\xBFnewmtl red paint \r\nKd 0.8 0.1 0.05 # matt\r\nKs 0.5\r\n  Ns 250\r\nillum 2\r\n"
      "newmtl glass\nKd 0 0 \\\n0.25\nd 0.5\nTr 0.5\nKe 0 0 0\nillum 1\n"
      "newmtl \xE9\nmap_Kd -s 1 1 1 x.png\nKe 1 1 1\nKe 2 2 2\nd 1\nTr 0\n");
  EXPECT_EQ(file.notes, Strings());
  ASSERT_EQ(file.materials.size(), 3u);
  const MtlMaterial& red = file.materials[0];
  EXPECT_EQ(red.name, "red paint");
  EXPECT_EQ(red.diffuse, (Double3{0.8, 0.1, 0.05}));
  EXPECT_EQ(red.specular, (Double3{0.5, 0.5, 0.5}));
  EXPECT_EQ(red.exponent, 250);
  EXPECT_TRUE(red.shows_highlight);
  EXPECT_EQ(red.left_out, Strings());
  EXPECT_EQ(file.materials[1].diffuse, (Double3{0, 0, 0.25}));
  EXPECT_FALSE(file.materials[1].shows_highlight);
  EXPECT_EQ(file.materials[1].left_out, (Strings{"d", "Tr"}));
  EXPECT_EQ(file.materials[2].name, "é");
  EXPECT_FALSE(file.materials[2].diffuse);
  EXPECT_TRUE(file.materials[2].is_textured);
  EXPECT_EQ(file.materials[2].left_out, Strings{"Ke"});
}

TEST(Mtl, WhatCannotBeReadIsTold) {
  const MtlFile file = read_mtl(
      "Kd 1 1 1\nnewmtl a\nKd nan 1 1\nKs 1 2\nNs x\nKd spectral a.rfl\nnewmtl a\nKd 1 1 1\n");
  EXPECT_EQ(file.notes,
            (Strings{"line 3, \" nan 1 1\" as a value of \"a\"",
                     "line 4, \" 1 2\" as a value of \"a\"", "line 5, \" x\" as a value of \"a\"",
                     "line 6, \" spectral a.rfl\" as a value of \"a\"",
                     "line 7, material \"a\" once more"}));
  ASSERT_EQ(file.materials.size(), 1u);
  EXPECT_FALSE(file.materials[0].diffuse);
}

TEST(Mtl, IsBounded) {
  std::string many;
  for (int i = 0; i < 5000; ++i) many += "newmtl m" + std::to_string(i) + "\nKd x\n";
  const MtlFile file = read_mtl(many);
  EXPECT_EQ(file.materials.size(), max_mtl_names);
  EXPECT_EQ(file.notes.size(), 11u);
  EXPECT_EQ(read_mtl("").materials.size(), 0u);
}

TEST(MtlNames, AreThoseOfLinesThatSaySo) {
  EXPECT_EQ(mtl_names("# mtllib no.mtl\n  mtllib a b.mtl \r\nv 0 0 0\nmtllib\nmtllibs x\n"
                      "mtllib a b.mtl\nusemtl mtllib\nmtllib c.mtl"),
            (Strings{"a b.mtl", "c.mtl"}));
  EXPECT_EQ(mtl_names("mtllib a\rmtllib b\r"), (Strings{"a", "b"}));
  std::string many;
  for (int i = 0; i < 50; ++i) many += "mtllib m" + std::to_string(i) + "\n";
  EXPECT_EQ(mtl_names(many).size(), max_mtl_files);
}

}  // namespace
}  // namespace metamer
