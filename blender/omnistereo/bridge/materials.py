# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Materials as one Principled BSDF each, which Blender's glTF exporter reads, and what it does not know of them."""
import bpy

from .groups import unpack_groups
from .ledger import Ledger, some
from .looks import PLAIN, Reader, is_constant, output_of, principled_input, source_of

COLORS = {"VERTEX_COLOR": "layer_name", "ATTRIBUTE": "attribute_name"}


def unlink(node, key):
    for link in list(principled_input(node, key).links):
        node.id_data.links.remove(link)


def _set(tree, node, key, value):
    socket = principled_input(node, key)
    if socket is None or value is None:
        return
    unlink(node, key)
    if is_constant(value):
        socket.default_value = value
    else:
        tree.links.new(value, socket)


def _make_matt(material, color):
    """What Cycles makes of a material without nodes."""
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = color
    tree.links.new(diffuse.outputs[0], output.inputs["Surface"])


def fill_slots(objects, override):
    """What has no material gets Cycles' own; all get the view layer's override, if it has one."""
    plain = bpy.data.materials.new("no material")
    _make_matt(plain, PLAIN["color"])
    for each in objects:
        if not each.material_slots:
            each.data.materials.append(plain)
        for slot in each.material_slots:
            slot.material = override or slot.material or plain


def _is_color_attribute(source):
    node = source.node
    return node.type in COLORS and source.name == "Color" and getattr(node, "attribute_type", "GEOMETRY") == "GEOMETRY"


def _take_colors(material, node):
    """Vertex colours, alone or times something, become the file's own; what is left computes the base colour."""
    socket = principled_input(node, "color")
    source = source_of(socket)
    if source is None:
        return
    inputs, rest = [source], (1.0, 1.0, 1.0, 1.0)
    product = source.node
    if product.type in ("MIX_RGB", "MIX") and product.blend_type == "MULTIPLY":
        factor, *both = [i for i in product.inputs if i.enabled]
        if not factor.is_linked and factor.default_value == 1.0:
            inputs = [source_of(i) or tuple(i.default_value) for i in both]
    colors = next((i for i in inputs if not is_constant(i) and _is_color_attribute(i)), None)
    if colors is None:
        return
    if len(inputs) == 2:
        rest = inputs[1 - inputs.index(colors)]
    material["ods_colors"] = getattr(colors.node, COLORS[colors.node.type])
    _set(material.node_tree, node, "color", rest)


def simplify(material, ledger):
    """Leaves a Principled BSDF at the output, and returns it; None: there is no output."""
    if not material.use_nodes or material.node_tree is None:
        _make_matt(material, (*material.diffuse_color[:3], 1.0))
    tree = material.node_tree
    unpack_groups(tree)
    output = output_of(tree)
    if output is None:
        return None
    for name in ("Volume", "Displacement"):
        source = source_of(output.inputs[name])
        if source is not None:
            what = "the volume" if name == "Volume" else "the displacement"
            ledger.lose(f"{what} does not come across", "material", material.name,
                        "choose --renderer cycles")
    reader = Reader(material, ledger)
    look = reader.look_of(output.inputs["Surface"])
    if not output.inputs["Surface"].is_linked and output.inputs["Volume"].is_linked:
        look.values["alpha"] = 0.0  # a volume has no surface
    if not is_constant(look.get("strength")):
        look.values["emission"], look.values["strength"] = reader.times(look.get("emission"), look.get("strength")), 1.0
    reader.finish()
    node = look.node
    if node is None:
        node = tree.nodes.new("ShaderNodeBsdfPrincipled")
        node["ods_own"] = 1  # it replaces other shaders
    if "translucent" in look.values:
        material["ods_translucent"] = 1
    for key in (*PLAIN, "normal"):
        _set(tree, node, key, look.get(key))
    for link in list(output.inputs["Surface"].links):
        tree.links.remove(link)
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    _take_colors(material, node)
    # Cycles always heeds alpha and both sides; the exporter asks the viewport's settings.
    alpha = principled_input(node, "alpha")
    material.blend_method = "BLEND" if alpha.is_linked or alpha.default_value < 1.0 else "OPAQUE"
    material.use_backface_culling = False
    return node


def name_missing_pictures(ledger):
    missing = []
    for image in bpy.data.images:
        if image.source == "FILE" and image.users > 0 and not image.packed_file and not image.has_data:
            try:
                image.update()
            except RuntimeError:
                pass
            if image.size[0] == 0:
                missing.append(image.filepath or image.name)
    if missing:
        ledger.say(f"the picture{'s' if len(missing) > 1 else ''} {some(missing)} cannot be found")


