# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Simulations without a bake: a frame is right only if Blender has evaluated all frames before it."""


def _is_unbaked(cache):
    return not (cache.is_baked or cache.use_external)


def _computes(modifier):
    """Whether a modifier computes a frame from the one before it."""
    if modifier.type in ("CLOTH", "SOFT_BODY"):
        return _is_unbaked(modifier.point_cache)
    if modifier.type == "PARTICLE_SYSTEM":
        system = modifier.particle_system
        return (system.settings.type != "HAIR" or system.use_hair_dynamics) and _is_unbaked(system.point_cache)
    if modifier.type == "FLUID":
        domain = modifier.domain_settings if modifier.fluid_type == "DOMAIN" else None
        return domain is not None and domain.cache_type == "REPLAY"
    if modifier.type == "DYNAMIC_PAINT":
        canvas = modifier.canvas_settings
        return canvas is not None and any(_is_unbaked(each.point_cache) for each in canvas.canvas_surfaces)
    if modifier.type == "NODES" and modifier.node_group:
        return any(node.bl_idname == "GeometryNodeSimulationInput" for node in modifier.node_group.nodes)
    return False


def simulates(scene):
    world = scene.rigidbody_world
    if world and world.enabled and _is_unbaked(world.point_cache):
        return True
    return any(_computes(modifier) for each in scene.objects for modifier in each.modifiers)
