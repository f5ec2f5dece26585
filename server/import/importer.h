#pragma once

#include <atomic>
#include <filesystem>
#include <memory>

#include "server/import/transfer.h"
#include "server/scene/mesh_import.h"
#include "server/worker/assets.h"

namespace metamer::import {

/// The worker's end of the importer. What a file does to its reader is an error of that import.
class Importer {
 public:
  /// Starts the process, which reads files of `store` alone and ends with this one. Only from a
  /// process that has one thread yet. Null: no process can be started; errno says why.
  static std::unique_ptr<Importer> start(const std::filesystem::path& store);
  ~Importer();

  /// Any thread, several at a time. Errors: those of import_meshes(); the reader died, took too
  /// long or too much memory. Ends soon once `cancelled` is set, with any error.
  Result<std::vector<TriangleMesh>> import(const MeshRequest& request,
                                           const worker::AssetNames& files,
                                           const std::atomic<bool>& cancelled) const;

  int process() const { return pid_; }

 private:
  Importer(Descriptor process, int pid) : process_(std::move(process)), pid_(pid) {}

  Descriptor process_;  ///< Takes the sockets of imports.
  int pid_;
};

}  // namespace metamer::import
