// The frame codec against any bytes in any pieces: payloads come back whole, the pieces make no
// difference, and no length makes it allocate more than what has come.

#include <fuzzer/FuzzedDataProvider.h>
#include <sanitizer/allocator_interface.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check.h"
#include "common/wire/frame.h"

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

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  check(__sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) != 0,
        "allocations can be watched");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  const auto limit = input.ConsumeIntegralInRange<std::size_t>(1, wire::max_frame);
  const std::string cuts = input.ConsumeRandomLengthString(8);
  const std::string bytes = input.ConsumeRemainingBytesAsString();
  check_stream(bytes, cuts, limit);
  check_payloads(bytes, cuts);
  return 0;
}
