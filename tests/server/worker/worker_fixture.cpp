#include "tests/server/worker/worker_fixture.h"

#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>

#include "common/digest.h"
#include "tests/server/test_scene.h"

namespace metamer::worker {
namespace {

std::filesystem::path new_folder() {
  std::string name = std::filesystem::temp_directory_path() / "metamer-worker-XXXXXX";
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  return name;
}

int worker_end(int (&ends)[2]) {
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) throw std::runtime_error("no sockets");
  return ends[0];
}

template <class Message>
std::string name_of_body(const Message& message, const char* oneof) {
  const auto* descriptor = Message::descriptor();
  const auto* field =
      message.GetReflection()->GetOneofFieldDescriptor(message, descriptor->FindOneofByName(oneof));
  return field ? field->name() : "nothing";
}

}  // namespace

WorkerTest::WorkerTest() : link_(worker_end(ends_)) {
  options_ = {.store = new_folder(),
              .threads = 1,
              .backend = &backend_,
              .film_descriptor = memfd_create("film", 0)};
  importer_ = import::Importer::start(options_.store);
  options_.importer = importer_.get();
  options_.tell_damage = [this](const std::string& digest) { damaged_.push_back(digest); };
  EXPECT_EQ(ftruncate(options_.film_descriptor, 64 * 64 * 12), 0);
}

WorkerTest::~WorkerTest() {
  for (const int descriptor : {options_.film_descriptor, ends_[0], ends_[1]}) close(descriptor);
  std::filesystem::remove_all(options_.store);
}

std::string WorkerTest::store(const std::string& bytes) const {
  const Digest digest = sha256(bytes);
  std::ofstream(options_.store / to_hex(digest), std::ios::binary) << bytes;
  return std::string(to_bytes(digest));
}

void WorkerTest::spoil(const std::string& digest) const {
  std::fstream(options_.store / to_hex(*digest_from_bytes(digest)), std::ios::in | std::ios::out)
      .put('!');
}

std::string WorkerTest::store_scene(const std::string& text) const {
  return store(test::parse_scene(text).SerializeAsString());
}

std::vector<v1::WorkerEnvelope> WorkerTest::sent() {
  Link daemon(ends_[1]);
  std::vector<v1::WorkerEnvelope> all;
  for (pollfd waiting{ends_[1], POLLIN, 0}; poll(&waiting, 1, 0) > 0;) {
    v1::WorkerEnvelope message = *daemon.receive();
    (message.has_preparing() || message.has_prepared() ? stages_ : all).push_back(message);
  }
  return all;
}

std::vector<std::string> WorkerTest::sent_names() {
  std::vector<std::string> names;
  for (const v1::WorkerEnvelope& message : sent()) {
    names.push_back(name_of_body(message, "body"));
    if (message.has_view_event()) names.back() += "." + name_of_body(message.view_event(), "event");
  }
  return names;
}

std::string ball_scene(const std::string& settings, const std::string& more) {
  return "camera { eye { z: 3 } target {} } light { name: 'lamp' position { y: 2 z: 2 } "
         "spectrum { standard: 'D65' } } material { name: 'paint' blinn_phong {} } object { "
         "name: 'ball' material: 'paint' sphere { radius: 1 } } settings { " +
         settings + " } " + more;
}

}  // namespace metamer::worker
