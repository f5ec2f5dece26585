#include "common/wire/worker_program.h"

#include <fstream>
#include <vector>

#include "common/digest.h"

namespace metamer::wire {

std::string digest_of_program(const std::filesystem::path& program) {
  std::ifstream file(program, std::ios::binary);
  if (!file) return {};
  DigestStream sum;
  std::vector<char> piece(1 << 20);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
    sum.update({piece.data(), static_cast<std::size_t>(file.gcount())});
  return to_hex(sum.finish());
}

}  // namespace metamer::wire