def albedo_scale(node):
    """How much brighter the Principled BSDF of Blender 3.x scatters than glTF's materials of the same colour.

    There the gloss lies on top of the diffuse part and takes nothing from it, and the diffuse part is Disney's. Fitted
    to what a sphere in a white world sends back, of either renderer, at seven roughnesses (docs/blender.md): within one
    percent.
    """
    if bpy.app.version >= (4, 0, 0):
        return 1.0
    values = {key: principled_input(node, key) for key in ("roughness", "specular", "metallic", "transmission")}
    if values["metallic"].is_linked or values["transmission"].is_linked:
        return 1.0
    roughness = 0.5 if values["roughness"].is_linked else values["roughness"].default_value
    specular = 0.5 if values["specular"].is_linked else values["specular"].default_value
    diffuse = (1 - values["metallic"].default_value) * (1 - values["transmission"].default_value)
    scale = (0.955 + 0.11 * roughness) / (1 - (0.089 - 0.071 * roughness) * 2 * min(specular, 1.0))
    return 1.0 + (scale - 1.0) * diffuse


def constants_of(material):
    """What of a material is the same all over, as keys and drivers have it now: "color", "glow", ..."""
    copy = material.copy()
    unpack_groups(copy.node_tree)
    output = output_of(copy.node_tree)
    found = {}
    if output is not None:
        look = Reader(copy, Ledger()).look_of(output.inputs["Surface"])
        keys = ("color", "metallic", "roughness", "alpha")
        found = {key: look.get(key) for key in keys if is_constant(look.get(key))}
        if is_constant(look.get("strength")):
            emission = look.get("emission") if is_constant(look.get("emission")) else (1.0, 1.0, 1.0)
            found["glow"] = [c * look.get("strength") for c in emission[:3]]
    bpy.data.materials.remove(copy)
    return found


def use_colors(objects, ledger):
    """Has the exporter write the vertex colours that the materials read."""
    for each in objects:
        wanted = {s.material["ods_colors"] for s in each.material_slots if s.material and "ods_colors" in s.material}
        layers = getattr(each.data, "color_attributes", None)
        if not wanted or layers is None:
            continue
        if len(wanted) > 1:
            ledger.lose("of several vertex colours only one comes across", "object", each.name)
        index = layers.find(next(iter(wanted)))
        layers.render_color_index = layers.render_color_index if index < 0 else index


def finish_in_file(glb, strengths, translucent, scales, colored):
    """What the exporter does not know: by material name the emission's colour and strength, albedo_scale(), and which
    read vertex colours: the exporter writes those of all meshes."""
    names = [material.get("name") for material in glb.list("materials")]
    for primitive in (p for mesh in glb.list("meshes") for p in mesh["primitives"]):
        if names[primitive["material"]] not in colored if "material" in primitive else True:
            primitive["attributes"].pop("COLOR_0", None)
    for material in glb.list("materials"):
        material["doubleSided"] = True
        name = material.get("name")
        if abs(scales.get(name, 1.0) - 1.0) > 1e-3:
            material.setdefault("extensions", {})["ODS_albedo"] = {"scale": round(scales[name], 4)}
            glb.use("ODS_albedo")
        coat = material.get("extensions", {}).get("KHR_materials_clearcoat")
        if coat and bpy.app.version < (4, 0, 0):
            coat["clearcoatFactor"] = 0.25 * coat.get("clearcoatFactor", 0.0)
        if name in translucent:
            glb.use("KHR_materials_diffuse_transmission")
            color = material.get("pbrMetallicRoughness", {}).get("baseColorFactor", [1, 1, 1, 1])[:3]
            material.setdefault("extensions", {})["KHR_materials_diffuse_transmission"] = {
                "diffuseTransmissionFactor": 1.0, "diffuseTransmissionColorFactor": color}
        if name not in strengths:
            continue
        color, strength = strengths[name]
        radiance = [c * strength for c in color]
        brightest = max(radiance)
        if not brightest > 0:
            for key in ("emissiveFactor", "emissiveTexture"):
                material.pop(key, None)
            continue
        material["emissiveFactor"] = [c / brightest for c in radiance]
        material.setdefault("extensions", {})["KHR_materials_emissive_strength"] = {"emissiveStrength": brightest}
        glb.use("KHR_materials_emissive_strength")
        material["extensions"].pop("KHR_materials_unlit", None)


def strength_of(node):
    """(colour, strength) of the emission; the colour is white where a picture multiplies it."""
    emission, strength = principled_input(node, "emission"), principled_input(node, "strength")
    color = (1.0, 1.0, 1.0) if emission.is_linked else tuple(emission.default_value)[:3]
    return color, strength.default_value
