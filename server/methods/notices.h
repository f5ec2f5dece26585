#pragma once

#include <string>

#include "metamer/v1/plan.pb.h"

/// What a plan says of methods.
namespace metamer {

/// The bands that a method found where `asked` were asked for at `field`; a notice where they are
/// fewer: "the scene's spectra <verb> no more than 3 <noun>s".
void plan_found(std::size_t found, std::size_t asked, const char* field, const std::string& verb,
                const std::string& noun, v1::Plan& plan);

}  // namespace metamer
