#pragma once

#include <memory>

#include "server/cpu/isa/isa.h"
#include "server/render/renderer.h"

namespace metamer::cpu {

/// The ray tracer, on so many threads at the most; of the ISAs that choose_isa() gives.
std::unique_ptr<Backend> make_backend(unsigned threads, Isa isa);

/// What it has.
inline constexpr Features features = Features::all().without({Feature::multi_pass});

}  // namespace metamer::cpu
