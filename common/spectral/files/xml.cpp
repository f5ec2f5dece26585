#include "common/spectral/files/xml.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <pugixml.hpp>

#include "common/spectral/files/labels.h"
#include "common/spectral/wavelengths.h"

namespace metamer::spectrum_text {
namespace {

using pugi::xml_node;

/// The name of an element without its namespace's prefix.
std::string_view local_name(const xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(std::min(name.find(':') + 1, name.size()));
}

/// Elements of one name below another, at any depth, in their order.
std::vector<xml_node> all_named(const xml_node& above, std::string_view name) {
  std::vector<xml_node> found;
  for (xml_node node = above.first_child(); node && node != above;) {
    if (local_name(node) == name) found.push_back(node);
    // Walk on in the document's order; pugixml's own walk recurses.
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node != above && !node.next_sibling()) node = node.parent();
    if (node != above) node = node.next_sibling();
  }
  return found;
}

class Document {
 public:
  Document(std::string_view text, const std::string& file) : text_(text), file_(file) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') lines_.push_back(i + 1);
  }

  Result<Contents> read();

 private:
  using Done = tl::expected<void, Problem>;

  /// Where a byte of the text is.
  Token place(std::ptrdiff_t offset) const;
  Token place(const xml_node& node) const { return place(node.offset_debug()); }
  Result<double> number(const xml_node& node, std::string_view text) const;
  Done add(RawSpectrum spectrum);

  Result<Contents> read_cxf(const xml_node& root);
  Done read_cxf_spectrum(const xml_node& spectrum, const xml_node& object, Quantity quantity);
  Result<double> cxf_range(const xml_node& spectrum, const char* name) const;
  Result<Contents> read_tm27(const xml_node& root);

  std::string_view text_;
  const std::string& file_;
  std::vector<std::size_t> lines_ = {0};            ///< Where they begin.
  std::map<std::string, xml_node> specifications_;  ///< CxF's ColorSpecification by Id.
  Contents contents_;
};

Token Document::place(std::ptrdiff_t offset) const {
  const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
  const auto line = std::upper_bound(lines_.begin(), lines_.end(), at) - lines_.begin();
  return {.text = {},
          .line = static_cast<int>(line),
          .column = static_cast<int>(at - lines_[static_cast<std::size_t>(line - 1)]) + 1};
}

Result<double> Document::number(const xml_node& node, std::string_view text) const {
  Token token = place(node);
  token.text = text;
  return parse_number(file_, token);
}

Document::Done Document::add(RawSpectrum spectrum) {
  if (contents_.spectra.size() == max_spectra)
    return problem_at(file_, spectrum.begin,
                      "at most " + std::to_string(max_spectra) + " spectra are possible");
  if (spectrum.at.empty()) return problem_at(file_, spectrum.begin, "the spectrum has no values");
  contents_.spectra.push_back(std::move(spectrum));
  return {};
}

/// StartWL or Increment: of the spectrum itself, else of its ColorSpecification.
Result<double> Document::cxf_range(const xml_node& spectrum, const char* name) const {
  if (const auto own = spectrum.attribute(name)) return number(spectrum, own.value());
  const std::string id = spectrum.attribute("ColorSpecification").value();
  if (const auto found = specifications_.find(id); found != specifications_.end())
    for (const xml_node& range : all_named(found->second, "WavelengthRange"))
      if (const auto of_all = range.attribute(name)) return number(range, of_all.value());
  return problem_at(file_, place(spectrum),
                    std::string("neither the spectrum nor its ColorSpecification ") + quoted(id) +
                        " has " + name);
}

Document::Done Document::read_cxf_spectrum(const xml_node& spectrum, const xml_node& object,
                                           Quantity quantity) {
  if (contents_.quantity && *contents_.quantity != quantity)
    return problem_at(file_, place(spectrum), "the file has spectra of several kinds");
  contents_.quantity = quantity;
  RawSpectrum raw{.name = object.attribute("Name").value(), .begin = place(spectrum)};
  Tokens words(spectrum.child_value());
  while (const auto word = words.next()) {
    if (raw.values.size() == Wavelengths::max_count)
      return problem_at(
          file_, raw.begin,
          "at most " + std::to_string(Wavelengths::max_count) + " samples are possible");
    const Result<double> value = number(spectrum, word->text);
    if (!value) return tl::unexpected(value.error());
    raw.values.push_back(*value);
  }
  const Result<double> start = cxf_range(spectrum, "StartWL");
  if (!start) return tl::unexpected(start.error());
  double increment = 0;
  if (raw.values.size() > 1) {
    const Result<double> step = cxf_range(spectrum, "Increment");
    if (!step) return tl::unexpected(step.error());
    if (!(*step > 0)) return problem_at(file_, raw.begin, "Increment must be above 0");
    increment = *step;
  }
  for (std::size_t i = 0; i < raw.values.size(); ++i) {
    const double at = *start + increment * static_cast<double>(i);
    if (auto wrong = wrong_next(raw.at, at)) return problem_at(file_, raw.begin, std::move(*wrong));
    raw.at.push_back(at);
  }
  return add(std::move(raw));
}

