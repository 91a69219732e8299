# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Small scenes, each exported by the bridge into a folder of its own, all in one Blender.

    blender --background --factory-startup --python blender_scenes.py -- SOURCES FOLDER
"""
import math
import os
import sys
import traceback

import bpy

SOURCES, OUT = sys.argv[sys.argv.index("--") + 1 :]
sys.path.insert(0, os.path.join(SOURCES, "blender", "omnistereo"))
sys.dont_write_bytecode = True
from bridge import beginning, export, opening  # noqa: E402

BLACK, WHITE = (0, 0, 0), (1, 1, 1)


def new():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    camera = link("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0, 0, 1.6), (math.pi / 2, 0, 0)
    camera.data.type = "PANO"
    pano(camera.data).panorama_type = "EQUIRECTANGULAR"
    scene.camera = camera
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.frame_start = scene.frame_end = 1
    return scene, camera


def pano(data):
    return data if hasattr(data, "panorama_type") else data.cycles


def link(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def background():
    return bpy.context.scene.world.node_tree.nodes["Background"]


def material(name="it"):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    return made, made.node_tree, made.node_tree.nodes["Principled BSDF"]


def plane(made, name="thing"):
    bpy.ops.mesh.primitive_plane_add(size=2, location=(0, 3, 1), rotation=(math.pi / 2, 0, 0))
    thing = bpy.context.object
    thing.name = name
    thing.data.materials.append(made)
    return thing


def halves(left=WHITE, right=BLACK, data=True, size=16):
    """A picture of two colours."""
    image = bpy.data.images.new("halves", size, size, float_buffer=max(left) > 1, is_data=data)
    image.pixels = [c for _ in range(size) for x in range(size) for c in (*(left if x < size // 2 else right), 1)]
    image.pack()
    return image


def texture(tree, image, **settings):
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    for key, value in settings.items():
        setattr(node, key, value)
    return node


def lamp(kind, name="lamp", **settings):
    data = bpy.data.lights.new(name, kind)
    for key, value in settings.items():
        setattr(data, key, value)
    thing = link(name, data)
    thing.location = (0, 0, 3)
    return thing


def shader(tree, kind):
    return tree.nodes.new("ShaderNode" + kind)


def key(owner, path, *keys):
    """keys: (frame, value)."""
    for frame, value in keys:
        setattr(owner, path, value)
        owner.keyframe_insert(path, frame=frame)


# --- materials


def nested_mixes():
    """Gloss over what a mask cuts out, and a constant share of that made clear."""
    new()
    made, tree, body = material()
    inner, outer, last = (shader(tree, "MixShader") for _ in range(3))
    clear = shader(tree, "BsdfTransparent")
    tree.links.new(texture(tree, halves()).outputs[0], inner.inputs[0])
    tree.links.new(body.outputs[0], inner.inputs[1])
    tree.links.new(clear.outputs[0], inner.inputs[2])
    outer.inputs[0].default_value, last.inputs[0].default_value = 0.25, 0.5
    tree.links.new(inner.outputs[0], outer.inputs[1])
    tree.links.new(shader(tree, "BsdfGlossy").outputs[0], outer.inputs[2])
    tree.links.new(outer.outputs[0], last.inputs[1])
    tree.links.new(clear.outputs[0], last.inputs[2])
    tree.links.new(last.outputs[0], tree.nodes["Material Output"].inputs[0])
    plane(made)


def colors(used):
    """Vertex colours, of which the base colour is the half, or that nothing reads."""
    new()
    made, tree, body = material()
    thing = plane(made)
    for each in thing.data.color_attributes.new("Paint", "FLOAT_COLOR", "CORNER").data:
        each.color = (0.5, 0.1, 0.2, 1)
    if used:
        node, product = shader(tree, "VertexColor"), shader(tree, "MixRGB")
        node.layer_name, product.blend_type, product.inputs[0].default_value = "Paint", "MULTIPLY", 1
        product.inputs[2].default_value = (0.5, 0.5, 0.5, 1)
        tree.links.new(node.outputs[0], product.inputs[1])
        tree.links.new(product.outputs[0], body.inputs["Base Color"])


def used_colors():
    colors(True)


def unused_colors():
    colors(False)


def mask():
    """Two colours by a picture."""
    new()
    made, tree, body = material()
    mix = shader(tree, "MixRGB")
    mix.inputs[1].default_value, mix.inputs[2].default_value = (0.8, 0.05, 0.05, 1), (0.05, 0.05, 0.8, 1)
    tree.links.new(texture(tree, halves()).outputs[0], mix.inputs[0])
    tree.links.new(mix.outputs[0], body.inputs["Base Color"])
    plane(made)


def decal():
    """A picture with Extension: Clip in the middle third."""
    new()
    made, tree, body = material()
    node = texture(tree, halves(WHITE, WHITE), extension="CLIP")
    place = shader(tree, "Mapping")
    place.inputs["Scale"].default_value, place.inputs["Location"].default_value = (3, 3, 1), (-1, -1, 0)
    tree.links.new(shader(tree, "TexCoord").outputs["UV"], place.inputs[0])
    tree.links.new(place.outputs[0], node.inputs[0])
    tree.links.new(node.outputs[0], body.inputs["Base Color"])
    plane(made)


def tiles():
    """A product of two pictures that repeat 40 times over a plane."""
    new()
    made, tree, body = material()
    product, place = shader(tree, "MixRGB"), shader(tree, "Mapping")
    product.blend_type, product.inputs[0].default_value = "MULTIPLY", 1
    place.inputs["Scale"].default_value = (40, 40, 1)
    tree.links.new(shader(tree, "TexCoord").outputs["UV"], place.inputs[0])
    for index in (1, 2):
        node = texture(tree, halves(WHITE, (0.5, 0.5, 0.5)))
        tree.links.new(place.outputs[0], node.inputs[0])
        tree.links.new(node.outputs[0], product.inputs[index])
    tree.links.new(product.outputs[0], body.inputs["Base Color"])
    thing = plane(made)
    for corner in thing.data.uv_layers[0].data:
        corner.uv = [5 * c for c in corner.uv]


def boxes():
    """Five materials of box projection, and one whose picture lies along the object."""
    new()
    for number in range(5):
        made, tree, body = material(f"box {number}")
        tree.links.new(texture(tree, halves(), projection="BOX").outputs[0], body.inputs["Base Color"])
        plane(made, f"thing {number}")
    made, tree, body = material("along")
    node = texture(tree, halves())
    tree.links.new(shader(tree, "TexCoord").outputs["Object"], node.inputs[0])
    tree.links.new(node.outputs[0], body.inputs["Base Color"])
    plane(made)


def constant():
    """A product of two constants."""
    new()
    made, tree, body = material()
    product = shader(tree, "MixRGB")
    product.blend_type = "MULTIPLY"
    for socket, value in zip(product.inputs, (1.0, (0.5, 0.4, 0.2, 1), (0.8, 0.5, 0.5, 1))):
        socket.default_value = value
    tree.links.new(product.outputs[0], body.inputs["Base Color"])
    plane(made)


def without_pictures():
    """Colour, gloss and normals of a picture that is missing."""
    new()
    made, tree, body = material()
    image = bpy.data.images.new("lost", 4, 4)
    image.source, image.filepath = "FILE", "/nowhere/lost.png"
    image.reload()
    picture, normal = texture(tree, image), shader(tree, "NormalMap")
    for name in ("Base Color", "Specular" if "Specular" in body.inputs else "Specular IOR Level"):
        tree.links.new(picture.outputs[0], body.inputs[name])
    tree.links.new(picture.outputs[0], normal.inputs["Color"])
    tree.links.new(normal.outputs[0], body.inputs["Normal"])
    plane(made)


def computed_gloss():
    """Specular of black and black squares: none."""
    new()
    made, tree, body = material()
    checker, at = shader(tree, "TexChecker"), shader(tree, "TexCoord")
    checker.inputs["Color1"].default_value = checker.inputs["Color2"].default_value = (*BLACK, 1)
    tree.links.new(at.outputs["Object"], checker.inputs[0])
    tree.links.new(checker.outputs[0], body.inputs["Specular" if "Specular" in body.inputs else "Specular IOR Level"])
    plane(made)


def glow():
    """Emission whose picture goes to 4, times a strength that nodes compute."""
    new()
    made, tree, _ = material()
    emission, double = shader(tree, "Emission"), shader(tree, "Math")
    double.operation, double.inputs[0].default_value, double.inputs[1].default_value = "MULTIPLY", 2, 1
    tree.links.new(texture(tree, halves((4, 2, 1), (1, 1, 1))).outputs[0], emission.inputs[0])
    tree.links.new(double.outputs[0], emission.inputs[1])
    tree.links.new(emission.outputs[0], tree.nodes["Material Output"].inputs[0])
    plane(made)


def glow_along():
    """Emission of 4 that is computed along the object."""
    new()
    made, tree, _ = material()
    emission = shader(tree, "Emission")
    node = texture(tree, halves((4, 2, 1), (4, 2, 1)))
    tree.links.new(shader(tree, "TexCoord").outputs["Object"], node.inputs[0])
    tree.links.new(node.outputs[0], emission.inputs[0])
    tree.links.new(emission.outputs[0], tree.nodes["Material Output"].inputs[0])
    plane(made)


def library():
    """An object of another file."""
    new()
    made, tree, body = material("linked")
    body.inputs["Base Color"].default_value = (0.1, 0.6, 0.1, 1)
    body.inputs["Metallic"].default_value = 0.25
    tree.links.new(shader(tree, "BsdfGlossy").outputs[0], tree.nodes["Material Output"].inputs[0])
    path = os.path.join(OUT, "library.blend")
    bpy.data.libraries.write(path, {plane(made)}, fake_user=True)
    new()
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = ["thing"]
    bpy.context.scene.collection.objects.link(bpy.data.objects["thing"])


def override():
    """All is clay."""
    new()
    clay, tree, body = material("clay")
    body.inputs["Base Color"].default_value = (0.1, 0.2, 0.3, 1)
    plane(material("other")[0])
    bpy.context.view_layer.material_override = clay


def fog():
    """A box of fog."""
    new()
    made, tree, body = material()
    tree.nodes.remove(body)
    tree.links.new(shader(tree, "VolumeScatter").outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    plane(made)


def settings():
    """Settings that have no counterpart, on datablocks of all kinds."""
    scene, camera = new()
    scene.view_settings.exposure, scene.render.use_motion_blur = 1, True
    made, tree, body = material("skin")
    weight = body.inputs.get("Subsurface") or body.inputs["Subsurface Weight"]
    weight.default_value = 0.5
    body.inputs["Sheen Tint"].default_value = body.inputs["Sheen Tint"].default_value  # idle, as there is no sheen
    thing = plane(made)
    thing.visible_shadow = False
    lamp("AREA", "narrow", spread=0.5)
    camera.data.shift_x = 0.25


# --- light


def portal():
    """An area light that only guides light."""
    new()
    lamp("AREA", energy=100).data.cycles.is_portal = True
    plane(material()[0])


def hidden_world():
    """A world that lights and is not seen."""
    scene, _ = new()
    background().inputs[0].default_value = (1, 0.5, 0.25, 1)
    (scene.world.cycles_visibility if hasattr(scene.world, "cycles_visibility") else scene.world).camera = False
    plane(material()[0])


def two_worlds():
    """One world for light, another for the camera."""
    scene, _ = new()
    tree = scene.world.node_tree
    background().inputs[0].default_value = (2, 1, 0.25, 1)
    other, path, mix = (shader(tree, kind) for kind in ("Background", "LightPath", "MixShader"))
    other.inputs[0].default_value = (0, 0, 0.5, 1)
    tree.links.new(path.outputs["Is Camera Ray"], mix.inputs[0])
    tree.links.new(background().outputs[0], mix.inputs[1])
    tree.links.new(other.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["World Output"].inputs["Surface"])
    plane(material()[0])


# --- camera


def focus():
    """Depth of field, in centimetres, with both eyes."""
    scene, camera = new()
    plane(material()[0])
    scene.unit_settings.scale_length = 0.01
    camera.data.dof.use_dof, camera.data.dof.focus_distance, camera.data.dof.aperture_fstop = True, 200, 0.5
    scene.render.use_multiview, camera.data.stereo.interocular_distance = True, 6.4


def fisheye(kind):
    scene, camera = new()
    scene.render.resolution_x = scene.render.resolution_y = 256
    lens = pano(camera.data)
    lens.panorama_type, lens.fisheye_lens, lens.fisheye_fov = kind, 10.5, math.pi
    camera.data.sensor_width = 29.7
    plane(material()[0])


def equisolid():
    fisheye("FISHEYE_EQUISOLID")


def polynomial():
    fisheye("FISHEYE_LENS_POLYNOMIAL")


def mirror_ball():
    fisheye("MIRRORBALL")


# --- time


def moving():
    """What may change from frame 11 to 20, saved at frame 16: a place, a colour, a glow, a lamp, what is shown."""
    scene, camera = new()
    scene.frame_start, scene.frame_end = 11, 20
    walker = plane(material("walker")[0], "walker")
    key(walker, "location", (11, (0, 3, 1)), (20, (9, 3, 1)))
    sign, tree, body = material("sign")
    (body.inputs.get("Emission") or body.inputs["Emission Color"]).default_value = (1, 0.5, 0.25, 1)
    key(body.inputs["Emission Strength"], "default_value", (11, 0), (20, 9))
    key(body.inputs["Roughness"], "default_value", (11, 0.1), (20, 1.0))
    plane(sign, "sign")
    guest = plane(material("guest")[0], "guest")
    key(guest, "hide_render", (11, True), (15, False))
    key(lamp("POINT").data, "color", (11, (1, 0, 0)), (20, (0, 0, 1)))
    for action in bpy.data.actions:
        for curve in action.fcurves:
            for each in curve.keyframe_points:
                each.interpolation = "CONSTANT" if curve.data_path == "hide_render" else "LINEAR"
    other = link("other", camera.data.copy())
    other.location, other.rotation_euler = (5, 0, 1.6), (math.pi / 2, 0, math.pi)
    for frame, each in ((11, camera), (18, other)):
        scene.timeline_markers.new(each.name, frame=frame).camera = each
    scene.frame_set(16)


def waves():
    """A modifier that moves points: y of the plane's points is a ramp of the frame."""
    scene, _ = new()
    scene.frame_end = 5
    thing = plane(material()[0])
    goal = link("goal", None)
    hook = thing.modifiers.new("hook", "HOOK")
    hook.object = goal
    hook.vertex_indices_set([0])
    hook.matrix_inverse = goal.matrix_world.inverted()
    key(goal, "location", (1, (0, 0, 0)), (5, (0, 0, 4)))
    for curve in goal.animation_data.action.fcurves:
        for each in curve.keyframe_points:
            each.interpolation = "LINEAR"
    scene.frame_set(3)


