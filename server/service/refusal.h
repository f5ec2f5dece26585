#pragma once

#include <string>
#include <tl/expected.hpp>

#include "metamer/v1/session.pb.h"

namespace metamer::service {

/// Why a request is not carried out: what becomes an Error on the wire.
struct Refusal {
  v1::Error::Code code = v1::Error::UNSPECIFIED;
  std::string message;
};

inline tl::unexpected<Refusal> refuse(v1::Error::Code code, std::string message) {
  return tl::unexpected(Refusal{code, std::move(message)});
}

}  // namespace metamer::service
