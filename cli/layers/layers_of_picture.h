// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "cli/layers/layers_job.h"

// Writes the layered scene of a picture with depth. Precondition: is_picture.
void layers_of_picture(const LayersJob& job);