def sparks():
    """Three particles that fly up, the last of which is born in frame 4."""
    scene, _ = new()
    scene.frame_end = 6
    ground = plane(material()[0])
    ground.rotation_euler = (0, 0, 0)
    spark = plane(material("spark")[0], "spark")
    ground.modifiers.new("sparks", "PARTICLE_SYSTEM")
    flight = ground.particle_systems[0].settings
    flight.count, flight.frame_start, flight.frame_end, flight.lifetime = 3, 1, 4, 100
    flight.normal_factor, flight.effector_weights.gravity = 24, 0
    flight.render_type, flight.instance_object, flight.particle_size = "OBJECT", spark, 1
    for frame in range(1, 7):
        scene.frame_set(frame)


def background_set():
    """A thing of the scene, a thing of its set, and a view layer that is not the active one."""
    scene, _ = new()
    thing = plane(material()[0])
    other = bpy.data.scenes.new("set")
    wall = bpy.data.objects.new("wall", thing.data)
    other.collection.objects.link(wall)
    room = bpy.data.collections.new("room")
    other.collection.children.link(room)
    room.objects.link(bpy.data.objects.new("chair", thing.data))
    scene.background_set = other
    scene.view_layers.new("second")


def nodes_material():
    """Red by its slot, blue by its geometry nodes."""
    new()
    red, _, red_node = material("red")
    red_node.inputs["Base Color"].default_value = (1, 0, 0, 1)
    blue, _, blue_node = material("blue")
    blue_node.inputs["Base Color"].default_value = (0, 0, 1, 1)
    tree = bpy.data.node_groups.new("nodes", "GeometryNodeTree")
    for kind in ("INPUT", "OUTPUT"):
        if hasattr(tree, "interface"):
            tree.interface.new_socket("mesh", in_out=kind, socket_type="NodeSocketGeometry")
        else:
            getattr(tree, kind.lower() + "s").new("NodeSocketGeometry", "mesh")
    paint = tree.nodes.new("GeometryNodeSetMaterial")
    paint.inputs["Material"].default_value = blue
    tree.links.new(tree.nodes.new("NodeGroupInput").outputs[0], paint.inputs[0])
    tree.links.new(paint.outputs[0], tree.nodes.new("NodeGroupOutput").inputs[0])
    plane(red).modifiers.new("nodes", "NODES").node_group = tree


