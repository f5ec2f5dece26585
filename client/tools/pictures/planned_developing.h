#pragma once

#include <string>

#include "common/image/image.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::client {

/// How a plan's X Y Z become the numbers of a picture file.
struct PlannedDeveloping {
  Developing developing;
  std::string unadapted;    ///< Why the adaptation that was asked for can't be done; empty: it can.
  std::string shown_white;  ///< What a white other than D65 makes of it; empty: nothing.
};

/// Error: the server planned a space that there can't be.
Result<PlannedDeveloping> planned_developing(const v1::Plan& plan);

/// The picture (X Y Z) as it is to be shown, adapted, and nothing else.
Image adapted(Image picture, const Developing& developing);

}  // namespace metamer::client
