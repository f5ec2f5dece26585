#include <gtest/gtest.h>

#include "scene_text.h"

namespace metamer::test {
namespace {

Strings transmission_findings(const std::string& transmission, const std::string& more = "") {
  return findings({.material = "material { name: \"grey\" " + more + " transmission { " +
                               transmission + " } }"});
}
const std::string bk7 = "fresnel { dielectric { medium: \"N-BK7\" } }";

TEST(TransmissionCheck, NeedsAnIndexOfRefraction) {
  const Strings needed(
      {"material[0].transmission: transmission needs the material's index of "
       "refraction: fresnel { dielectric { medium: \"N-BK7\" } }, for example"});
  EXPECT_EQ(transmission_findings(""), needed);
  EXPECT_EQ(transmission_findings("", "fresnel { conductor { metal: \"Au\" } }"), needed);
  EXPECT_EQ(transmission_findings("", bk7), Strings());
}

TEST(TransmissionCheck, ItsSpectrumIsATransmittanceOfAThickness) {
  EXPECT_EQ(
      transmission_findings("transmittance { constant: 1.5 }", bk7),
      Strings({"material[0].transmission.transmittance.constant: a property must lie in 0..1 (it "
               "is 1.5)"}));
  EXPECT_EQ(transmission_findings("transmittance { constant: 0.5 } thickness: 0", bk7),
            Strings({"material[0].transmission.thickness: thickness must lie in 1e-09..1e+09 (it "
                     "is 0)"}));
  EXPECT_EQ(transmission_findings("thickness: 1", bk7),
            Strings({"material[0].transmission.thickness: thickness is that of a transmittance, "
                     "which is not given"}));
}

TEST(TransmissionCheck, HasNoMirrorBesideIt) {
  EXPECT_EQ(transmission_findings("", bk7 + " mirror: 1"),
            Strings({"material[0].transmission: transmission reflects by its Fresnel term already: "
                     "leave out mirror"}));
}

TEST(TransmissionCheck, PrioritiesAreBounded) {
  EXPECT_EQ(transmission_findings("priority: -1000001", bk7),
            Strings({"material[0].transmission.priority: priority must lie in -1e+06..1e+06 "
                     "(it is -1000001)"}));
}

}  // namespace
}  // namespace metamer::test
