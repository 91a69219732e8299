// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods video: renders a scene as a video, or some of its frames.
#include "cli/console/command.h"
#include "cli/video/make_film.h"

extern const Command kVideo = make_command<parse_video, make_film>("video", "render a scene as a stereo 360 video");
