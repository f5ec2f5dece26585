#pragma once

#include <tl/expected.hpp>

#include "metamer/v1/envelope.pb.h"
#include "server/service/access/identity.h"
#include "server/service/refusal.h"

namespace metamer::service {

/// The least role that may ask this; ROLE_UNSPECIFIED for what no client may. What a request names
/// is looked for only among what Identity::sees.
v1::Role least_role(v1::Envelope::BodyCase request);

/// Refused: FORBIDDEN where the role is not enough.
tl::expected<void, Refusal> permit(const Identity& identity, v1::Envelope::BodyCase request);

/// "viewer", "submitter", "admin"
const char* word(v1::Role role);
/// ROLE_UNSPECIFIED: there is no such word.
v1::Role role_of(std::string_view word);

}  // namespace metamer::service
