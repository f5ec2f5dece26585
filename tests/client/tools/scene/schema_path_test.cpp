// Where a byte of an unfinished scene lies in the schema. A | in a text is the byte.
#include "client/tools/scene/schema_path.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/scene/scene_file.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::client {
namespace {

using PathKind = SchemaPath::Kind;

const google::protobuf::Descriptor& scene_schema() { return *v1::Scene::descriptor(); }

struct Found : SchemaPath {
  std::string word;
};

Found find(std::string text) {
  const std::size_t at = text.find('|');
  text.erase(at, 1);
  const SchemaPath path = schema_path(text, at, scene_schema());
  EXPECT_LE(path.begin, at) << text;
  EXPECT_LE(at, path.end) << text;
  return {path, text.substr(path.begin, path.end - path.begin)};
}

void expect(const std::string& text, PathKind kind, const std::string& path,
            const std::string& word) {
  const Found found = find(text);
  EXPECT_EQ(found.kind, kind) << text;
  EXPECT_EQ(found.path, path) << text;
  EXPECT_EQ(found.word, word) << text;
}

TEST(SchemaPath, NamesOfTheRoot) {
  expect("|", PathKind::name, "", "");
  expect("lig|", PathKind::name, "", "lig");
  expect("|light", PathKind::name, "light[0]", "light");
  expect("light {} li|ght { }", PathKind::name, "light[1]", "light");
  EXPECT_EQ(find("light {} li|ght").field->name(), "light");
  EXPECT_EQ(find("li|").field, nullptr);
  EXPECT_EQ(find("li|").message, &scene_schema());
}

TEST(SchemaPath, NamesInsideBraces) {
  expect("light { name: \"key\" lum|", PathKind::name, "light[0]", "lum");
  expect("light < spectrum: { | } >", PathKind::name, "light[0].spectrum", "");
  expect("light {} light { spectrum { sta|ndard: \"A\" } }", PathKind::name,
         "light[1].spectrum.standard", "standard");
  expect("camera { eye { } | ", PathKind::name, "camera", "");
  expect("light { } |", PathKind::name, "", "");
}

TEST(SchemaPath, WhatFollowsAName) {
  expect("light |", PathKind::brace, "light[0]", "");
  expect("light: |", PathKind::brace, "light[0]", "");
  expect("light { luminance |", PathKind::colon, "light[0].luminance", "");
  expect("light { luminance: |", PathKind::value, "light[0].luminance", "");
  expect("light { luminance: 1.|5e3 }", PathKind::value, "light[0].luminance", "1.5e3");
  expect("light { position { x: -|", PathKind::value, "light[0].position.x", "");
  expect("light { position { x: -2 |", PathKind::name, "light[0].position", "");
}

TEST(SchemaPath, ValuesOfEnumerations) {
  expect("settings { shading: GOU|RAUD }", PathKind::value, "settings.shading", "GOURAUD");
  const std::vector<std::string> values = candidates(find("settings { shading: |"));
  EXPECT_EQ(values, (std::vector<std::string>{"PHONG", "CONSTANT", "GOURAUD", "QUADRATIC"}));
  EXPECT_EQ(candidates(find("settings { development { linear: t|")),
            (std::vector<std::string>{"true", "false"}));
  EXPECT_TRUE(candidates(find("settings { width: |")).empty());
}

TEST(SchemaPath, CandidatesOfAName) {
  const std::vector<std::string> names = candidates(find("light { position { } | "));
  EXPECT_NE(std::find(names.begin(), names.end(), "luminance"), names.end());
  EXPECT_EQ(candidates(find("light { position { |")), (std::vector<std::string>{"x", "y", "z"}));
}

TEST(SchemaPath, InsideQuotes) {
  expect("light { name: \"|\" }", PathKind::text, "light[0].name", "");
  expect("light { name: \"ke|y\" luminance: 1 }", PathKind::text, "light[0].name", "key");
  expect("light { name: 'it\\'s |", PathKind::text, "light[0].name", "it\\'s ");
  expect("light { name: \"a # { b|", PathKind::text, "light[0].name", "a # { b");
  expect("light { name: \"a\" \"b|", PathKind::text, "light[0].name", "b");
  expect("light { name: \"a\"|", PathKind::name, "light[0]", "");
  expect("light { name: \"open\n|", PathKind::name, "light[0]", "");
  expect("material { diffuse { file: \"spectra/t|cs.sp\nentry: \"a\"", PathKind::text,
         "material[0].diffuse.file", "spectra/tcs.sp");
}

TEST(SchemaPath, CommentsSayNothing) {
  expect("# lig|ht {", PathKind::comment, "", "");
  expect("light { # na|me:", PathKind::comment, "light[0]", "");
  expect("light { # name:\n nam|", PathKind::name, "light[0]", "nam");
}

TEST(SchemaPath, ListsCountTheirElements) {
  expect("light { spectrum { samples { value: [1, 2, |", PathKind::value,
         "light[0].spectrum.samples.value[2]", "");
  expect("light { spectrum { samples { value: [1, 2|5", PathKind::value,
         "light[0].spectrum.samples.value[1]", "25");
  expect("light { spectrum { samples { value: 1 value: |", PathKind::value,
         "light[0].spectrum.samples.value[1]", "");
  expect("light { spectrum { samples { value: [1] wav|", PathKind::name,
         "light[0].spectrum.samples", "wav");
  expect("light [{ }, { name: \"|", PathKind::text, "light[1].name", "");
  expect("light [{ }, { }] light { |", PathKind::name, "light[2]", "");
}

TEST(SchemaPath, UnfinishedTextBeforeTheByteIsPassedOver) {
  expect("light { lum\n position { x: 1 } na|", PathKind::name, "light[0]", "na");
  expect("light { luminance:\n position { x: |", PathKind::value, "light[0].position.x", "");
  expect("light { luminance:\n name: \"|", PathKind::text, "light[0].name", "");
  expect("light { spectrum { samples { value: [1, 2 } entry: \"|", PathKind::text,
         "light[0].spectrum.entry", "");
  expect("light } } ] > camera { |", PathKind::name, "camera", "");
}

TEST(SchemaPath, WhatTheSchemaDoesNotHave) {
  expect("lihgt { |", PathKind::unknown, "", "");
  expect("lihgt { a { } b: [ { | ", PathKind::unknown, "", "");
  expect("lihgt: |", PathKind::unknown, "", "");
  expect("lihgt: \"a|\"", PathKind::unknown, "", "a");
  expect("lihgt { a { } } light { |", PathKind::name, "light[0]", "");
  expect("light { luminance { | ", PathKind::unknown, "light[0]", "");
  expect("[a.b.c] { x: 1 } light { |", PathKind::name, "light[0]", "");
  expect("{ } camera { |", PathKind::name, "camera", "");
}

TEST(SchemaPath, TabsAndUtf8AreCountedInBytes) {
  expect("\t\tlight {\t name:\t\"Décor €|\" }", PathKind::text, "light[0].name", "Décor €");
  expect("light {\r\n\tname: \"ä\"\r\n\tlum|inance: 1", PathKind::name, "light[0].luminance",
         "luminance");
}

TEST(SchemaPath, EveryByteOfASoundTextHasAPath) {
  const std::string text =
      "# c\nlight { name: \"a\\\"b\" position { x: -1 y: 2.5e-3 } spectrum { samples {\n"
      "wavelength: [400, 500] value: 1 value: 2 } } }\nsettings { shading: GOURAUD }\n";
  for (std::size_t at = 0; at <= text.size(); ++at) {
    const SchemaPath path = schema_path(text, at, scene_schema());
    EXPECT_NE(path.kind, PathKind::unknown) << text.substr(0, at);
    EXPECT_LE(path.begin, at);
    EXPECT_LE(at, path.end);
    EXPECT_LE(path.end, text.size());
  }
}

TEST(SchemaPath, HostileTextsEnd) {
  const std::string nul(1000, '\0');
  for (const std::string& piece :
       {std::string("{"), std::string("light{"), std::string("light[{"), std::string("[<"),
        std::string("}"), std::string("\""), std::string("'\\"), std::string("\xFF\xFE"),
        std::string("\t"), std::string("0x"), std::string("- "), std::string("light{}"), nul}) {
    std::string text;
    while (text.size() < (1u << 18)) text += piece;
    const SchemaPath path = schema_path(text, text.size(), scene_schema());
    EXPECT_LE(path.begin, text.size());
    EXPECT_LE(path.path.size(), 200u) << piece;
  }
}

TEST(SchemaPath, ATextThatNoSceneCanBeHasNone) {
  const std::string text(max_scene_text + 1, ' ');
  EXPECT_EQ(schema_path(text, 3, scene_schema()).kind, PathKind::unknown);
  EXPECT_EQ(schema_path(text.substr(1), 3, scene_schema()).kind, PathKind::name);
}

}  // namespace
}  // namespace metamer::client
