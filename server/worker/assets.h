#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "common/scene/validate.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/scene.pb.h"
#include "server/scene/camera_space.h"

namespace metamer::worker {

/// An asset's bytes from the folder of those that this worker sees, which have its digest: they are
/// a copy, since a file may change while it is read. Error: is_damage().
Result<std::string> read_stored(const std::filesystem::path& store, const std::string& digest);

/// Their number, as the system says it; 0 where there is no such file.
std::uint64_t stored_bytes(const std::filesystem::path& store, const std::string& digest);

/// Says that a file of the server's is not what it was, which is no fault of the scene's.
bool is_damage(const Problem& problem);

/// Is told the digest of such a file. From any thread.
using TellDamage = std::function<void(const std::string& digest)>;

using AssetNames = google::protobuf::RepeatedPtrField<v1::AssetName>;

/// Assets by the names that a scene uses.
AssetReader stored_assets(const AssetNames& names, const std::filesystem::path& store,
                          const TellDamage& tell_damage);

/// Of a mesh that was imported, or could not be: tells of the file whose fault that was.
void tell_damage_of(const Problem& problem, const AssetNames& names, const TellDamage& tell_damage);

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
