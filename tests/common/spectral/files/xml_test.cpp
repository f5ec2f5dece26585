// CxF3 and IES TM-27, through read_spectrum_file.
#include <gtest/gtest.h>

#include "common/spectral/files/spectrum_file.h"

namespace metamer {
namespace {

std::string xml_error(const std::string& text) {
  const auto read = read_spectrum_file(text, "a.cxf");
  return read ? "no error" : format(read.error());
}

SpectrumFile xml(const std::string& text) {
  auto read = read_spectrum_file(text, "a.cxf");
  if (!read) ADD_FAILURE() << format(read.error());
  return read ? std::move(*read) : SpectrumFile{};
}

/// A CxF file with what stands for its objects and its wavelengths, with a namespace's prefix.
std::string cxf(const std::string& prefix, const std::string& objects,
                const std::string& range = " StartWL=\"400\" Increment=\"10\"") {
  const std::string p = prefix.empty() ? "" : prefix + ":";
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<@CxF><@Resources>" + objects +
                     "<@ColorSpecificationCollection><@ColorSpecification Id=\"CS1\">"
                     "<@MeasurementSpec><@WavelengthRange" +
                     range +
                     "/></@MeasurementSpec></@ColorSpecification>"
                     "</@ColorSpecificationCollection></@Resources></@CxF>\n";
  for (std::size_t at; (at = text.find('@')) != std::string::npos;) text.replace(at, 1, p);
  return text;
}

const std::string red =
    "<@ObjectCollection><@Object Name=\"Rot &amp; matt\"><@ColorValues><@ReflectanceSpectrum "
    "ColorSpecification=\"CS1\">0.1 0.2\n0.3</@ReflectanceSpectrum></@ColorValues></@Object>"
    "</@ObjectCollection>";

TEST(Cxf, ReadsReflectances) {
  for (const std::string prefix : {"", "cc", "cxf3"}) {
    const SpectrumFile file = xml(cxf(prefix, red));
    EXPECT_EQ(file.format, "CxF3");
    EXPECT_EQ(file.quantity, Quantity::reflectance);
    ASSERT_EQ(file.spectra.size(), 1U);
    EXPECT_EQ(file.spectra[0].name, "Rot & matt");
    EXPECT_EQ(file.spectra[0].spectrum, (Spectrum{{400, 410, 420}, {0.1, 0.2, 0.3}}));
  }
}

TEST(Cxf, ReadsEmissionsAndTheirOwnRange) {
  for (const std::string kind : {"EmissionSpectrum", "EmissiveSpectrum"}) {
    const SpectrumFile file = xml(
        cxf("cc", "<@Object Name=\"lamp\"><@" + kind + " StartWL=\"380\" Increment=\"5\">1 2</@" +
                      kind + "></@Object><@Object Name=\"b\"><@" + kind +
                      " ColorSpecification=\"CS1\">7</@" + kind + "></@Object>"));
    EXPECT_EQ(file.quantity, Quantity::emission);
    ASSERT_EQ(file.spectra.size(), 2U) << kind;
    EXPECT_EQ(file.spectra[0].spectrum, (Spectrum{{380, 385}, {1, 2}}));
    EXPECT_EQ(file.spectra[1].spectrum, (Spectrum{{400}, {7}}));
  }
}

TEST(Cxf, LocatesWhatIsWrong) {
  EXPECT_EQ(xml_error("<CxF><a></CxF>"),
            "a.cxf:1:11: error: no sound XML: Start-end tags mismatch");
  EXPECT_EQ(xml_error("<html/>"), "a.cxf:1:2: error: XML of \"html\", not of CxF or IESTM2714");
  EXPECT_EQ(xml_error("<CxF>\n</CxF>"),
            "a.cxf:1:2: error: the CxF file has colours, but no spectrum");
  EXPECT_EQ(
      xml_error(cxf("", red, "")),
      "a.cxf:2:79: error: neither the spectrum nor its ColorSpecification \"CS1\" has StartWL");
  EXPECT_EQ(xml_error("<CxF>\n<Object><ReflectanceSpectrum StartWL=\"4\" Increment=\"0\">1 "
                      "2</ReflectanceSpectrum></Object></CxF>"),
            "a.cxf:2:10: error: Increment must be above 0");
  EXPECT_EQ(xml_error("<CxF>\n<Object><ReflectanceSpectrum StartWL=\"400\">x</ReflectanceSpectrum>"
                      "</Object></CxF>"),
            "a.cxf:2:10: error: \"x\" is not a number");
  EXPECT_EQ(xml_error("<CxF><Object><ReflectanceSpectrum StartWL=\"400\"/></Object></CxF>"),
            "a.cxf:1:15: error: the spectrum has no values");
}

TEST(Cxf, BelievesNoDocumentType) {
  // Entities of its own could be a file or a billion of words.
  const std::string text =
      "<!DOCTYPE CxF [<!ENTITY v SYSTEM \"/etc/hostname\">]>\n<CxF><Object><ReflectanceSpectrum "
      "StartWL=\"400\">&v;</ReflectanceSpectrum></Object></CxF>";
  EXPECT_EQ(xml_error(text), "a.cxf:2:15: error: \"&v;\" is not a number");
}

TEST(Cxf, BearsAHundredThousandElementsInEachOther) {
  std::string text = "<CxF>";
  for (int i = 0; i < 100000; ++i) text += "<a>";
  for (int i = 0; i < 100000; ++i) text += "</a>";
  EXPECT_EQ(xml_error(text + "</CxF>"),
            "a.cxf:1:2: error: the CxF file has colours, but no spectrum");
}

TEST(Tm27, ReadsASpectralDistribution) {
  const SpectrumFile file =
      xml("<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\n<Header>"
          "<Description>Lamp</Description></Header>\n<SpectralDistribution>\n<SpectralQuantity>flux"
          "</SpectralQuantity>\n<SpectralData wavelength=\"380.0\">0.25</SpectralData>\n"
          "<SpectralData wavelength=\"381.5\"> 1e-1 "
          "</SpectralData></SpectralDistribution></IESTM2714>");
  EXPECT_EQ(file.format, "IES TM-27");
  EXPECT_EQ(file.quantity, Quantity::emission);
  ASSERT_EQ(file.spectra.size(), 1U);
  EXPECT_EQ(file.spectra[0].spectrum, (Spectrum{{380, 381.5}, {0.25, 0.1}}));
}

TEST(Tm27, KnowsReflectancesAndLocatesWhatIsWrong) {
  const auto tm27 = [](const std::string& data) {
    return "<IESTM2714><SpectralDistribution><SpectralQuantity>Reflectance</SpectralQuantity>\n" +
           data + "</SpectralDistribution></IESTM2714>";
  };
  EXPECT_EQ(xml(tm27("<SpectralData wavelength='400'>1</SpectralData>")).quantity,
            Quantity::reflectance);
  EXPECT_EQ(xml_error(tm27("<SpectralData>1</SpectralData>")),
            "a.cxf:2:2: error: \"\" is not a number");
  EXPECT_EQ(xml_error(tm27("<SpectralData wavelength='400'/>")),
            "a.cxf:2:2: error: \"\" is not a number");
  EXPECT_EQ(xml_error(tm27("<SpectralData wavelength='400'>1</SpectralData>\n"
                           "<SpectralData wavelength='400'>1</SpectralData>")),
            "a.cxf:3:2: error: wavelength 400 is repeated");
  EXPECT_EQ(xml_error("<IESTM2714/>"), "a.cxf:1:2: error: the file has no SpectralDistribution");
}

}  // namespace
}  // namespace metamer
