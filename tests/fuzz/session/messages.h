#pragma once

#include <google/protobuf/message.h>

#include "bytes.h"
#include "facts.h"
#include "metamer/v1/envelope.pb.h"

namespace metamer::fuzz {

/// Sets fields of any message from the bytes: numbers that are small, large or of something that
/// exists, texts of digests and tokens that exist or of the bytes themselves.
void fill(google::protobuf::Message& message, Bytes& bytes, const Facts& facts);

/// A message whose body is any member of the oneof `body`, filled.
template <class Envelope>
Envelope any_envelope(Bytes& bytes, const Facts& facts) {
  Envelope envelope;
  const auto& body = *Envelope::descriptor()->FindOneofByName("body");
  const auto* field = body.field(static_cast<int>(bytes.pick(std::size_t(body.field_count()))));
  fill(*Envelope::GetReflection()->MutableMessage(&envelope, field), bytes, facts);
  return envelope;
}

}  // namespace metamer::fuzz
