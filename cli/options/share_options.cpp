// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/share_options.h"

#include "cli/console/console.h"
#include "cli/options/time_options.h"
#include "ods/files/frames.h"

void add_share_options(Options& options, FrameShare& share) {
  options.text(
      "--only", "LIST|I/N", share.only,
      "if frames become frames: make only these, or the I-th of N shares of them, as one of several processes");
  options.flag("--skip-existing", share.skip_existing, "do not make frames whose files exist");
}

void check_share(const FrameShare& share, const std::string& input, const std::string& output) {
  check_only(share.only);
  if (share.only.empty() && !share.skip_existing) return;
  if (ods::frame_names(input) && ods::frame_names(output)) return;
  throw UsageError("--only and --skip-existing are for frames that become frames: IN.####.exr -o OUT.####.exr");
}
