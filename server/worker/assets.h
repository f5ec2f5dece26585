#pragma once

#include <filesystem>
#include <string>

#include "common/scene/validate.h"
#include "metamer/v1/worker.pb.h"

namespace metamer {

/// An asset's bytes from the store. The daemon has checked digest and size.
Result<std::string> read_stored(const std::filesystem::path& store, const std::string& digest);

/// The job's assets by the names that its scene uses.
AssetReader stored_assets(const v1::CompileJob& message, const std::filesystem::path& store);

/// All that a scene's geometry depends on: not its spectra, nor its settings but the shading.
std::string geometry_key(v1::Scene scene, const v1::CompileJob& message);

}  // namespace metamer
