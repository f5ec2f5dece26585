#pragma once

#include <memory>

#include "server/render/renderer.h"

namespace metamer::cpu {

/// The ray tracer, on so many threads at the most.
std::unique_ptr<Backend> make_backend(unsigned threads);

/// Has Embree use no more than AVX2 from now on, in this process: on a processor with AVX-512 it
/// takes other kernels, whose pictures differ in the last bits. Tiles of one picture come from
/// several machines where this was called on each.
void keep_to_avx2();

/// What it has.
inline constexpr Features features = Features::all().without({Feature::multi_pass});

}  // namespace metamer::cpu
