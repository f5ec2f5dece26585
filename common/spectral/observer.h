#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "common/spectral/spectrum.h"

namespace metamer {

/// Who sees: the colour matching functions x̄, ȳ, z̄ by which light becomes X Y Z, within 360 to 830
/// nm (observer_from_nm), straight lines between their samples and 0 outside. A handle of what
/// never changes: cheap to copy, to be used from any thread. The CIE's are in cie.h.
class Observer {
 public:
  using Functions = std::array<Spectrum, 3>;

  Observer(std::string name, Functions functions, bool is_cut = false);

  /// Of the CIE's, the word of the command line; of one's own, the file's name.
  const std::string& name() const { return data_->name; }
  const Functions& functions() const { return data_->functions; }

  /// Its tables see something outside 360 to 830 nm, which is left out.
  bool is_cut() const { return data_->is_cut; }

  /// Alike in their functions, whatever their names.
  friend bool operator==(const Observer& a, const Observer& b) {
    return a.data_ == b.data_ || a.functions() == b.functions();
  }

 private:
  struct Data {
    std::string name;
    Functions functions;
    bool is_cut;
  };
  std::shared_ptr<const Data> data_;
};

/// A matching function as observers have it, of its table: where that is uniform by more than 1 nm,
/// Sprague's interpolation to 1 nm (or the nearest part of the step below), which does not fall
/// below the table's smallest value and 0; else, and of fewer than 6 samples, the table.
Spectrum matching_function(const Spectrum& table);

/// What keeps tables from being an observer's: a value above 1e6 in size; ȳ negative, or nowhere
/// above 1e-6 between 360 and 830 nm; x̄ or z̄ below −1 % of its largest value, which rounded
/// transformations of cone fundamentals keep to and r̄ ḡ b̄ do not; fewer than two samples. Nothing:
/// they are sound.
std::optional<std::string> observer_fault(const Observer::Functions& tables);

/// An observer of one's own: matching_function of its tables, from 360 to 830 nm. Error: its fault.
Result<Observer> make_observer(std::string name, const Observer::Functions& tables);

}  // namespace metamer
