// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/sizes.h"

namespace ods {

static constexpr std::string_view kPage = "clodo.it/blog/omnidirectional-stereo-ods-with-pov-ray";
static constexpr std::string_view kMeta = "developers.meta.com/horizon/documentation/web/browser-video";
static constexpr std::string_view kMetaStore = "developers.meta.com publish-pdp-360previews";
static constexpr std::string_view kYouTube = "echeng.com/journal/encoding-360-video-in-6k-for-uploading";
static constexpr std::string_view kVisionPro = "blog.mikeswanson.com/spatial-video";
static constexpr std::string_view kDeoVr = "deovr.com/pages/doc";
static constexpr std::string_view kWebGl = "measured: 8192 in SwiftShader, 8192 to 16384 in headsets";

// A row of the page's quickres.ini.
static constexpr NamedSize quickres(std::string_view name, std::string_view title, Extent eye, Layout layout,
                                    std::string_view antialias = "on, threshold 0.3") {
  return {name, title, eye, layout, 0, antialias, kPage};
}

static constexpr auto kTb = Layout::kTopBottom;
static constexpr auto kLr = Layout::kSideBySide;
static constexpr std::nullopt_t kOneEye = std::nullopt;

// 5760x5760 has exactly as many pixels as 7680x4320 (8K).
static constexpr NamedSize kSizes[] = {
    quickres("tb-quick-test-512", "ODS TB Quick Test - 512 x 512", {512, 256}, kTb, "off"),
    quickres("tb-test-1024", "ODS TB Test - 1024 x 1024", {1024, 512}, kTb, "off"),
    quickres("tb-minimum-3600", "ODS TB Minimum - 3600 x 3600", {3600, 1800}, kTb),
    quickres("tb-high-6480", "ODS TB High - 6480 x 6480", {6480, 3240}, kTb),
    quickres("tb-ultra-12288", "ODS TB Ultra - 12288 x 12288", {12288, 6144}, kTb),
    quickres("lr-minimum-7200", "ODS LR Minimum - 7200 x 1800", {3600, 1800}, kLr),
    quickres("lr-high-12960", "ODS LR High - 12960 x 3240", {6480, 3240}, kLr),
    {"quest-3", "Quest 3: the browser plays 8K in H.265 and AV1", {5760, 2880}, kTb, 30, "", kMeta},
    {"quest-3-mono", "Quest 3: the same, one eye", {7680, 3840}, kOneEye, 30, "", kMeta},
    {"quest-3-vr180", "Quest 3: the same, as vr180", {3840, 3840}, kLr, 30, "", kMeta},
    {"quest-4k", "Quest 2 and later: the browser plays 4K in every codec", {4096, 2048}, kOneEye, 30, "", kMeta},
    {"quest-store-preview", "Quest store: mono preview, 7680 x 3840 or more", {7680, 3840}, kOneEye, 0, "", kMetaStore},
    {"vision-pro-vr180", "Apple's immersive videos, as vr180", {4320, 4320}, kLr, 0, "", kVisionPro},
    {"youtube-8k", "YouTube takes up to 8K", {5760, 2880}, kTb, 0, "", kYouTube},
    {"youtube-8k-mono", "YouTube takes up to 8K, one eye", {7680, 3840}, kOneEye, 0, "", kYouTube},
    {"deovr-4096", "DeoVR, H.264 up to 4096 x 4096 at 30", {4096, 2048}, kTb, 30, "", kDeoVr},
    {"deovr-mono-4096", "DeoVR, H.264 up to 4096 x 2048 at 60", {4096, 2048}, kOneEye, 60, "", kDeoVr},
    {"level-limit-5760",
     "the largest round square that H.264, HEVC, AV1 and VP9 hold",
     {5760, 2880},
     kTb,
     30,
     "",
     "video_level.h"},
    {"webxr-8192", "WebGL's MAX_TEXTURE_SIZE where it is smallest", {8192, 4096}, kTb, 0, "", kWebGl},
};

std::span<const NamedSize> named_sizes() {
  return kSizes;
}

Extent file_size(const NamedSize& size) {
  return size.layout ? packed_size(*size.layout, size.eye, 2) : size.eye;
}

}  // namespace ods
