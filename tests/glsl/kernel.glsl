// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole kernel as GLSL, in the order in which its headers build on each other.
#define inline
const bool kHasCatchers = true;
#include "ods/kernel/camera/angles.h"
#include "ods/kernel/camera/merge.h"
#include "ods/kernel/camera/projection.h"
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/camera/texel_ray.h"
#include "ods/kernel/camera/line.h"
#include "ods/kernel/camera/project.h"
#include "ods/kernel/scene_data.h"
#include "ods/kernel/random.h"
#include "ods/kernel/scene_view.h"
#include "scene_view.glsl"
#include "ods/kernel/filter.h"
#include "ods/kernel/texture.h"
#include "ods/kernel/surface.h"
#include "ods/kernel/microfacets.h"
#include "ods/kernel/thin_film.h"
#include "ods/kernel/surface_layers.h"
#include "ods/kernel/albedo.h"
#include "ods/kernel/layer_lobes.h"
#include "ods/kernel/layered_bsdf.h"
#include "ods/kernel/bsdf.h"
#include "ods/kernel/light.h"
#include "ods/kernel/medium.h"
#include "ods/kernel/counterpart.h"
#include "ods/kernel/path_light.h"
#include "ods/kernel/light_cache.h"
#include "ods/kernel/path.h"
