#pragma once

#include <optional>

#include "server/import/transfer.h"

namespace metamer::import {

/// Sends one byte and, where it is one, a descriptor with it. False: the peer is gone.
bool send_descriptor(int socket, int descriptor = -1);

/// Takes such a byte. Nothing: the peer is gone. The descriptor may be none.
std::optional<Descriptor> receive_descriptor(int socket);

}  // namespace metamer::import