def film():
    """A cloth that falls, a wave, and a lamp, a camera and a box that move, for 60 frames."""
    scene, camera = new()
    scene.frame_end = 60
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=8, y_subdivisions=8, size=2, location=(0, 3, 2))
    bpy.context.object.name = "cloth"
    cloth = bpy.context.object.modifiers.new("cloth", "CLOTH")
    cloth.settings.vertex_group_mass = bpy.context.object.vertex_groups.new(name="pin").name
    bpy.context.object.vertex_groups["pin"].add([0, 1, 2], 1.0, "REPLACE")
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=8, y_subdivisions=8, size=2, location=(0, -3, 2))
    bpy.context.object.name = "sheet"
    bpy.context.object.modifiers.new("wave", "WAVE")
    light = lamp("POINT", energy=10)
    key(light.data, "energy", (1, 10), (60, 40))
    key(camera, "location", (1, (0, 0, 1.6)), (60, (0, 1, 1.6)))
    bpy.ops.mesh.primitive_cube_add(size=1)
    bpy.context.object.name = "box"
    key(bpy.context.object, "rotation_euler", (1, (0, 0, 0)), (60, (0, 0, 3)))
    scene.frame_set(1)


BAKED = {boxes: 32, glow_along: 32}
BEGUN = {film: beginning.Beginning(3)}
SCENES = [nested_mixes, used_colors, unused_colors, mask, decal, tiles, boxes, constant, without_pictures,
          computed_gloss, glow, glow_along, library, override, fog, settings, portal, hidden_world, two_worlds, focus,
          equisolid, polynomial, mirror_ball, moving, waves, sparks, film, nodes_material,
          background_set]



def main():
    opening.repair_numpy()
    for make in SCENES:
        for words, size, start in (("", 0, None), (" baked", BAKED.get(make), None), (" begun", 0, BEGUN.get(make))):
            if size is None or (words == " begun" and start is None):
                continue
            folder = os.path.join(OUT, make.__name__ + words)
            os.makedirs(folder)
            try:
                make()
                export.export_scene(bpy.context, folder, size, start)
            except Exception:
                with open(os.path.join(folder, "error"), "w", encoding="utf-8") as file:
                    traceback.print_exc(file=file)


main()
sys.stdout.flush()
os._exit(0)
