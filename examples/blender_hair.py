# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Features that ods render does not have, around a camera at (0, 0, 1.6): hair, a particle system and a volume.
Writes hair.blend.

    blender -b --factory-startup --python-exit-code 1 -P blender_hair.py

docs/slits.md makes a stereo 360 picture of it.
"""

import math
import os

import bpy

EYES = (0.0, 0.0, 1.6)


def material(name, colour, roughness=0.6):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    return made


def ball(name, place, radius, *materials):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=radius, location=place)
    made = bpy.context.object
    made.name = name
    bpy.ops.object.shade_smooth()
    for each in materials:
        made.data.materials.append(each)
    return made


def around(degrees, distance, height):
    """A position; 0 degrees is ahead (+Y), 90 to the right (+X)."""
    turn = math.radians(degrees)
    return (distance * math.sin(turn), distance * math.cos(turn), height)


def add_particles(owner, name, **settings):
    owner.modifiers.new(name, "PARTICLE_SYSTEM")
    made = owner.particle_systems[-1].settings
    for key, value in settings.items():
        setattr(made, key, value)
    return made


def add_hair(name, place, skin, strands):
    """A ball in fur: 1200 strands of hair, each with 12 beside it."""
    owner = ball(name, place, 0.16, skin, strands)
    add_particles(owner, "hair", type="HAIR", count=1200, hair_length=0.12, hair_step=5, use_advanced_hair=True,
                  brownian_factor=0.04, child_type="SIMPLE", rendered_child_count=12, child_radius=0.03,
                  roughness_2=0.02, material=2, root_radius=0.4, tip_radius=0.05, radius_scale=0.01)


def add_fountain(place, colour):
    """A disc that throws small balls up; they are simulated, and stored in the file."""
    grain = ball("grain", (0.0, 0.0, -5.0), 1.0, colour)
    bpy.ops.mesh.primitive_circle_add(vertices=24, radius=0.08, fill_type="NGON", location=place)
    system = add_particles(bpy.context.object, "fountain", count=400, frame_start=1, frame_end=40, lifetime=60,
                           normal_factor=3.2, factor_random=0.7, render_type="OBJECT", particle_size=0.014,
                           size_random=0.5)
    system.instance_object = grain
    bpy.context.object.show_instancer_for_render = True


def add_smoke(place, size):
    """A transparent box: clouds in its middle, empty at its sides."""
    bpy.ops.mesh.primitive_cube_add(size=size, location=place)
    smoke = bpy.data.materials.new("smoke")
    smoke.use_nodes = True
    nodes, links = smoke.node_tree.nodes, smoke.node_tree.links
    nodes.remove(nodes["Principled BSDF"])
    volume = nodes.new("ShaderNodeVolumePrincipled")
    volume.inputs["Color"].default_value = (0.75, 0.85, 1.0, 1.0)
    where = nodes.new("ShaderNodeTexCoord")
    noise = nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = 4.0
    noise.inputs["Detail"].default_value = 3.0
    middle = nodes.new("ShaderNodeTexGradient")  # 1 there, 0.4 at the sides
    middle.gradient_type = "SPHERICAL"
    both = nodes.new("ShaderNodeMath")
    density = nodes.new("ShaderNodeMapRange")
    for name, value in (("From Min", 1.1), ("From Max", 1.5), ("To Min", 0.0), ("To Max", 14.0)):
        density.inputs[name].default_value = value
    for texture in (noise, middle):
        links.new(where.outputs["Object"], texture.inputs["Vector"])
    links.new(noise.outputs["Fac"], both.inputs[0])
    links.new(middle.outputs["Fac"], both.inputs[1])
    links.new(both.outputs["Value"], density.inputs["Value"])
    links.new(density.outputs["Result"], volume.inputs["Density"])
    links.new(volume.outputs["Volume"], nodes["Material Output"].inputs["Volume"])
    bpy.context.object.data.materials.append(smoke)


def add_floor(grey):
    bpy.ops.mesh.primitive_plane_add(size=30.0)
    nodes, links = grey.node_tree.nodes, grey.node_tree.links
    checker = nodes.new("ShaderNodeTexChecker")
    checker.inputs["Scale"].default_value = 60.0
    checker.inputs["Color1"].default_value = (0.35, 0.33, 0.3, 1.0)
    checker.inputs["Color2"].default_value = (0.16, 0.17, 0.2, 1.0)
    links.new(checker.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    bpy.context.object.data.materials.append(grey)


def light_up(scene):
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    sky = scene.world.node_tree.nodes["Background"]
    sky.inputs["Color"].default_value = (0.35, 0.5, 0.8, 1.0)
    sky.inputs["Strength"].default_value = 0.6
    bpy.ops.object.light_add(type="SUN", rotation=(math.radians(50), 0.0, math.radians(30)))
    bpy.context.object.data.energy = 3.0
    bpy.context.object.data.angle = math.radians(3)


def main():
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    scene = bpy.context.scene
    light_up(scene)
    add_floor(material("floor", (0.3, 0.3, 0.3)))
    skin, fur = material("skin", (0.25, 0.12, 0.05)), material("fur", (0.6, 0.3, 0.1), 0.4)
    add_hair("ahead", around(-25, 0.95, 1.65), skin, fur)
    add_hair("above", (0.15, 0.3, 2.6), skin, material("white fur", (0.8, 0.75, 0.7), 0.4))
    add_fountain(around(20, 1.1, 1.15), material("red", (0.8, 0.08, 0.05), 0.3))
    add_smoke(around(110, 1.6, 1.6), 1.2)
    ball("in the smoke", around(110, 1.7, 1.5), 0.2, material("yellow", (0.8, 0.6, 0.05)))
    ball("behind", around(180, 1.2, 1.4), 0.25, material("blue", (0.05, 0.15, 0.6), 0.2))
    ball("below", around(-120, 0.6, 0.5), 0.2, material("green", (0.1, 0.5, 0.15)))
    scene.frame_end = 40
    bpy.ops.ptcache.bake_all(bake=True)
    scene.frame_set(40)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 32
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 4
    scene.cycles.volume_step_rate = 2.0
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath("hair.blend"))


main()
