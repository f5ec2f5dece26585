#include "server/import/importer.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "common/scene/names.h"
#include "common/wire/blocking.h"
#include "server/import/messages.h"
#include "server/import/process.h"

namespace metamer::import {
namespace {

constexpr int look_every = 50;  ///< Milliseconds, at whether the import is still wanted.

struct SocketPair {
  Descriptor ours, theirs;
};
std::optional<SocketPair> make_socket_pair() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return std::nullopt;
  return SocketPair{Descriptor(ends[0]), Descriptor(ends[1])};
}

/// The request as its reader gets it. A glTF may name any of the files, others none.
v1::ImportMesh message_of(const MeshRequest& request, const worker::AssetNames& files) {
  v1::ImportMesh message;
  message.set_file(request.file);
  const bool names_others = has_extension(request.file, ".gltf");
  for (const v1::AssetName& file : files)
    if (names_others || file.name() == request.file) *message.add_asset() = file;
  for (const auto& [field, use, key] : request.meshes) {
    v1::ImportMesh::Mesh& to = *message.add_mesh();
    to.set_field(field);
    to.set_part(use.part);
    if (use.crease_angle) to.set_crease_angle(*use.crease_angle);
    to.set_tangents(use.tangents);
    to.set_uvs(use.uvs);
  }
  return message;
}

bool wait_for_reply(int socket, const std::atomic<bool>& cancelled) {
  pollfd waiting{socket, POLLIN, 0};
  while (!cancelled) {
    const int got = poll(&waiting, 1, look_every);
    if (got > 0) return true;
    if (got < 0 && errno != EINTR) return false;
  }
  return false;
}

Problem problem_of(const v1::Problem& from) {
  return {.field = from.field(),
          .file = from.file(),
          .line = static_cast<int>(from.line()),
          .column = static_cast<int>(from.column()),
          .message = from.message(),
          .was = from.was(),
          .meant = from.meant()};
}

}  // namespace

std::unique_ptr<Importer> Importer::start(const std::filesystem::path& store) {
  auto pair = make_socket_pair();
  if (!pair) return nullptr;
  const int pid = fork();
  if (pid < 0) return nullptr;
  if (pid == 0) {
    // None of what the worker has open, above all the daemon's socket.
    const int kept = dup2(pair->theirs.get(), STDERR_FILENO + 1);
    static_cast<void>(pair->ours.release());
    static_cast<void>(pair->theirs.release());
    closefrom(STDERR_FILENO + 2);
    run_importer(Descriptor(kept), store);
  }
  return std::unique_ptr<Importer>(new Importer(std::move(pair->ours), pid));
}

Importer::~Importer() {
  process_ = Descriptor();
  waitpid(pid_, nullptr, 0);
}

Result<std::vector<TriangleMesh>> Importer::import(const MeshRequest& request,
                                                   const worker::AssetNames& files,
                                                   const std::atomic<bool>& cancelled) const {
  const auto fail = [&](std::string message) {
    return tl::unexpected(Problem{.field = request.meshes.front().field + ".file",
                                  .file = request.file,
                                  .message = std::move(message)});
  };
  const std::string gone = "can't be read: the importer is gone";

  // Ask.
  auto pair = make_socket_pair();
  if (!pair || !send_descriptor(process_.get(), pair->theirs.get())) return fail(gone);
  pair->theirs = Descriptor();
  const int socket = pair->ours.get();
  if (!wire::write_frame(socket, message_of(request, files).SerializeAsString())) return fail(gone);

  // Wait. Whoever stops waiting closes the socket, at which the guard ends the reader.
  if (!wait_for_reply(socket, cancelled)) return fail("was no longer wanted");
  const auto memory = receive_descriptor(socket);
  const auto frame = memory ? wire::read_frame(socket) : Result<std::optional<std::string>>();
  v1::MeshImported reply;
  if (!memory || !frame || !*frame || !reply.ParseFromString(**frame)) return fail(gone);

  // Believe nothing.
  switch (reply.outcome_case()) {
    case v1::MeshImported::kProblem:
      return tl::unexpected(problem_of(reply.problem()));
    case v1::MeshImported::kEnded:
      return fail("can't be read: " + reply.ended());
    case v1::MeshImported::kMeshes:
      if (reply.meshes().arrays_size() != static_cast<int>(request.meshes.size()))
        return fail(gone);
      if (auto meshes = take_meshes(*memory, reply.meshes())) return *std::move(meshes);
      return fail("can't be read: its reader was taken over");
    case v1::MeshImported::OUTCOME_NOT_SET:
      break;
  }
  return fail(gone);
}

}  // namespace metamer::import
