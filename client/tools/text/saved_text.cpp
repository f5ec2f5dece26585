#include "client/tools/text/saved_text.h"

#include <cmath>

#include "client/tools/text/job_text.h"

namespace metamer::client {

std::vector<std::string> saved_notes(const SavedPicture& saved, const v1::Plan& plan,
                                     const PlannedDeveloping& planned) {
  std::vector<std::string> notes;
  if (saved.spectral && !plan.method().has_exact())
    notes.emplace_back(
        "its spectra are those of the exact method, whatever the other files are rendered by");
  for (const SeenLight& one : saved.mis_seen)
    notes.push_back("its wavelengths see " + number_text(std::round(one.share * 1000) / 10) +
                    " % of the luminance of light " + quoted(one.light));
  if (saved.clipped.negative > 0)
    notes.push_back(counted(saved.clipped.negative, "pixel", "pixels") + " outside the " +
                    planned.developing.space.name + " gamut, clipped");
  if (saved.clipped.above > 0)
    notes.push_back(counted(saved.clipped.above, "pixel", "pixels") +
                    " brighter than white, clipped");
  return notes;
}

}  // namespace metamer::client
