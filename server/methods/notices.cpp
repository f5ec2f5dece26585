#include "server/methods/notices.h"

namespace metamer {

void plan_found(std::size_t found, std::size_t asked, const char* field, const std::string& verb,
                const std::string& noun, v1::Plan& plan) {
  plan.set_bands(static_cast<std::uint32_t>(found));
  if (found == asked) return;
  v1::Notice* notice = plan.add_notice();
  notice->set_field(field);
  notice->set_message("the scene's spectra " + verb + " no more than " + std::to_string(found) +
                      " " + noun + (found == 1 ? "" : "s"));
}

}  // namespace metamer
