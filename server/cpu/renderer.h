#pragma once

#include <memory>

#include "server/render/renderer.h"

namespace metamer::cpu {

/// The ray tracer, on so many threads at the most.
std::unique_ptr<Backend> make_backend(unsigned threads);

/// What it has.
inline constexpr Features features = Features::all().without({Feature::multi_pass});

}  // namespace metamer::cpu
