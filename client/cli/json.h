#pragma once

#include <google/protobuf/message.h>

#include <nlohmann/json.hpp>

#include "client/cli/names.h"
#include "common/problem.h"

namespace metamer::cli {

using Json = nlohmann::ordered_json;

/// A message as JSON: fields under their own names, defaults included, enum values as words
/// ("bad-input"), digests in hex. Pixels are left out: they go into picture files.
Json to_json(const google::protobuf::Message& message);

Json to_json(const Problem& problem);

}  // namespace metamer::cli
