#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "common/problem.h"

/// What a text must be to be the value of an option, beyond a word of a list. Errors say what was
/// expected.
namespace metamer::service {

/// unix:PATH, HOST:PORT or tls:HOST:PORT.
Result<void> check_endpoint(const std::string& text);
/// See socket_mode_of().
Result<void> check_mode(const std::string& text);
/// auto, reference, or a number from 0 to 15.
Result<void> check_gl_device(const std::string& text);

/// Octal digits; nothing: they are no mode that lets anybody connect.
std::optional<mode_t> socket_mode_of(const std::string& text);

}  // namespace metamer::service
