#pragma once

#include "server/cpu/media.h"
#include "server/cpu/packet.h"

namespace metamer::cpu {

/// Follows the active rays of a packet from `packet.point` straight towards a light, through clear
/// objects whose shadow is clear and what is not all there, by whose share its throughput falls.
/// What stays active is lit; its chain goes on by what the light meets: the interfaces at the
/// straight ray's angle, taken as that on their rarer side, and the media between. Light that a
/// surface bends and gathers, a caustic, is not found.
void light_through(const Media& media, const EmbreeScene& geometry, const Vectors& to_light,
                   Floats reach, Packet& packet, Workspace& workspace);

}  // namespace metamer::cpu
