#include "server/cpu/isa/isa.h"

#include "server/cpu/renderer.h"

namespace metamer::cpu {
namespace {

#ifdef METAMER_AVX512
constexpr bool has_avx512_build = true;

/// What -march=x86-64-v4 lets the compiler use.
bool processor_has_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}
#else
constexpr bool has_avx512_build = false;
bool processor_has_avx512() { return false; }
#endif

std::string& embree_limit() {
  static std::string isa;
  return isa;
}

}  // namespace

const char* name_of(Isa isa) { return isa == Isa::avx512 ? "avx512" : "avx2"; }
unsigned packet_rays(Isa isa) { return isa == Isa::avx512 ? 16 : 8; }

Result<Isa> choose_isa(const std::string& word) {
  if (word == "native") return processor_has_avx512() ? Isa::avx512 : Isa::avx2;
  if (word == "avx2") return Isa::avx2;
  if (word != "avx512") return problem("no such ISA: " + word + "; native, avx2 or avx512");
  if (!has_avx512_build) return problem("this build of the tracer has no AVX-512");
  if (!processor_has_avx512()) return problem("this processor has no AVX-512 (x86-64-v4)");
  return Isa::avx512;
}

void keep_embree_to(const std::string& isa) { embree_limit() = isa; }
const std::string& embree_isa() { return embree_limit(); }

std::unique_ptr<Backend> make_backend(unsigned threads, Isa isa) {
#ifdef METAMER_AVX512
  if (isa == Isa::avx512) return make_backend(threads, Lanes<16>());
#endif
  static_cast<void>(isa);
  return make_backend(threads, Lanes<8>());
}

}  // namespace metamer::cpu
