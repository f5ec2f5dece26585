#include "server/import/importer.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "common/digest.h"
#include "tests/server/scene/import_one.h"

namespace metamer::import {
namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string two_parts =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no a\nf 1 2 3\no b\nf 1 2 4\nf 2 3 4\n";

/// A store with files, and an importer that reads them.
class ImporterTest : public ::testing::Test {
 protected:
  ImporterTest() {
    std::string name = std::filesystem::temp_directory_path() / "metamer-import-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    store_ = name;
  }
  ~ImporterTest() override { std::filesystem::remove_all(store_); }

  void start(const char* what_readers_do = nullptr) {
    if (what_readers_do != nullptr) setenv("METAMER_TEST_IMPORT", what_readers_do, 1);
    importer_ = Importer::start(store_);
    unsetenv("METAMER_TEST_IMPORT");
    ASSERT_TRUE(importer_);
  }

  void add(const std::string& name, const std::string& bytes) {
    const Digest digest = sha256(bytes);
    std::ofstream(store_ / to_hex(digest), std::ios::binary) << bytes;
    v1::AssetName& asset = *names_.Add();
    asset.set_name(name);
    asset.set_sha256(std::string(to_bytes(digest)));
    texts_[name] = bytes;
  }

  Result<std::vector<TriangleMesh>> import(const std::string& name,
                                           std::vector<MeshUse> uses = {{}}) const {
    return importer_->import(request(name, uses), names_, never_);
  }
  Result<std::vector<TriangleMesh>> import_in_this_process(const std::string& name,
                                                           std::vector<MeshUse> uses = {{}}) const {
    return import_here([&](const std::string& file) -> Result<std::string> {
      const auto found = texts_.find(file);
      if (found == texts_.end()) return problem("was not sent along");
      return found->second;
    })(request(name, uses));
  }
  static MeshRequest request(const std::string& name, const std::vector<MeshUse>& uses) {
    MeshRequest request{name, {}};
    for (const MeshUse& use : uses)
      request.meshes.push_back({"object[" + std::to_string(request.meshes.size()) + "].mesh", use});
    return request;
  }

  std::filesystem::path store_;
  std::unique_ptr<Importer> importer_;
  worker::AssetNames names_;
  std::map<std::string, std::string> texts_;
  const std::atomic<bool> never_ = false;
};

template <class T>
std::vector<T> list(const Array<T>& array) {
  return {array.begin(), array.end()};
}

TEST_F(ImporterTest, GivesTheMeshesThatReadingInPlaceGives) {
  add("a.obj", two_parts);
  add("b.obj", "v 5400000.25 1 0\nv 5400001.5 1 0\nv 5400000.25 2 0\nf 1 2 3\nf 1 2\n");
  start();
  const std::vector<MeshUse> uses = {{"a", {}}, {"b", 30}, {{}, {}, true}};
  for (const std::string name : {"a.obj", "b.obj"}) {
    const auto here =
        import_in_this_process(name, name == "a.obj" ? uses : std::vector<MeshUse>{{}});
    const auto there = import(name, name == "a.obj" ? uses : std::vector<MeshUse>{{}});
    ASSERT_TRUE(here && there) << name;
    ASSERT_EQ(here->size(), there->size());
    for (std::size_t i = 0; i < here->size(); ++i) {
      const TriangleMesh &one = (*here)[i], &other = (*there)[i];
      EXPECT_EQ(list(one.positions.f32()), list(other.positions.f32()));
      EXPECT_EQ(list(one.positions.f64()), list(other.positions.f64()));
      EXPECT_EQ(list(one.normals), list(other.normals));
      EXPECT_EQ(list(one.tangents), list(other.tangents));
      EXPECT_EQ(list(one.triangles), list(other.triangles));
      EXPECT_EQ(one.skipped_faces, other.skipped_faces);
      EXPECT_EQ(one.notes, other.notes);
    }
  }
}

TEST_F(ImporterTest, SaysWhatIsWrongWithAFileAsReadingInPlaceDoes) {
  add("bad.obj", triangle + "f 1 2 9\n");
  add("good.obj", triangle);
  add("latin.obj", "o Gr\xFCn\n" + triangle);
  start();
  for (const auto& [name, part] : {std::pair<std::string, std::string>{"bad.obj", ""},
                                   {"good.obj", "nothing"},
                                   {"latin.obj", "nothing"},
                                   {"missing.obj", ""}}) {
    const auto here = import_in_this_process(name, {{part, {}}}),
               there = import(name, {{part, {}}});
    ASSERT_FALSE(here || there) << name;
    EXPECT_EQ(here.error().message, there.error().message);
    EXPECT_EQ(here.error().field, there.error().field);
    EXPECT_EQ(here.error().file, there.error().file);
    EXPECT_EQ(here.error().line, there.error().line);
  }
}

TEST_F(ImporterTest, ReadsNoBytesThatDoNotHaveTheirDigest) {
  add("a.obj", triangle);
  start();
  ASSERT_TRUE(import("a.obj"));
  std::fstream(store_ / to_hex(sha256(triangle)), std::ios::in | std::ios::out).seekp(2).put('1');
  const auto meshes = import("a.obj");
  ASSERT_FALSE(meshes);
  EXPECT_TRUE(worker::is_damage(meshes.error())) << meshes.error().message;
  EXPECT_EQ(meshes.error().file, "a.obj");
}

TEST_F(ImporterTest, WhatAFileDoesToItsReaderIsAnErrorOfThatImport) {
  add("a.obj", triangle);
  const std::string cant = "can't be read: ";
  for (const auto& [word, message] : {
         std::pair<const char*, std::string>{"abort",
                                             cant + "its reader ended by a signal: Aborted"},
             {"spin", cant + "it takes longer than a file of its size may take"},
#if !defined(__SANITIZE_ADDRESS__)
             {"swell", "needs more memory than a file of its size may take"},
#endif
       }) {
    start(word);
    for (int i = 0; i < 2; ++i) {  // The importer goes on.
      const auto meshes = import("a.obj");
      ASSERT_FALSE(meshes) << word;
      EXPECT_EQ(meshes.error().message, message);
      EXPECT_EQ(meshes.error().field, "object[0].mesh.file");
      EXPECT_EQ(meshes.error().file, "a.obj");
    }
  }
}

TEST_F(ImporterTest, SeveralAtATimeAreReadByReadersOfTheirOwn) {
  add("a.obj", two_parts);
  start();
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        const auto meshes = import("a.obj");
        if (meshes && meshes->front().triangles.size() == 3) ++right;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 80);
}

TEST_F(ImporterTest, OneThatIsNoLongerWantedEndsAndItsReaderWithIt) {
  add("a.obj", triangle);
  start("spin");
  std::atomic<bool> cancelled = false;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    cancelled = true;
  });
  EXPECT_FALSE(importer_->import(request("a.obj", {{}}), names_, cancelled));
  later.join();
  // Readers are this process's descendants: all of them end, or this waits for ever.
  importer_.reset();
}

TEST_F(ImporterTest, AfterItsEndImportsFail) {
  add("a.obj", triangle);
  start();
  kill(importer_->process(), SIGKILL);
  const auto meshes = import("a.obj");
  ASSERT_FALSE(meshes);
  EXPECT_EQ(meshes.error().message, "can't be read: the importer is gone");
}

}  // namespace
}  // namespace metamer::import
