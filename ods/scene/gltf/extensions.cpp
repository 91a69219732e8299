// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/extensions.h"

#include <algorithm>

namespace ods {

using enum ExtensionState;

// clang-format off
static constexpr Extension kExtensions[] = {
    {"ADOBE_materials_clearcoat_specular", kNotRendered, "reflectance of a clear coat"},
    {"ADOBE_materials_clearcoat_tint", kNotRendered, "colour of a clear coat"},
    {"ADOBE_materials_thin_transparency", kNotRendered, "transparent sheets"},
    {"AGI_articulations", kNoEffect, "movable parts stay at rest"},
    {"AGI_stk_metadata", kNoEffect, "metadata"},
    {"CESIUM_RTC", kNotRendered, "an offset of the whole scene"},
    {"CESIUM_primitive_outline", kNotRendered, "outlines of faces"},
    {"EXT_feature_metadata", kNoEffect, "metadata"},
    {"EXT_instance_features", kNoEffect, "metadata"},
    {"EXT_lights_area", kNotRendered, "area lights"},
    {"EXT_lights_ies", kNotRendered, "light distributions of real lamps"},
    {"EXT_lights_image_based", kRendered, "environment light from a cube map: its sharpest level"},
    {"EXT_mesh_features", kNoEffect, "metadata"},
    {"EXT_mesh_gpu_instancing", kRendered, "many instances of one mesh"},
    {"EXT_mesh_manifold", kNoEffect, "a second set of indices for solid modelling"},
    {"EXT_mesh_primitive_restart", kNotRendered, "several strips in one primitive"},
    {"EXT_meshopt_compression", kRendered, "compressed buffers"},
    {"EXT_structural_metadata", kNoEffect, "metadata"},
    {"EXT_texture_avif", kFallback, "AVIF pictures"},
    {"EXT_texture_procedurals_mx_1_39", kFallback, "textures computed by MaterialX"},
    {"EXT_texture_webp", kRendered, "WebP pictures"},
    {"FB_geometry_metadata", kNoEffect, "metadata"},
    {"FB_ngon_encoding", kNoEffect, "which triangles form a polygon"},
    {"GODOT_single_root", kNoEffect, "one root node"},
    {"GRIFFEL_bim_data", kNoEffect, "metadata"},
    {"KHR_accessor_float64", kNotRendered, "numbers in double precision"},
    {"KHR_animation_pointer", kRendered, "of nodes, lights, factors and texture transforms of materials; a warning names any other"},
    {"KHR_audio_emitter", kNoEffect, "sound"},
    {"KHR_draco_mesh_compression", kRendered, "compressed meshes"},
    {"KHR_gaussian_splatting", kNotRendered, "clouds of Gaussian splats"},
    {"KHR_implicit_shapes", kNoEffect, "shapes for physics"},
    {"KHR_interactivity", kNoEffect, "behaviour of an interactive scene"},
    {"KHR_lights_environment", kNotRendered, "environment light"},
    {"KHR_lights_image_based", kNotRendered, "environment light"},
    {"KHR_lights_punctual", kRendered, "point, spot and directional lights"},
    {"KHR_materials_anisotropy", kRendered, "stretched highlights"},
    {"KHR_materials_clearcoat", kRendered, "a layer of varnish"},
    {"KHR_materials_diffuse_transmission", kRendered, "light that shines through leaves and paper"},
    {"KHR_materials_dispersion", kRendered, "colours split by glass"},
    {"KHR_materials_emissive_strength", kRendered, "brightness of glowing surfaces"},
    {"KHR_materials_ior", kRendered, "index of refraction"},
    {"KHR_materials_iridescence", kRendered, "colours of thin films"},
    {"KHR_materials_pbrSpecularGlossiness", kRendered, "materials of older files, read as KHR_materials_specular"},
    {"KHR_materials_sheen", kRendered, "the soft edge of cloth"},
    {"KHR_materials_specular", kRendered, "strength and colour of reflections"},
    {"KHR_materials_subsurface", kNotRendered, "light scattered below a surface"},
    {"KHR_materials_transmission", kRendered, "glass"},
    {"KHR_materials_unlit", kRendered, "colours shown as they are"},
    {"KHR_materials_variants", kRendered, "alternative materials, one of which is chosen by its name"},
    {"KHR_materials_volume", kRendered, "refraction and absorption in closed meshes"},
    {"KHR_materials_volume_scatter", kNotRendered, "light scattered below a surface"},
    {"KHR_mesh_quantization", kRendered, "vertices stored as integers"},
    {"KHR_meshopt_compression", kRendered, "compressed buffers"},
    {"KHR_node_hoverability", kNoEffect, "behaviour of an interactive scene"},
    {"KHR_node_selectability", kNoEffect, "behaviour of an interactive scene"},
    {"KHR_node_visibility", kRendered, "hidden nodes, also animated"},
    {"KHR_physics_rigid_bodies", kNoEffect, "physics"},
    {"KHR_techniques_webgl", kFallback, "shaders"},
    {"KHR_texture_basisu", kRendered, "KTX2 pictures compressed with Basis Universal"},
    {"KHR_texture_transform", kRendered, "moved, scaled and rotated textures"},
    {"KHR_xmp", kNoEffect, "metadata"},
    {"KHR_xmp_json_ld", kNoEffect, "metadata"},
    {"MOZ_hubs_components", kNoEffect, "behaviour of an interactive scene"},
    {"MOZ_lightmap", kNotRendered, "baked light"},
    {"MSFT_lod", kNoEffect, "simpler meshes for the distance; the most detailed is rendered"},
    {"MSFT_packing_normalRoughnessMetallic", kNoEffect, "the same textures, packed otherwise"},
    {"MSFT_packing_occlusionRoughnessMetallic", kNoEffect, "the same textures, packed otherwise"},
    {"MSFT_texture_dds", kFallback, "DDS pictures"},
    {"NV_materials_mdl", kFallback, "materials in MDL"},
    {"ODS_albedo", kRendered, "base colours of Blender 3, beyond 1 where need be"},
    {"ODS_light_shape", kRendered, "lights that have a size, and cones as Cycles has them"},
    {"ODS_unseen", kRendered, "surfaces that the camera does not see, such as area lights"},
    {"OMI_collider", kNoEffect, "physics"},
    {"OMI_physics_body", kNoEffect, "physics"},
    {"OMI_physics_shape", kNoEffect, "physics"},
    {"VRM", kNoEffect, "behaviour of an avatar"},
    {"VRMC_materials_mtoon", kFallback, "cartoon shading"},
    {"VRMC_node_constraint", kNoEffect, "behaviour of an avatar"},
    {"VRMC_springBone", kNoEffect, "behaviour of an avatar"},
    {"VRMC_vrm", kNoEffect, "behaviour of an avatar"},
};
// clang-format on
static_assert(std::ranges::is_sorted(kExtensions, {}, &Extension::name));

std::span<const Extension> gltf_extensions() {
  return kExtensions;
}

Extension find_extension(std::string_view name) {
  const auto* found = std::find_if(std::begin(kExtensions), std::end(kExtensions),
                                   [&](const Extension& each) { return each.name == name; });
  if (found != std::end(kExtensions)) return *found;
  return {name, kNotRendered, "unknown to ods"};
}

bool is_supported(ExtensionState state) {
  return state == kRendered || state == kApproximated || state == kNoEffect;
}

bool is_read(std::string_view name) {
  const ExtensionState state = find_extension(name).state;
  return state == kRendered || state == kApproximated;
}

}  // namespace ods
