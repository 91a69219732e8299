// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/sizes.h"

namespace ods {

static constexpr std::string_view kPage = "clodo.it/blog/omnidirectional-stereo-ods-with-pov-ray";
static constexpr std::string_view kOculus = "creator.oculus.com (2019)";
static constexpr std::string_view kDeoVr = "deovr.com/pages/doc";

// A row of the page's quickres.ini.
static constexpr NamedSize quickres(std::string_view name, std::string_view title, Extent eye, Layout layout,
                                    std::string_view antialias = "on, threshold 0.3") {
  return {name, title, eye, layout, 0, antialias, kPage};
}

static constexpr auto kTb = Layout::kTopBottom;
static constexpr auto kLr = Layout::kSideBySide;

static constexpr NamedSize kSizes[] = {
    quickres("tb-quick-test-512", "ODS TB Quick Test - 512 x 512", {512, 256}, kTb, "off"),
    quickres("tb-test-1024", "ODS TB Test - 1024 x 1024", {1024, 512}, kTb, "off"),
    quickres("tb-minimum-3600", "ODS TB Minimum - 3600 x 3600", {3600, 1800}, kTb),
    quickres("tb-high-6480", "ODS TB High - 6480 x 6480", {6480, 3240}, kTb),
    quickres("tb-ultra-12288", "ODS TB Ultra - 12288 x 12288", {12288, 6144}, kTb),
    quickres("tb-1440p-2560", "ODS TB 1440p - 2560 x 1440", {2560, 720}, kTb),
    quickres("tb-uhd-1-2160p-3840", "ODS TB UHD-1 2160p - 3840 x 2160", {3840, 1080}, kTb),
    quickres("tb-dci-4k-4096", "ODS TB DCI 4K - 4096 x 2160", {4096, 1080}, kTb),
    quickres("tb-8k-uhd-7680", "ODS TB 8K UHD - 7680 x 4320", {7680, 2160}, kTb),
    quickres("lr-minimum-7200", "ODS LR Minimum - 7200 x 1800", {3600, 1800}, kLr),
    quickres("lr-high-12960", "ODS LR High - 12960 x 3240", {6480, 3240}, kLr),
    quickres("lr-ultra-24576", "ODS LR Ultra - 24576 x 6144", {12288, 6144}, kLr),
    quickres("lr-low-7200", "ODS LR Low - 7200 x 1800", {3600, 1800}, kLr),
    quickres("lr-normal-12960", "ODS LR Normal - 12960 x 3240", {6480, 3240}, kLr),
    quickres("lr-high-24576", "ODS LR High - 24576 x 6144", {12288, 6144}, kLr),
    quickres("tb-low-3600", "ODS TB Low - 3600 x 3600", {3600, 1800}, kTb),
    quickres("tb-normal-6480", "ODS TB Normal - 6480 x 6480", {6480, 3240}, kTb),
    quickres("tb-high-12288", "ODS TB High - 12288 x 12288", {12288, 6144}, kTb),
    quickres("tb-youtube-3840", "ODS TB YouTube - 3840 x 2160", {3840, 1080}, kTb),
    {"gear-vr", "Gear VR: 0.06 degrees a pixel, 6000 around", {6000, 3000}, kTb, 0, "", kPage},
    {"rift-dk2", "Oculus Rift DK2, at least 6480 x 6480", {6480, 3240}, kTb, 75, "", kPage},
    {"rift-cv1", "Oculus Rift CV1, at least 6480 x 6480", {6480, 3240}, kTb, 90, "", kPage},
    {"vive", "HTC Vive, at least 6480 x 6480", {6480, 3240}, kTb, 90, "", kPage},
    {"psvr", "PlayStation VR, at least 6480 x 6480", {6480, 3240}, kTb, 120, "", kPage},
    {"quest-1-3840", "Quest 1, limit 3840 x 3840 at 30", {3840, 1920}, kTb, 30, "", kOculus},
    {"quest-1-4096", "Quest 1, limit 4096 x 4096 at 30 with HEVC", {4096, 2048}, kTb, 30, "", kOculus},
    {"quest-1-2880", "Quest 1, limit 2880 x 2880 at 60", {2880, 1440}, kTb, 60, "", kOculus},
    {"quest-1-mono-5760", "Quest 1, limit 5760 x 2880 at 30", {5760, 2880}, {}, 30, "", kOculus},
    {"quest-store-preview",
     "Quest store 360 preview, mono, at least 7680 x 3840",
     {7680, 3840},
     {},
     0,
     "",
     "developers.meta.com publish-pdp-360previews"},
    {"deovr-4096", "DeoVR, H.264 up to 4096 x 4096 at 30", {4096, 2048}, kTb, 30, "", kDeoVr},
    {"deovr-mono-4096", "DeoVR, H.264 up to 4096 x 2048 at 60", {4096, 2048}, {}, 60, "", kDeoVr},
    {"level-limit-5760",
     "the largest round square within a level of every codec",
     {5760, 2880},
     kTb,
     30,
     "",
     "video_level.h"},
    {"webxr-8192",
     "WebGL's MAX_TEXTURE_SIZE where it is smallest",
     {8192, 4096},
     kTb,
     0,
     "",
     "measured: 8192 in SwiftShader, 8192 to 16384 in headsets"},
};

std::span<const NamedSize> named_sizes() {
  return kSizes;
}

Extent file_size(const NamedSize& size) {
  return size.layout ? packed_size(*size.layout, size.eye, 2) : size.eye;
}

}  // namespace ods
