#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "common/scene/validate.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// True when a file's name ends so, in capitals or not.
bool has_extension(std::string_view name, std::string_view extension);

/// Calls `visit` for each spectrum that the scene holds, in its order, those of its looks last,
/// with its field path.
void for_each_spectrum(
    const v1::Scene& scene,
    const std::function<void(const v1::Spectrum&, const std::string& field, SpectrumRole)>& visit);

/// The same for the files of bispectral matrices, "material[0].fluorescence.file"; none is empty.
void for_each_bispectral_file(
    const v1::Scene& scene,
    const std::function<void(const std::string& file, const std::string& field)>& visit);

/// The same for the files of observers, "settings.observer_file" and those of looks; none is empty.
void for_each_observer_file(
    const v1::Scene& scene,
    const std::function<void(const std::string& file, const std::string& field)>& visit);

}  // namespace metamer
