#pragma once

#include <memory>
#include <optional>
#include <span>

#include "common/color/xyz.h"
#include "metamer/v1/views.pb.h"
#include "server/plan/seen_spectra.h"
#include "server/worker/view_scene.h"

namespace metamer::worker {

/// Says what is at a place of a view. Keeps what it makes for that until the scene is another: of a
/// backend without one also a hierarchy, which the first place has to wait for. Belongs to the
/// lane's thread.
class ViewProbe {
 public:
  /// Everything but X Y Z, number and revision. Outside the picture nothing is met.
  v1::Probed look(ViewScene& scene, const v1::Plan& plan, const v1::Probe& probe);

  /// Lights or materials are others.
  void forget_appearance() { spectra_.reset(); }
  /// The renderer ends.
  void forget_scene() {
    spectra_.reset();
    probe_.reset();
  }

 private:
  std::unique_ptr<Probe> probe_;
  std::optional<SeenSpectra> spectra_;
};

/// X Y Z of the newest frame.
struct ShownFrame {
  std::uint32_t width, height;
  std::uint32_t part;           ///< One pixel of it stands for so many on a side.
  std::span<const float> sums;  ///< Of samples, row by row;
  float scale;                  ///< times this they are X Y Z.
};

/// The mean over the probe's square, as far as it lies in the picture, in which its middle lies.
Xyz mean_of(const ShownFrame& frame, const v1::Probe& probe);

}  // namespace metamer::worker
