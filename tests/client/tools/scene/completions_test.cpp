// What can be written at a place of a scene. A | in a text is the caret.
#include "client/tools/scene/completions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "common/spectral/cie.h"
#include "metamer/v1/scene.pb.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

struct FoundWords : Completions {
  std::string place;

  bool has(const std::string& word) const {
    return std::find(words.begin(), words.end(), word) != words.end();
  }
};

FoundWords complete(std::string text, const std::filesystem::path& folder = "/nowhere") {
  const std::size_t at = text.find('|');
  text.erase(at, 1);
  const Completions found = completions(text, at, folder);
  return {found, text.substr(found.begin, found.end - found.begin)};
}

TEST(Completions, NamesComeWithWhatFollowsThem) {
  const FoundWords found = complete("light { lum| }");
  EXPECT_EQ(found.place, "lum");
  EXPECT_TRUE(found.has("luminance: "));
  EXPECT_TRUE(found.has("spectrum { "));
  EXPECT_TRUE(complete("light { lu|: 3 }").has("luminance"));
  EXPECT_TRUE(complete("light { spec| { }").has("spectrum"));
}

/// Each field of a message and of what it holds, with the text that leads into the message.
void for_each_field(const google::protobuf::Descriptor& type, const std::string& before, int depth,
                    const std::function<void(const std::string&,
                                             const google::protobuf::FieldDescriptor&)>& visit) {
  for (int i = 0; i < type.field_count(); ++i) {
    const google::protobuf::FieldDescriptor& field = *type.field(i);
    visit(before, field);
    if (field.message_type() != nullptr && depth > 0)
      for_each_field(*field.message_type(), before + field.name() + " { ", depth - 1, visit);
  }
}

TEST(Completions, EveryFieldOfASceneIsCompletedAndEveryWordOfAnEnumeration) {
  int fields = 0, words = 0;
  for_each_field(*v1::Scene::descriptor(), "", 4,
                 [&](const std::string& before, const google::protobuf::FieldDescriptor& field) {
                   ++fields;
                   const bool message = field.message_type() != nullptr;
                   EXPECT_TRUE(complete(before + "|").has(field.name() + (message ? " { " : ": ")))
                       << before << field.name();
                   if (field.enum_type() == nullptr) return;
                   const FoundWords found = complete(before + field.name() + ": |");
                   for (int i = 0; i < field.enum_type()->value_count(); ++i, ++words)
                     EXPECT_TRUE(found.has(field.enum_type()->value(i)->name()))
                         << before << field.enum_type()->value(i)->name();
                 });
  EXPECT_GT(fields, 150);
  EXPECT_GT(words, 20);
}

TEST(Completions, ValuesOfEnumerations) {
  EXPECT_TRUE(complete("settings { shading: |").has("GOURAUD"));
  EXPECT_TRUE(complete("settings { verify: |").has("true"));
  EXPECT_TRUE(complete("settings { width: |").words.empty());
}

TEST(Completions, NamesThatTheSceneGives) {
  const std::string scene =
      "material { name: \"red\" diffuse { file: \"name\" } } material { name: 'blue' name2: \"no\" "
      "}\n"
      "light { name: \"lamp\" } object { name: \"ball\" material: ";
  const FoundWords found = complete(scene + "\"r|\" }");
  EXPECT_EQ(found.place, "r");
  EXPECT_EQ(found.words, (std::vector<std::string>{"red", "blue"}));
  EXPECT_EQ(complete(scene + "|").words, (std::vector<std::string>{"\"red\"", "\"blue\""}));
  EXPECT_EQ(complete(scene + "\"\" } look { light { name: \"|").words,
            (std::vector<std::string>{"*", "lamp"}));
  EXPECT_EQ(names_in_text(scene, "object"), (std::vector<std::string>{"ball"}));
}

TEST(Completions, IlluminantsMediaAndMetals) {
  EXPECT_EQ(complete("light { spectrum { standard: \"|\"").words, cie::illuminant_names());
  EXPECT_TRUE(complete("material { fresnel { conductor { metal: \"|").has("Au"));
  EXPECT_TRUE(complete("material { fresnel { dielectric { medium: \"|").has("N-BK7"));
}

TEST(Completions, FilesOfTheScenesFolderByTheirUse) {
  const TemporaryFolder folder;
  const std::filesystem::path path = std::filesystem::path(folder.file("x")).parent_path();
  std::filesystem::create_directories(path / "spectra");
  std::filesystem::create_directories(path / ".git");
  for (const char* name : {"spectra/red.csv", "ball.ply", "scene.txtpb", ".git/x.csv", ".hidden"})
    folder.write(name, "x");
  EXPECT_EQ(complete("material { diffuse { file: \"|\"", path).words,
            (std::vector<std::string>{"spectra/red.csv"}));
  EXPECT_EQ(complete("object { mesh { file: \"|\"", path).words,
            (std::vector<std::string>{"ball.ply"}));
  EXPECT_TRUE(complete("object { mesh { file: \"|\"").words.empty());
}

TEST(Completions, NothingInCommentsNumbersAndUnknownFields) {
  EXPECT_TRUE(complete("# li|").words.empty());
  EXPECT_TRUE(complete("lihgt { na|").words.empty());
  EXPECT_TRUE(complete("light { luminance: 1|").words.empty());
}

}  // namespace
}  // namespace metamer::client
