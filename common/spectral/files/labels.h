#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/spectral/files/spectrum_file.h"

/// What the words of a spectrum file's headers mean.
namespace metamer::spectrum_text {

/// A wavelength as a label says it.
struct Labelled {
  double value;
  std::optional<WavelengthUnit> unit;  ///< Nothing: the label says none.
};

/// The wavelength of a column or a row that is called after it: "SPEC_380", "SPECTRAL_NM380",
/// "SPECTRAL_NM_380", "nm380", "NM_380", "R_380", "R380", "R[380nm]", "380nm", "380 [nm]",
/// "Spectral Data 380[nm]", "0.38 µm", in any case. A mere number is none; 0 is one that a name was
/// rounded to. `decimal` is its decimal sign.
std::optional<Labelled> labelled_wavelength(std::string_view label, char decimal = '.');

/// "[nm]", "Wavelength (µm)", "lambda / um", "microns": the unit that a heading gives.
std::optional<WavelengthUnit> unit_in(std::string_view heading);

/// Whether a heading says that values are percents: "R [%]", "Reflectance %", "percent"; not
/// "cotton 100%".
bool says_percent(std::string_view heading);

/// The name in a heading that ends with its unit: "wool" of "wool [%]" and "wool (%)".
std::string_view name_in(std::string_view heading);

/// What a heading of wavelengths says instead: "frequencies". Empty: nothing else.
std::string unusable_axis(std::string_view heading);

/// What a heading of values says that is neither a reflectance nor a power: "absorbance". Empty:
/// nothing such.
std::string unusable_quantity(std::string_view heading);

/// Whether a heading is that of the wavelengths.
bool says_wavelength(std::string_view heading);

/// What values are by the words of a heading or a remark: "reflectance", "irradiance, W/(m2 nm)".
/// Nothing: no such word, or words for several.
std::optional<Quantity> quantity_in(std::string_view text);

/// The same of a column's heading, where less says it: "%T", "Intensity (counts)", "Power (a.u.)".
std::optional<Quantity> quantity_of_heading(std::string_view heading);

/// ASCII letters in lower case, all else as it is.
std::string lower(std::string_view text);

}  // namespace metamer::spectrum_text
