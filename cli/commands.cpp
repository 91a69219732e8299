// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/command.h"

// Each is defined in its own file under cli/.
extern const Command kBlender, kCamera, kComfort, kCompare, kConvert, kDenoise, kDevices, kEncode, kInfo, kInject,
    kJobs, kLayers, kLint, kMerge, kOver, kProbe, kProject, kRender, kRig, kScenes, kSizes, kStitch, kSubmit, kTestcard,
    kTitle, kVideo, kView;

std::span<const Command> commands() {
  static const Command all[] = {kRender, kLayers,  kConvert,  kDenoise, kMerge,   kView,    kVideo,
                                kEncode, kSubmit,  kJobs,     kTitle,   kOver,    kRig,     kStitch,
                                kInfo,   kBlender, kCamera,   kProject, kCompare, kComfort, kLint,
                                kProbe,  kInject,  kTestcard, kScenes,  kSizes,   kDevices};
  return all;
}
