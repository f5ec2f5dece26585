#include "common/color/adaptation.h"

#include <algorithm>
#include <cmath>

namespace metamer {
namespace {

// 3.2.2, M_CAT1 to M_CAT4.
// Hunt, Pointer and Estévez's cones, as R. W. G. Hunt gives them for equal energy.
constexpr Matrix3 cat1 = {{{0.3897, 0.6890, -0.0787}, {-0.2298, 1.1834, 0.0464}, {0, 0, 1}}};
// K. M. Lam, thesis, University of Bradford (1985).
constexpr Matrix3 cat2 = {
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
// G. D. Finlayson and S. Süsstrunk, Performance of a chromatic adaptation transform based on
// spectral sharpening (2000).
constexpr Matrix3 cat3 = {
    {{1.2694, -0.0988, -0.1706}, {-0.8364, 1.8006, 0.0357}, {0.0297, -0.0315, 1.0018}}};
// C. Li, M. R. Luo, B. Rigg and R. W. G. Hunt, CMC 2000 chromatic adaptation transform (2002).
constexpr Matrix3 cat4 = {
    {{0.7982, 0.3389, -0.1371}, {-0.5918, 1.5512, 0.0406}, {0.0008, 0.0239, 0.9753}}};

const Matrix3& responses(Adaptation adaptation) {
  switch (adaptation) {
    case Adaptation::von_kries:
      return cat1;
    case Adaptation::bradford:
      return cat2;
    case Adaptation::sharp:
      return cat3;
    case Adaptation::cmccat2000:
      return cat4;
    case Adaptation::none:
      break;
  }
  return identity3;
}

}  // namespace

const std::vector<std::string>& adaptation_words() {
  static const std::vector<std::string> words = {"none", "von-kries", "bradford", "sharp",
                                                 "cmccat2000"};
  return words;
}

std::optional<Adaptation> find_adaptation(std::string_view word) {
  const auto& words = adaptation_words();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<Adaptation>(found - words.begin());
}

Result<Matrix3> adaptation_matrix(Adaptation adaptation, const Xyz& from, const Xyz& to) {
  if (adaptation == Adaptation::none) return identity3;
  const Matrix3& cat = responses(adaptation);
  const Vector3 before = multiply(cat, from), after = multiply(cat, to);
  Matrix3 scaled = cat;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(before[i] > 0) || !(after[i] > 0) || !std::isfinite(after[i] / before[i]))
      return problem("no eye adapts to a white of X " + number_text(from[0]) + ", Y " +
                     number_text(from[1]) + ", Z " + number_text(from[2]) + ": the responses of " +
                     adaptation_words()[static_cast<std::size_t>(adaptation)] +
                     " to it are not all above 0");
    for (double& value : scaled[i]) value *= after[i] / before[i];
  }
  return multiply(invert(cat), scaled);
}

}  // namespace metamer
