// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods view.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/console/options.h"
#include "cli/convert/depth_input.h"
#include "cli/options/scene_source.h"
#include "cli/view/export_site.h"
#include "ods/view/view_item.h"

struct ViewJob {
  std::vector<std::string> paths;
  std::string scene;              // for the studio; empty: none
  ObjectOptions objects;          // put into the layered scene, or the picture
  DepthInput depth;               // of the picture
  std::optional<ods::Tour> tour;  // of which the paths are the panoramas
  ods::FormatHint known;
  std::string folder;  // to export to; empty: serve
  PageTexts texts;     // of the export
  bool lan = false;
  bool keep_secret = false;  // with lan: the address is the same the next time
  bool browser = true;
  std::optional<int> port;
};

ViewJob parse_view(Options& options);

// Moves the scene from the paths to job.scene. Throws UsageError if there are two.
void find_scene(ViewJob& job);

// Reads the tour, if the path is one, and replaces the path by those of its panoramas. Throws UsageError if there are
// other paths, and as read_tour().
void find_tour(ViewJob& job);

// The files, and those in folders that can be shown, in the order of their names. Throws Error(kInput) for a file that
// cannot be shown; of a folder such files are left out, with a note, but one must be left.
std::vector<ods::ViewItem> open_items(const ViewJob& job);
