// What the schema's comments say of a field: of every field of a scene something.
#include "client/tools/scene/schema_help.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "metamer/v1/scene.pb.h"

namespace metamer::client {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

const SchemaHelp& help() {
  static const SchemaHelp read = [] {
    std::ifstream file(METAMER_BIN "/../client/schema.pb", std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    Result<SchemaHelp> result = SchemaHelp::read(bytes.str());
    EXPECT_TRUE(result.has_value());
    return std::move(*result);
  }();
  return read;
}

FieldHelp help_of(const Descriptor& message, const char* field) {
  return help().of(*message.FindFieldByName(field));
}

FieldHelp help_at(std::string text) {
  const std::size_t at = text.find('|');
  text.erase(at, 1);
  return help().of(schema_path(text, at, *v1::Scene::descriptor()), text);
}

void for_each_field(const Descriptor& message, std::set<const Descriptor*>& seen,
                    const std::function<void(const FieldDescriptor&)>& visit) {
  if (!seen.insert(&message).second) return;
  for (int i = 0; i < message.field_count(); ++i) {
    visit(*message.field(i));
    if (message.field(i)->message_type() != nullptr)
      for_each_field(*message.field(i)->message_type(), seen, visit);
  }
}

TEST(SchemaHelp, EveryFieldOfASceneHasAText) {
  std::set<const Descriptor*> seen;
  int fields = 0;
  for_each_field(*v1::Scene::descriptor(), seen, [&](const FieldDescriptor& field) {
    ++fields;
    const FieldHelp found = help().of(field);
    EXPECT_TRUE(found.signature.starts_with(field.name() + ": ")) << field.full_name();
    ASSERT_FALSE(found.paragraphs.empty()) << field.full_name();
    for (const std::string& paragraph : found.paragraphs) {
      EXPECT_GE(paragraph.size(), 2u) << field.full_name();
      EXPECT_EQ(paragraph.find('\n'), std::string::npos) << field.full_name();
      EXPECT_EQ(paragraph.find("_MEMBERS"), std::string::npos) << field.full_name();
    }
  });
  EXPECT_GT(fields, 100);
}

TEST(SchemaHelp, IsTheFieldsOwnCommentFirst) {
  const FieldHelp found = help_of(*v1::Light::descriptor(), "reference_distance");
  EXPECT_EQ(found.signature, "reference_distance: number");
  ASSERT_FALSE(found.paragraphs.empty());
  EXPECT_EQ(
      found.paragraphs[0],
      "The luminance of a light with a position holds at this distance and falls with its "
      "square. Left out, it holds at every distance, as in E[2.2-3]; not so of a quad, disk or "
      "sphere, whose light falls off by itself. Not of an object. metres, above 0");
}

TEST(SchemaHelp, SaysTheTypesCommentToo) {
  const FieldHelp found = help_of(*v1::Light::descriptor(), "spectrum");
  EXPECT_EQ(found.signature, "spectrum: Spectrum");
  ASSERT_EQ(found.paragraphs.size(), 2u);
  EXPECT_TRUE(found.paragraphs[1].starts_with("A function of wavelength (nm)."));
}

TEST(SchemaHelp, TakesModelsAndLightsFromTheirTables) {
  EXPECT_EQ(help_of(*v1::BlinnPhong::descriptor(), "shininess").paragraphs.at(0),
            "exponent n of (N·H); 1 to 1e+06, 60 when left out");
  EXPECT_TRUE(help_of(*v1::Material::descriptor(), "phong").paragraphs.at(0).starts_with("d C_D"));
  EXPECT_EQ(help_of(*v1::Light::descriptor(), "direction").paragraphs.at(0),
            "the way its light travels");
  EXPECT_EQ(help_of(*v1::Light::Spot::descriptor(), "half_angle").paragraphs.at(0),
            "θo: between the axis and the edge of the cone; 0.1 to 90 degrees, 30 when left out");
}

TEST(SchemaHelp, NamesTheWordsOfAnEnumerationAndSaysWhatTheOneThereMeans) {
  const FieldHelp found = help_at("settings { shading: GOU|RAUD }");
  EXPECT_EQ(found.signature, "shading: one of PHONG CONSTANT GOURAUD QUADRATIC");
  EXPECT_EQ(found.paragraphs.at(0), "GOURAUD: at its three corners; linear between them");
}

TEST(SchemaHelp, KnowsNothingOfCommentsAndUnknownFields) {
  EXPECT_TRUE(help_at("# lig|ht").signature.empty());
  EXPECT_TRUE(help_at("lihgt { a|: 1 }").signature.empty());
  EXPECT_TRUE(help_at("li|hgt { }").signature.empty());
  EXPECT_EQ(help_at("light { lumi|nance: 1 }").signature, "luminance: number");
  EXPECT_EQ(help_at("li|ght { }").signature, "light: repeated Light");
}

TEST(SchemaHelp, BytesThatAreNoSchemaAreAProblem) {
  EXPECT_FALSE(SchemaHelp::read("\x0a\xff").has_value());
  EXPECT_FALSE(SchemaHelp::read("").has_value());
}

}  // namespace
}  // namespace metamer::client
