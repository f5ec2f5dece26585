#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "metamer/v1/problem.pb.h"
#include "metamer/v1/session.pb.h"

namespace metamer::client {

/// Why a session, or one request of it, came to nothing.
struct SessionError {
  enum class Kind {
    no_server,     ///< Nobody listens there, or the private server did not start.
    version,       ///< The server speaks another version of the protocol.
    disconnected,  ///< The connection was lost; jobs on the server go on.
    input,         ///< A file of this side can't be read or sent.
    refused,       ///< The server answered Error; `code` says which.
  };
  Kind kind = Kind::disconnected;
  std::string message;  ///< One sentence, no capital, no full stop.
  v1::Error::Code code = v1::Error::UNSPECIFIED;
  std::vector<v1::Problem> problems;
};

/// What a request gives, or why it gave nothing.
template <class T>
using Answer = tl::expected<T, SessionError>;

inline tl::unexpected<SessionError> session_error(SessionError::Kind kind, std::string message) {
  SessionError error;
  error.kind = kind;
  error.message = std::move(message);
  return tl::unexpected<SessionError>(std::move(error));
}

}  // namespace metamer::client