Result<Contents> Document::read_cxf(const xml_node& root) {
  contents_.format = "CxF3";
  contents_.unit = WavelengthUnit::nm;
  for (const xml_node& specification : all_named(root, "ColorSpecification"))
    if (specification.attribute("Id"))
      specifications_.try_emplace(specification.attribute("Id").value(), specification);
  struct Kind {
    std::string_view name;
    Quantity quantity;
  };
  static constexpr std::array<Kind, 4> kinds = {{{"ReflectanceSpectrum", Quantity::reflectance},
                                                 {"TransmittanceSpectrum", Quantity::transmittance},
                                                 {"EmissiveSpectrum", Quantity::emission},
                                                 {"EmissionSpectrum", Quantity::emission}}};
  for (const xml_node& object : all_named(root, "Object"))
    for (const Kind& kind : kinds)
      for (const xml_node& spectrum : all_named(object, kind.name))
        if (Done done = read_cxf_spectrum(spectrum, object, kind.quantity); !done)
          return tl::unexpected(std::move(done.error()));
  if (contents_.spectra.empty())
    return problem_at(file_, place(root), "the CxF file has colours, but no spectrum");
  return std::move(contents_);
}

Result<Contents> Document::read_tm27(const xml_node& root) {
  contents_.format = "IES TM-27";
  contents_.unit = WavelengthUnit::nm;
  for (const xml_node& distribution : all_named(root, "SpectralDistribution")) {
    RawSpectrum raw{.begin = place(distribution)};
    for (const xml_node& sample : all_named(distribution, "SpectralData")) {
      if (raw.at.size() == Wavelengths::max_count)
        return problem_at(
            file_, place(sample),
            "at most " + std::to_string(Wavelengths::max_count) + " samples are possible");
      const Result<double> at = number(sample, sample.attribute("wavelength").value());
      if (!at) return tl::unexpected(at.error());
      const Tokens words(sample.child_value());
      const Result<double> value = number(sample, words.peek() ? words.peek()->text : "");
      if (!value) return tl::unexpected(value.error());
      if (auto wrong = wrong_next(raw.at, *at))
        return problem_at(file_, place(sample), std::move(*wrong));
      raw.at.push_back(*at);
      raw.values.push_back(*value);
    }
    std::string quantity;
    for (const xml_node& said : all_named(distribution, "SpectralQuantity"))
      quantity = lower(said.child_value());
    static const std::vector<std::string> powers = {
        "", "flux", "intensity", "irradiance", "radiance", "exitance", "relative", "other"};
    const auto said = quantity_in(quantity);
    if (!said && std::find(powers.begin(), powers.end(), quantity) == powers.end())
      return problem_at(
          file_, place(distribution),
          quoted(quantity) + " is neither a reflectance, a transmittance nor a power");
    contents_.quantity = said.value_or(Quantity::emission);
    if (Done done = add(std::move(raw)); !done) return tl::unexpected(std::move(done.error()));
  }
  if (contents_.spectra.empty())
    return problem_at(file_, place(root), "the file has no SpectralDistribution");
  return std::move(contents_);
}

Result<Contents> Document::read() {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed)
    return problem_at(file_, place(parsed.offset),
                      std::string("no sound XML: ") + parsed.description());
  const xml_node root = document.document_element();
  if (local_name(root) == "CxF") return read_cxf(root);
  if (local_name(root) == "IESTM2714") return read_tm27(root);
  return problem_at(file_, place(root),
                    "XML of " + quoted(local_name(root)) + ", not of CxF or IESTM2714");
}

}  // namespace

Result<Contents> read_xml(std::string_view text, const std::string& file) {
  return Document(text, file).read();
}

}  // namespace metamer::spectrum_text
