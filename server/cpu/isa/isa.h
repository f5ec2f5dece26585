#pragma once

#include <memory>
#include <string>

#include "common/problem.h"
#include "server/render/renderer.h"

/// What the tracer is compiled for. Its sources are compiled once for each; all draw the same bits.
namespace metamer::cpu {

enum class Isa {
  avx2,   ///< x86-64-v3 with packets of eight, or whatever else the build is for.
  avx512  ///< x86-64-v4 with packets of sixteen: where the build has it (METAMER_AVX512).
};

/// "avx2" or "avx512", as on the wire.
const char* name_of(Isa isa);
/// Rays of a packet.
unsigned packet_rays(Isa isa);

/// By "native": the best that this build and this processor have; or the one of that name. Error:
/// it is none of these words, or one of them lacks it.
Result<Isa> choose_isa(const std::string& word);

/// Has Embree use no more than that ("avx2", "sse4.2") in scenes that are built from now on, in
/// this process; empty: all that the processor has. Before there are threads.
void keep_embree_to(const std::string& isa);
const std::string& embree_isa();

/// The tracer as it is compiled for so many lanes.
template <int lanes>
struct Lanes {};
std::unique_ptr<Backend> make_backend(unsigned threads, Lanes<8>);
std::unique_ptr<Backend> make_backend(unsigned threads, Lanes<16>);

}  // namespace metamer::cpu
