#include "common/digest.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cassert>
#include <new>

namespace metamer {

struct DigestStream::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();

  State() {
    // It fails only when there is no memory left.
    if (context == nullptr || EVP_DigestInit_ex(context, EVP_sha256(), nullptr) != 1) {
      EVP_MD_CTX_free(context);
      throw std::bad_alloc();
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { EVP_MD_CTX_free(context); }
};

DigestStream::DigestStream() : state_(std::make_unique<State>()) {}
DigestStream::~DigestStream() = default;
DigestStream::DigestStream(DigestStream&&) noexcept = default;
DigestStream& DigestStream::operator=(DigestStream&&) noexcept = default;

void DigestStream::update(std::string_view bytes) {
  assert(state_ != nullptr && "the stream is used up");
  EVP_DigestUpdate(state_->context, bytes.data(), bytes.size());
}

Digest DigestStream::finish() {
  assert(state_ != nullptr && "the stream is used up");
  Digest digest{};
  EVP_DigestFinal_ex(state_->context, digest.data(), nullptr);
  state_.reset();
  return digest;
}

Digest sha256(std::string_view bytes) {
  DigestStream stream;
  stream.update(bytes);
  return stream.finish();
}

std::string to_hex(const Digest& digest) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  text.reserve(2 * digest.size());
  for (const unsigned char byte : digest) {
    text += digits[byte >> 4u];
    text += digits[byte & 15u];
  }
  return text;
}

std::optional<Digest> digest_from_bytes(std::string_view bytes) {
  Digest digest{};
  if (bytes.size() != digest.size()) return std::nullopt;
  std::copy(bytes.begin(), bytes.end(), digest.begin());
  return digest;
}

}  // namespace metamer
