#pragma once

#include "server/methods/light_tables.h"
#include "server/methods/method.h"
#include "server/transport/factor_rows.h"

namespace metamer {

/// Every method whose carrier is a list of independent values, one a band: reflection multiplies
/// band by band, and XYZ is three dot products; where all that light meets on its way is grey, they
/// are those of its surface under the light, which a thread remembers. `point` has a band a
/// wavelength, `rgb` has three.
class BandedMethod : public Method {
 public:
  struct Tables {
    LightTables lights;
    BandTable rows;  ///< A row for each of FactorRows.
    BandTable xyz;   ///< Three rows, the weights of X, Y and Z.
  };
  /// `learned`: what the choice of the bands has cost (preparation_cost).
  BandedMethod(FactorRows rows, Tables tables, double learned = 0);

  std::unique_ptr<Scratch> make_scratch() const override;
  std::array<float, 3> resolve(const Gather& gather, float scale, Scratch& scratch) const override;
  DirectTables direct_tables() const override;
  double preparation_cost() const override;
  double resolve_cost(const Gather& gather) const override;

 private:
  struct Fold;

  /// X Y Z of a row by itself under each light.
  std::vector<float> color_of(std::uint32_t row) const;
  DirectTables color_tables() const;

  FactorRows rows_;
  Tables tables_;
  double learned_;
  std::vector<bool> is_grey_;  ///< By row: the same in every band.
};

}  // namespace metamer
