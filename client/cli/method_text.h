#pragma once

#include <string>

#include "metamer/v1/scene.pb.h"

namespace metamer::cli {

/// A method with its parameters as a person reads it: "point 400:700:5", "linear 4 observer
/// bounce".
std::string method_text(const v1::Method& method);

}  // namespace metamer::cli
