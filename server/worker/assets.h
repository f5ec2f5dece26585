#pragma once

#include <filesystem>
#include <string>

#include "common/mesh/mesh_file.h"
#include "common/scene/validate.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/scene.pb.h"
#include "server/scene/camera_space.h"

namespace metamer::worker {

/// An asset's bytes from the store. The daemon has checked digest and size.
Result<std::string> read_stored(const std::filesystem::path& store, const std::string& digest);

/// The same without a copy, for a process that may die of a file that is cut short meanwhile.
Result<Bytes> map_stored(const std::filesystem::path& store, const std::string& digest);

using AssetNames = google::protobuf::RepeatedPtrField<v1::AssetName>;

/// Assets by the names that a scene uses.
AssetReader stored_assets(const AssetNames& names, const std::filesystem::path& store);

/// Which bytes a mesh file is: with its own digest, of a .gltf those of all `names`, as it may name
/// others.
std::string mesh_file_key(const std::string& file, const AssetNames& names);

/// All that the objects of a scene depend on, `compiled` being the scene as a backend has it: not
/// on lights, cameras and spectra, nor on settings but the shading, nor on materials but their
/// places in the list. `names`: those that objects may be made of.
std::string objects_key(const v1::Scene& scene, const RenderScene& compiled,
                        const AssetNames& names);

/// And where they are placed: all that uploaded geometry depends on.
std::string geometry_key(const std::string& objects_key, const CameraSpace& space);

}  // namespace metamer::worker
