// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods comfort judges, eye by eye, and the picture of its verdicts.
#pragma once
#include <string>
#include <vector>

#include "cli/comfort/comfort_job.h"

struct Judged {
  ods::SeenDepth seen;
  ods::Image grey;  // what the heat is painted over: 1 channel, 0..1; may be empty if no heat is wanted
};

// camera: becomes that of the scene or picture. Throws UsageError and ods::Error.
std::vector<Judged> look_at_scene(const ComfortJob& job, ods::StereoCamera& camera);
std::vector<Judged> look_at_picture(const ComfortJob& job, ods::StereoCamera& camera);

// What is ok in grey; the rest in yellow, orange and red. reports: of each of `judged`.
void save_heat(const std::string& path, const ods::StereoCamera& camera, const std::vector<Judged>& judged,
               const std::vector<ods::ComfortReport>& reports);
