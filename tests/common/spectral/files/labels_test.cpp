#include "common/spectral/files/labels.h"

#include <gtest/gtest.h>

namespace metamer::spectrum_text {
namespace {

double wavelength(std::string_view label, char decimal = '.') {
  const auto found = labelled_wavelength(label, decimal);
  return found ? found->value : 0;
}

TEST(Labels, FindTheWavelengthOfEverySpelling) {
  for (const char* label : {"SPEC_380",
                            "spec_380",
                            "SPECTRAL_NM380",
                            "SPECTRAL_NM_380",
                            "Spectral_nm380",
                            "nm380",
                            "NM380",
                            "Nm_380",
                            "R_380",
                            "r_380",
                            "WL380",
                            "380nm",
                            "380 nm",
                            "380[nm]",
                            "380 [nm]",
                            "380 (nm)",
                            "Spectral Data 380[nm]",
                            " 380 NM ",
                            "SPEC_380.0",
                            "380.00nm",
                            "R380",
                            "r 380",
                            "R[380nm]",
                            "R [380 nm]",
                            "R(380)",
                            "T380",
                            "Spec380",
                            "rho(380 nm)"})
    EXPECT_EQ(wavelength(label), 380) << label;
  EXPECT_EQ(wavelength("0.38 µm"), 0.38);
  EXPECT_EQ(wavelength("0.38um"), 0.38);
  EXPECT_EQ(wavelength("0,38 µm", ','), 0.38);
  EXPECT_EQ(labelled_wavelength("0.38 μm")->unit, WavelengthUnit::um) << "the Greek letter";
  EXPECT_EQ(labelled_wavelength("SPEC_380")->unit, std::nullopt);
  EXPECT_EQ(labelled_wavelength("nm380")->unit, WavelengthUnit::nm);
}

TEST(Labels, AreNoneWhereNoWavelengthIsSaid) {
  for (const char* label :
       {"",          "380",     "SAMPLE_ID", "RGB_R", "XYZ_X", "LAB_L",     "D_RED",
        "SPEC_",     "nm",      "R",         "R_",    "R_x",   "SPEC_-380", "SPEC_380x",
        "SPEC_38e1", "nm1e999", "Probe 12",  "380%",  "[nm]",  "380]",      "SPEC_380 400",
        "nan nm",    "R1",      "R15",       "R(9)",  "R[x]",  "[]",        "()"})
    EXPECT_FALSE(labelled_wavelength(label)) << label;
}

TEST(Labels, TellUnitsAndPercents) {
  for (const char* heading : {"Wavelength [nm]", "wavelength (nm)", "nm", "lambda / nm"})
    EXPECT_EQ(unit_in(heading), WavelengthUnit::nm) << heading;
  for (const char* heading :
       {"Wavelength [µm]", "Wavelength (um)", "lambda/um", "microns", "wl_um"})
    EXPECT_EQ(unit_in(heading), WavelengthUnit::um) << heading;
  EXPECT_FALSE(unit_in("wavelength"));
  for (const char* heading : {"R [%]", "%R", "Reflectance (%)", "R / %", "percent", "%",
                              "Reflectance %", "Reflectance, %", "% Reflectance", "%Reflectance",
                              "Remission %", "Reflectance in %", "pct"})
    EXPECT_TRUE(says_percent(heading)) << heading;
  for (const char* heading : {"cotton 100%", "100 % wool", "R", ""})
    EXPECT_FALSE(says_percent(heading)) << heading;
}

TEST(Labels, TellWhatIsMeasuredWhereWordsAgree) {
  EXPECT_EQ(quantity_in("Reflectance (%)"), Quantity::reflectance);
  EXPECT_EQ(quantity_in("# TRANSMISSION"), Quantity::transmittance);
  EXPECT_EQ(quantity_in("spectral irradiance, W/(m2 nm)"), Quantity::emission);
  EXPECT_EQ(quantity_in("radiance"), Quantity::emission);
  EXPECT_EQ(quantity_in("reflectance and transmittance"), std::nullopt);
  EXPECT_EQ(quantity_in("paint"), std::nullopt);
}

TEST(Labels, TellLampsByTheirUnitsAndWords) {
  for (const char* heading : {"µW/cm²/nm", "uW/cm2/nm", "mW/m²/nm", "W/nm", "W m-2 nm-1",
                              "W·m⁻²·nm⁻¹", "Power (a.u.)", "Intensity (counts)", "Counts",
                              "Bestrahlungsstärke", "Strahldichte [W/(m² sr nm)]", "Intensität"})
    EXPECT_EQ(quantity_of_heading(heading), Quantity::emission) << heading;
  EXPECT_EQ(quantity_of_heading("%T"), Quantity::transmittance);
  EXPECT_EQ(quantity_of_heading("T [%]"), Quantity::transmittance);
  EXPECT_EQ(quantity_of_heading("% R"), Quantity::reflectance);
  for (const char* heading : {"T", "R", "red", "wool", "A [%]", "Tor %"})
    EXPECT_EQ(quantity_of_heading(heading), std::nullopt) << heading;
}

TEST(Labels, OfValuesMayNameTheWavelengthThatTheyAreAt) {
  for (const char* heading : {"Wavelength", "λ", "λ [nm]", "lambda/nm", "wl", "nm", "Wellenlänge"})
    EXPECT_TRUE(says_wavelength(heading)) << heading;
  for (const char* heading : {"R(λ)", "S(λ)", "E(lambda)", "X(lambda)", "ρ(λ) [%]", "R_lambda"})
    EXPECT_FALSE(says_wavelength(heading)) << heading;
}

TEST(Labels, TellWhatIsNoSpectrumByWavelength) {
  EXPECT_EQ(unusable_axis("Frequency (THz)"), "frequencies");
  for (const char* heading : {"cm-1", "Wavenumber (cm^-1)", "Raman shift"})
    EXPECT_EQ(unusable_axis(heading), "wavenumbers") << heading;
  EXPECT_EQ(unusable_axis("Energy (eV)"), "energies");
  EXPECT_EQ(unusable_axis("Wavelength (Å)"), "ångströms");
  EXPECT_EQ(unusable_axis("lambda (m)"), "metres");
  for (const char* heading : {"Wavelength (nm)", "µm", ""}) EXPECT_EQ(unusable_axis(heading), "");
  for (const char* heading :
       {"Absorbance", "Abs", "abs.", "Abs (a.u.)", "Extinktion", "Extinction (OD)"})
    EXPECT_EQ(unusable_quantity(heading), "absorbance") << heading;
  EXPECT_EQ(unusable_quantity("OD"), "density");
  EXPECT_EQ(unusable_quantity("K/S"), "K/S");
  EXPECT_EQ(unusable_quantity("log10 R"), "a logarithm");
  EXPECT_EQ(unusable_quantity("Photon flux (µmol/m²/s/nm)"), "a number of photons");
  for (const char* heading :
       {"Reflectance", "red", "irradiance W/m2", "code", "extinction coefficient", "abstract"})
    EXPECT_EQ(unusable_quantity(heading), "") << heading;
}

}  // namespace
}  // namespace metamer::spectrum_text
