// The frame codec against any bytes in any pieces: payloads come back whole, the pieces make no
// difference, and no length makes it allocate more than what has come.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check.h"
#include "common/wire/frame.h"

// Of sanitizer/allocator_interface.h, which Debian has for Clang alone.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace {

using metamer::fuzz::check;
namespace wire = metamer::wire;

/// The largest single allocation while `armed`.
bool armed = false;
std::size_t largest = 0;
void on_malloc(const volatile void*, std::size_t size) {
  if (armed) largest = std::max(largest, size);
}
void on_free(const volatile void*) {}

/// What a decoder gives for a stream.
struct Outcome {
  std::vector<std::string> payloads;
  std::optional<wire::FrameError> error;
  bool in_frame = false;

  bool operator==(const Outcome&) const = default;
};

/// Takes all that `decoder` has; returns the bytes of the frames taken.
std::size_t drain(wire::FrameDecoder& decoder, Outcome& outcome) {
  std::size_t taken = 0;
  while (true) {
    const bool ready = decoder.missing() == 0;
    armed = true;
    auto payload = decoder.next();
    armed = false;
    if (!payload) {
      check(ready, "an error is something to give");
      check(!outcome.error || *outcome.error == payload.error(), "an error stays the same");
      outcome.error = payload.error();
      return taken;
    }
    check(ready == payload->has_value(), "missing() is 0 when there is something to give");
    if (!*payload) return taken;
    taken += wire::header_size + (*payload)->size();
    outcome.payloads.push_back(*std::move(*payload));
  }
}

/// Feeds `stream` in pieces of the sizes of `cuts`, over and over; all at once when there are none.
Outcome decode(std::string_view stream, const std::string& cuts, std::size_t limit) {
  wire::FrameDecoder decoder(limit);
  Outcome outcome;
  std::size_t held = 0, most_held = 0;
  for (std::size_t i = 0; !stream.empty(); ++i) {
    const std::size_t wanted =
        cuts.empty() ? stream.size() : static_cast<unsigned char>(cuts[i % cuts.size()]) + 1u;
    const std::string_view piece = stream.substr(0, wanted);
    stream.remove_prefix(piece.size());
    held += piece.size();
    most_held = std::max(most_held, held);

    largest = 0;
    armed = true;
    decoder.feed(piece);
    armed = false;
    held -= drain(decoder, outcome);
    // A string that grows doubles, and up to half of it may be frames already given out.
    check(largest <= 4 * most_held + 64, "nothing larger is allocated than what has come");
    if (outcome.error) break;
    check(decoder.in_frame() == (held > 0), "in_frame() tells whether bytes are held");
  }
  outcome.in_frame = decoder.in_frame();
  return outcome;
}

/// Any bytes as a stream.
void check_stream(const std::string& stream, const std::string& cuts, std::size_t limit) {
  const Outcome pieces = decode(stream, cuts, limit);
  check(pieces == decode(stream, {}, limit), "the pieces make no difference");
  for (const std::string& payload : pieces.payloads) {
    check(!payload.empty() && payload.size() <= limit, "a payload keeps to the limits");
  }

  // What it gave is what the stream begins with.
  std::string encoded;
  for (const std::string& payload : pieces.payloads) encoded += wire::encode_frame(payload);
  check(stream.starts_with(encoded), "payloads are the bytes of the stream");
  if (!pieces.error) check(pieces.in_frame == (encoded.size() < stream.size()), "nothing is lost");
}

/// Any bytes as payloads.
void check_payloads(std::string_view bytes, const std::string& cuts) {
  std::vector<std::string> payloads;
  std::string stream;
  for (std::size_t i = 0; !bytes.empty(); ++i) {
    const std::size_t size = cuts.empty() ? bytes.size() : 7u * (i + 1) + cuts.size();
    payloads.emplace_back(bytes.substr(0, size));
    bytes.remove_prefix(std::min(size, bytes.size()));
    stream += wire::encode_frame(payloads.back());
  }
  const Outcome outcome = decode(stream, cuts, wire::max_frame);
  check(!outcome.error && !outcome.in_frame, "encoded frames are whole");
  check(outcome.payloads == payloads, "payloads come back");
}

/// The decoder's limit, from the last three bytes, little-endian.
std::size_t take_limit(std::string_view& input) {
  std::size_t number = 0;
  for (int i = 0; i < 3 && !input.empty(); ++i) {
    number |= static_cast<std::size_t>(static_cast<unsigned char>(input.back())) << 8 * (2 - i);
    input.remove_suffix(1);
  }
  return 1 + number % wire::max_frame;
}

/// The sizes of the pieces: up to eight bytes, or those before "\\x".
std::string take_cuts(std::string_view& input) {
  const std::size_t end = std::min({input.find('\\'), input.size(), std::size_t{8}});
  const std::string cuts(input.substr(0, end));
  const bool marked = end < input.size() && input[end] == '\\';
  input.remove_prefix(marked ? std::min(end + 2, input.size()) : end);
  return cuts;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  check(__sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) != 0,
        "allocations can be watched");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t limit = take_limit(input);
  const std::string cuts = take_cuts(input);
  const std::string bytes(input);
  check_stream(bytes, cuts, limit);
  check_payloads(bytes, cuts);
  return 0;
}
