#pragma once

#include <string>

#include "client/tools/spectra/spectra_files.h"
#include "common/spectral/observer.h"
#include "metamer/v1/scene.pb.h"

/// Observers by the words of the command line: those of observer_named, or a file's name.
namespace metamer::client {

struct ChosenObserver {
  v1::Observer cie;
  std::string file;  ///< Of one's own, which takes the place of the CIE's; empty: none.
};

/// Error: neither an observer nor a file is called so.
Result<ChosenObserver> choose_observer(const std::string& word);

/// The observer itself. Errors: those of choose_observer and parse_observer.
SpectrumResult<Observer> load_observer(const std::string& word);

}  // namespace metamer::client
