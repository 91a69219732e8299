// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The output of ods info.
#pragma once
#include <optional>

#include "ods/scene/info.h"
#include "ods/stage/place.h"

// The findings about a file's scene; kNothing: it was not examined.
struct SceneFindings {
  ods::Settled settled;
  std::optional<ods::Viewing> viewing;
  std::string advice;  // on its light
  std::string strain;  // the worst thing for a viewer's eyes; empty: none
};

void print_text(const ods::SceneInfo& info, const SceneFindings& found, ods::vec3 position);
void print_json(const ods::SceneInfo& info, const SceneFindings& found, ods::vec3 position);
