#pragma once

#include <filesystem>

#include "server/import/transfer.h"

namespace metamer::import {

/// The importer's life: each descriptor that comes is the socket of one import, which gets a guard
/// and a reader of its own. Ends with the process when the worker's end is closed.
[[noreturn]] void run_importer(Descriptor worker, const std::filesystem::path& store);

}  // namespace metamer::import
