#include "server/import/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <map>
#include <new>
#include <string_view>

#include "common/wire/blocking.h"
#include "server/import/bounds.h"
#include "server/import/messages.h"
#include "server/sandbox/sandbox.h"
#include "server/scene/mesh_import.h"
#include "server/worker/assets.h"
#include "server/worker/problems.h"

namespace metamer::import {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;  // Its shadow counts as memory.
#else
constexpr bool sanitized = false;
#endif

constexpr const char* too_much_memory = "needs more memory than a file of its size may take";

/// Sends the one reply of an import; its memory before it.
void reply(const Descriptor& socket, const v1::MeshImported& message,
           const Descriptor& memory = Descriptor()) {
  if (send_descriptor(socket.get(), memory.get()))
    static_cast<void>(wire::write_frame(socket.get(), message.SerializeAsString()));
}

void limit(__rlimit_resource resource, std::uint64_t most) {
  const rlimit soft{most, most + 1};  // A second, of time, to die by the signal that says why.
  setrlimit(resource, &soft);
}

/// All bytes that the request names, and no more, pay for what its reader may take.
std::uint64_t bytes_of(const v1::ImportMesh& request, const std::filesystem::path& store) {
  std::uint64_t sum = 0;
  for (const v1::AssetName& asset : request.asset())
    sum += worker::stored_bytes(store, asset.sha256());
  return sum;
}

void do_as_a_test_says(const char* word) {
  if (word == nullptr) return;
  if (word == std::string_view("abort")) std::abort();
  while (word == std::string_view("spin")) continue;
  std::vector<std::vector<char>> all;
  while (word == std::string_view("swell")) all.emplace_back(16u << 20, '\1');
}

MeshRequest request_of(const v1::ImportMesh& message) {
  MeshRequest request{message.file(), {}};
  for (const v1::ImportMesh::Mesh& mesh : message.mesh())
    request.meshes.push_back(
        {mesh.field(),
         {mesh.part(), mesh.has_crease_angle() ? std::optional(mesh.crease_angle()) : std::nullopt,
          mesh.tangents(), mesh.uvs()}});
  return request;
}

/// Reads the file, and writes its meshes into memory for the worker.
Result<Descriptor> read(const v1::ImportMesh& message, const std::filesystem::path& store,
                        v1::MeshImported::Meshes& meshes) {
  std::map<std::string, std::string> digests;
  for (const v1::AssetName& asset : message.asset()) digests[asset.name()] = asset.sha256();
  const auto files = [&](const std::string& name) -> Result<Bytes> {
    const auto found = digests.find(name);
    auto bytes = found == digests.end() ? problem("was not sent along")
                                        : worker::read_stored(store, found->second);
    if (!bytes) {
      bytes.error().file = name;
      return tl::unexpected(std::move(bytes.error()));
    }
    const auto owner = std::make_shared<const std::string>(*std::move(bytes));
    return Bytes(owner, {owner->data(), owner->size()});
  };
  try {
    do_as_a_test_says(std::getenv("METAMER_TEST_IMPORT"));
    auto imported = import_meshes(request_of(message), files);
    if (!imported) return tl::unexpected(std::move(imported.error()));
    return put_meshes(*std::move(imported), meshes);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Problem{.field = message.mesh(0).field() + ".file",
                                  .file = message.file(),
                                  .message = too_much_memory});
  }
}

/// The process of one import.
[[noreturn]] void run_reader(const Descriptor& socket, const v1::ImportMesh& request,
                             const std::filesystem::path& store, std::uint64_t bytes) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CPU, max_seconds(bytes));
  if (!sanitized) limit(RLIMIT_DATA, max_memory(bytes));
  limit(RLIMIT_FSIZE, max_memory(bytes));
  const char* test = std::getenv("METAMER_TEST_IMPORT");
  if (test != nullptr && test == std::string_view("spin")) limit(RLIMIT_CPU, 1);
  sandbox::enter(store);
  v1::MeshImported message;
  const auto memory = read(request, store, *message.mutable_meshes());
  if (!memory) worker::set_problem(memory.error(), *message.mutable_problem());
  reply(socket, message, memory ? Descriptor(dup(memory->get())) : Descriptor());
  std::_Exit(0);
}

/// How a reader ended that has said nothing. Nothing: it has.
std::optional<std::string> fate(int status, bool in_time) {
  if (!in_time || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
    return "it takes longer than a file of its size may take";
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) return too_much_memory;
  if (WIFSIGNALED(status))
    return std::string("its reader ended by a signal: ") + strsignal(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0)
    return "its reader ended with " + std::to_string(WEXITSTATUS(status));
  return std::nullopt;
}

/// Waits until the reader has ended, the worker has gone away, or the time is up. `alive` is closed
/// by the reader's end.
bool wait_for_reader(int alive, int worker, std::chrono::seconds time) {
  pollfd both[] = {{alive, POLLIN, 0}, {worker, POLLRDHUP, 0}};
  const int got = poll(both, 2, static_cast<int>(std::chrono::milliseconds(time).count()));
  return got != 0;
}

/// Starts the reader of one import and outlives it.
[[noreturn]] void run_guard(const Descriptor& socket, const std::filesystem::path& store) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGCHLD, SIG_DFL);
  v1::ImportMesh request;
  const auto frame = wire::read_frame(socket.get());
  int alive[2];
  if (!frame || !*frame || !request.ParseFromString(**frame) || request.mesh().empty() ||
      pipe2(alive, O_CLOEXEC) != 0)
    std::_Exit(1);
  const std::uint64_t bytes = bytes_of(request, store);
  const int reader = fork();
  if (reader == 0) run_reader(socket, request, store, bytes);
  close(alive[1]);

  // The processor's time is limited by the system; this is for one that sleeps.
  const bool in_time = reader > 0 && wait_for_reader(alive[0], socket.get(),
                                                     std::chrono::seconds(3 * max_seconds(bytes)));
  int status = 1;
  if (reader > 0) {
    kill(reader, SIGKILL);  // What has ended by itself is not changed by it.
    waitpid(reader, &status, 0);
  }
  if (const auto ended = fate(status, in_time)) {
    v1::MeshImported message;
    message.set_ended(*ended);
    reply(socket, message);
  }
  std::_Exit(0);
}

}  // namespace

void run_importer(Descriptor worker, const std::filesystem::path& store) {
  sandbox::enter(store, {}, sandbox::Children::forked);
  std::signal(SIGCHLD, SIG_IGN);  // Guards are not waited for.
  while (auto socket = receive_descriptor(worker.get())) {
    const int guard = fork();
    if (guard == 0) {
      worker = Descriptor();  // The guard has no use for it.
      run_guard(*socket, store);
    }
  }
  std::_Exit(0);
}

}  // namespace metamer::import
