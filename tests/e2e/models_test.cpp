// The words `models` and `bench`, and the scenes that show the models.
#include <gtest/gtest.h>

#include <filesystem>

#include "common/models/registry.h"
#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

const std::string deploy = std::string(METAMER_TEST_DATA) + "/../deploy";

TEST(ModelsCommand, ListsThemWithoutAServer) {
  const Ended ended = metamer({"models"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* name : {"cook_torrance", "oren_nayar", "beckmann", "smith", "conductor"})
    EXPECT_NE(ended.out.find(name), std::string::npos) << name;
  EXPECT_EQ(parse_document(metamer({"models", "--json"}).out)["exit_code"], 0);
}

TEST(ModelsCommand, AnUnknownNameIsAnErrorOfUsage) {
  const Ended ended = metamer({"models", "show", "cook_torance"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("did you mean \"cook_torrance\"?"), std::string::npos) << ended.err;
  EXPECT_EQ(metamer({"models", "plot"}).code, 2);
}

TEST(ModelsCommand, DrawsTheFiguresOfTheSource) {
  const Folder folder;
  const Ended ended = metamer({"models", "plot", "--figures", "-o", folder.path()});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* figure : {"2-2", "2-3", "2-4", "2-5", "2-6", "2-8", "2-9", "2-10", "2-11"})
    for (const char* type : {".png", ".csv"})
      EXPECT_TRUE(std::filesystem::exists(folder / ("fig-" + std::string(figure) + type)))
          << figure << type;
}

TEST(BenchCommand, ComparesEveryModelWithBlinnPhong) {
  const Json answer = parse_document(
      metamer({"bench", "models", "--rounds", "1", "--size", "16x12", "--spp", "1", "--json"}).out);
  EXPECT_EQ(answer["exit_code"], 0);
  ASSERT_GT(answer["cases"].size(), 9u);
  EXPECT_EQ(answer["cases"][0]["name"], "blinn_phong");
  EXPECT_EQ(answer["cases"][0]["relative"], 1.0);
  for (const Json& row : answer["cases"]) {
    EXPECT_GT(row["relative"].get<double>(), 0) << row;
    EXPECT_GE(row["models"].get<double>(), 0) << row;
  }
  EXPECT_EQ(metamer({"bench", "models", "--size", "0x12"}).code, 2);
}

TEST(BenchCommand, ComparesEveryMethodWithRgb) {
  const auto bench = [](std::vector<std::string> more) {
    std::vector<std::string> words = {"bench", "methods", "--rounds", "1",     "--size",
                                      "16x12", "--spp",   "1",        "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return parse_document(metamer(words).out);
  };
  const Json cpu = bench({}), gl = bench({"--backend", "gl"});
  EXPECT_EQ(cpu["exit_code"], 0);
  EXPECT_EQ(gl["exit_code"], 0);
  EXPECT_EQ(cpu["cases"][0]["name"], "rgb");
  EXPECT_EQ(cpu["cases"].size(), 9u);
  EXPECT_EQ(gl["cases"].size(), 13u);  // and point in passes, with four numbers of samples
}

TEST(BenchCommand, HasARowForEachModelPerVertexAndPerPixel) {
  const Json rows = parse_document(
      metamer({"bench", "shading", "--rounds", "1", "--size", "16x12", "--spp", "1", "--json"})
          .out)["rows"];
  EXPECT_EQ(rows.size(), 2 * models::registry(models::Kind::model).size());
  EXPECT_EQ(rows[0]["per"], "vertex");
  EXPECT_EQ(rows[1]["per"], "pixel");
  for (const Json& row : rows) {
    EXPECT_EQ(row["point"].size(), 4u) << row;
    EXPECT_GT(row["point"]["301"].get<double>(), 0);
  }
}

TEST(BenchCommand, MeasuresTheModelsAndCountsThatAreNamedAlone) {
  const auto bench = [](const std::string& models, const std::string& counts) {
    return metamer({"bench", "shading", "--rounds", "1", "--size", "16x12", "--spp", "1", "--json",
                    "--models", models, "--counts", counts});
  };
  const Json rows = parse_document(bench("strauss,phong", "9,9").out)["rows"];
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0]["model"], "phong") << "in the registry's order";
  EXPECT_EQ(rows[3]["model"], "strauss");
  for (const Json& row : rows) EXPECT_GT(row["point"]["9"].get<double>(), 0);
  EXPECT_EQ(bench("straus", "9").code, 2);
  EXPECT_EQ(bench("strauss", "1").code, 2);
  for (const char* own : {"--shading=gouraud", "--method=rgb", "--fitted=8"})
    EXPECT_EQ(metamer({"bench", "shading", own}).code, 2) << own;
  EXPECT_EQ(metamer({"bench", "methods", "--samples", "400:700:5"}).code, 2);
}

TEST(ShownScenes, AreSound) {
  for (const char* scene : {"/gallery/gallery.txtpb", "/booth/booth.txtpb"}) {
    const Ended ended = metamer({"check", deploy + scene});
    EXPECT_EQ(ended.code, 0) << ended.err;
  }
}

TEST(JsonOfUsage, OfWordsThatMakeNoSenseIsADocumentToo) {
  const Json answer = parse_document(metamer({"render", "--json"}).out);
  EXPECT_EQ(answer["exit_code"], 2);
  EXPECT_EQ(answer["errors"].size(), 1u);
}

}  // namespace
}  // namespace metamer::test
