// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/icc_profile.h"

#include <fmt/format.h>
#include <lcms2.h>

#include <memory>

#include "ods/base/text.h"

namespace ods {
namespace {

struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};

std::string description_of(cmsHPROFILE profile) {
  char text[256] = "";
  cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text, sizeof text);
  const std::string line = one_line(text);
  return line.empty() ? "ICC profile" : fmt::format("ICC profile '{}'", line);
}

// Little CMS owns what it returns until the profile is closed.
const cmsToneCurve* curve_of(cmsHPROFILE profile, cmsTagSignature tag) {
  return static_cast<const cmsToneCurve*>(cmsReadTag(profile, tag));
}

glm::dvec3 colorant_of(cmsHPROFILE profile, cmsTagSignature tag) {
  const auto* xyz = static_cast<const cmsCIEXYZ*>(cmsReadTag(profile, tag));
  return xyz == nullptr ? glm::dvec3(0.0) : glm::dvec3(xyz->X, xyz->Y, xyz->Z);
}

ColorCurve evaluated(const cmsToneCurve* curve) {
  return [curve](double code) {
    return static_cast<double>(cmsEvalToneCurveFloat(curve, static_cast<cmsFloat32Number>(code)));
  };
}

ColorSpace faulty(const std::string& name, const std::string& why) {
  ColorSpace color;
  color.name = name;
  color.fault = fmt::format("its {} {}", name, why);
  return color;
}

}  // namespace

ColorSpace read_icc_profile(const std::string& bytes) {
  const std::unique_ptr<void, CloseProfile> owner(
      cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
  cmsHPROFILE profile = owner.get();
  if (profile == nullptr) return faulty("ICC profile", "is damaged");
  const std::string name = description_of(profile);
  const cmsColorSpaceSignature space = cmsGetColorSpace(profile);
  if (space != cmsSigRgbData && space != cmsSigGrayData) return faulty(name, "is neither RGB nor grey");
  glm::dmat3 to_rec709(1.0);
  std::array<const cmsToneCurve*, 3> curves{};
  if (space == cmsSigGrayData) {
    curves.fill(curve_of(profile, cmsSigGrayTRCTag));
  } else {
    if (!cmsIsMatrixShaper(profile)) return faulty(name, "is a look-up table, not three curves and a matrix");
    curves = {curve_of(profile, cmsSigRedTRCTag), curve_of(profile, cmsSigGreenTRCTag),
              curve_of(profile, cmsSigBlueTRCTag)};
    to_rec709 = rec709_of_d50_xyz() * glm::dmat3(colorant_of(profile, cmsSigRedColorantTag),
                                                 colorant_of(profile, cmsSigGreenColorantTag),
                                                 colorant_of(profile, cmsSigBlueColorantTag));
  }
  for (const cmsToneCurve* curve : curves) {
    if (curve == nullptr) return faulty(name, "is damaged");
  }
  return make_color_space(name, {evaluated(curves[0]), evaluated(curves[1]), evaluated(curves[2])}, to_rec709);
}

}  // namespace ods
