#include "common/image/icc.h"

#include <lcms2.h>

#include <array>
#include <cassert>

#include "common/color/adaptation.h"
#include "common/color/srgb.h"

namespace metamer {
namespace {

/// ICC.1:2010, 7.2.16: the white of every profile.
constexpr Xyz d50 = {0.9642, 1.0, 0.8249};

/// A context of one's own: no other thread's errors.
using Context = std::shared_ptr<std::remove_pointer_t<cmsContext>>;
using Profile = std::unique_ptr<void, decltype(&cmsCloseProfile)>;

Context make_context() { return {cmsCreateContext(nullptr, nullptr), cmsDeleteContext}; }

void set_text(const Context& context, const Profile& profile, cmsTagSignature tag,
              const std::string& words) {
  cmsMLU* const text = cmsMLUalloc(context.get(), 1);
  cmsMLUsetASCII(text, "en", "US", words.c_str());
  cmsWriteTag(profile.get(), tag, text);
  cmsMLUfree(text);
}

/// Encoded → linear, of parametric type 3 of ICC.1 10.15, which is LittleCMS's 4.
cmsToneCurve* make_curve(const Context& context, const Transfer& t) {
  const std::array<double, 5> parameters = {t.gamma, 1 / (1 + t.offset), t.offset / (1 + t.offset),
                                            1 / t.slope, t.slope * t.knee};
  return cmsBuildParametricToneCurve(context.get(), 4, parameters.data());
}

std::string description_of(const Profile& profile) {
  std::array<char, 256> text{};
  cmsGetProfileInfoASCII(profile.get(), cmsInfoDescription, "en", "US", text.data(), text.size());
  return text.data();
}

}  // namespace

std::string icc_profile(const RgbSpace& space, bool linear) {
  const Context context = make_context();
  const auto xyy = [](const Chromaticity& c) { return cmsCIExyY{c.x, c.y, 1}; };
  const Primaries& p = space.primaries;
  const cmsCIExyY white = xyy(p.white);
  const cmsCIExyYTRIPLE primaries = {xyy(p.red), xyy(p.green), xyy(p.blue)};
  cmsToneCurve* const curve = make_curve(context, linear ? Transfer{} : space.transfer);
  const std::array<cmsToneCurve*, 3> curves = {curve, curve, curve};
  const Profile profile(cmsCreateRGBProfileTHR(context.get(), &white, &primaries, curves.data()),
                        cmsCloseProfile);
  cmsFreeToneCurve(curve);
  assert(profile);
  set_text(context, profile, cmsSigProfileDescriptionTag, space.name + (linear ? ", linear" : ""));
  set_text(context, profile, cmsSigCopyrightTag, "No copyright: facts about a colour space");

  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile.get(), nullptr, &size);
  std::string bytes(size, '\0');
  cmsSaveProfileToMem(profile.get(), bytes.data(), &size);
  // The date (ICC.1, 7.2.8), which LittleCMS takes from the clock: 2026-01-01.
  constexpr std::array<char, 12> date = {0x07, static_cast<char>(0xEA), 0, 1, 0, 1};
  bytes.replace(24, date.size(), date.data(), date.size());
  return bytes;
}

Result<IccReader> IccReader::open(const std::string& bytes, bool grey) {
  const Context context = make_context();
  const Profile profile(cmsOpenProfileFromMemTHR(context.get(), bytes.data(),
                                                 static_cast<cmsUInt32Number>(bytes.size())),
                        cmsCloseProfile);
  if (!profile) return problem("its ICC profile is damaged");
  if (cmsGetColorSpace(profile.get()) != (grey ? cmsSigGrayData : cmsSigRgbData))
    return problem(std::string("its ICC profile is not one of ") + (grey ? "grey" : "R G B"));
  const Profile xyz(cmsCreateXYZProfileTHR(context.get()), cmsCloseProfile);
  void* const transform = cmsCreateTransformTHR(
      context.get(), profile.get(), grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT, xyz.get(), TYPE_XYZ_FLT,
      INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE);
  if (!transform) return problem("its ICC profile does not say what its numbers look like");
  return IccReader({transform, [context](void* one) { cmsDeleteTransform(one); }},
                   description_of(profile), grey);
}

void IccReader::to_xyz(std::span<const float> values, std::span<float> xyz) const {
  const std::size_t pixels = xyz.size() / 3;
  assert(values.size() == pixels * (grey_ ? 1 : 3));
  static const Matrix3 adapted =
      *adaptation_matrix(Adaptation::bradford, d50, srgb::to_xyz({1, 1, 1}));
  cmsDoTransform(transform_.get(), values.data(), xyz.data(), static_cast<cmsUInt32Number>(pixels));
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const Xyz seen = multiply(adapted, Xyz{xyz[i], xyz[i + 1], xyz[i + 2]});
    for (std::size_t c = 0; c < 3; ++c) xyz[i + c] = static_cast<float>(seen[c]);
  }
}

}  // namespace metamer
