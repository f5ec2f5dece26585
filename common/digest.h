#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace metamer {

/// SHA-256 of an asset: its name in the store and on the wire.
using Digest = std::array<unsigned char, 32>;

Digest sha256(std::string_view bytes);
std::string to_hex(const Digest& digest);
/// The 32 raw bytes of a protobuf field; nothing when it has another length.
std::optional<Digest> digest_from_bytes(std::string_view bytes);
/// The raw bytes for a protobuf field.
inline std::string_view to_bytes(const Digest& digest) {
  return {reinterpret_cast<const char*>(digest.data()), digest.size()};
}

/// SHA-256 of data that comes in pieces.
class DigestStream {
 public:
  DigestStream();
  ~DigestStream();
  DigestStream(DigestStream&&) noexcept;
  DigestStream& operator=(DigestStream&&) noexcept;
  void update(std::string_view bytes);
  Digest finish();  ///< Once; the stream is used up.

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace metamer
