# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Materials as one Principled BSDF each, which is what Blender's glTF exporter reads.

What has no place in glTF is named. What is computed by nodes is kept as a list, for bake.py or for a warning.
"""
import bpy

from .groups import unpack_groups
from .report import some

# Inputs of the Principled BSDF that glTF has, by what Blender called them in 3.x and from 4.0 on.
INPUTS = {
    "color": ("Base Color",),
    "metallic": ("Metallic",),
    "roughness": ("Roughness",),
    "ior": ("IOR",),
    "specular": ("Specular", "Specular IOR Level"),
    "transmission": ("Transmission", "Transmission Weight"),
    "alpha": ("Alpha",),
    "emission": ("Emission", "Emission Color"),
    "strength": ("Emission Strength",),
    "normal": ("Normal",),
}
PLAIN = {  # what a Principled BSDF of ours starts as
    "color": (0.8, 0.8, 0.8, 1.0), "metallic": 0.0, "roughness": 0.5, "ior": 1.45, "specular": 0.5, "transmission": 0.0,
    "alpha": 1.0, "emission": (0.0, 0.0, 0.0, 1.0), "strength": 1.0,
}
BAKED = ("color", "metallic", "roughness", "transmission", "alpha", "emission", "normal")
THROUGH = {"REROUTE", "MIX_RGB", "MIX", "MAPPING", "SEPRGB", "SEPARATE_COLOR", "NORMAL_MAP", "VALUE", "RGB"}


def put(node, key):
    """The input of a Principled BSDF."""
    return next((node.inputs[name] for name in INPUTS[key] if name in node.inputs), None)


def source_of(socket):
    """What is linked to an input, past reroutes; None: nothing."""
    while socket is not None and socket.is_linked:
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return socket.links[0].from_socket
        socket = node.inputs[0]
    return None


def output_of(tree):
    outputs = [n for n in tree.nodes if n.type == "OUTPUT_MATERIAL" and n.target in ("ALL", "CYCLES")]
    return next((n for n in outputs if n.is_active_output), outputs[0] if outputs else None)


class Look:
    """What a shader looks like: per input a value, or the socket that computes it."""

    def __init__(self, node=None, **values):
        self.node = node  # a Principled BSDF that is it already
        self.values = values
        self.clear = False  # a white Transparent BSDF: nothing
        self.doubts = []

    def get(self, key):
        if key in self.values:
            return self.values[key]
        if self.node is not None:
            socket = put(self.node, key)
            if socket is None:
                return PLAIN.get(key)
            return source_of(socket) or (tuple(socket.default_value) if key in ("color", "emission") else
                                         None if key == "normal" else socket.default_value)
        return PLAIN.get(key)


def _input(node, name):
    socket = node.inputs.get(name)
    if socket is None:
        return None
    found = source_of(socket)
    if found is not None:
        return found
    value = socket.default_value
    return tuple(value) if hasattr(value, "__len__") and name != "Normal" else None if name == "Normal" else value


def is_constant(value):
    return not isinstance(value, bpy.types.NodeSocket)


def _with_normal(look, node):
    normal = _input(node, "Normal")
    if normal is not None:
        look.values["normal"] = normal
    return look


def _simple(node):
    """Of a closure that is one lobe."""
    kind, color, rough = node.type, _input(node, "Color"), _input(node, "Roughness")
    if kind == "BSDF_DIFFUSE":
        return _with_normal(Look(color=color, roughness=1.0, specular=0.0), node)
    if kind in ("BSDF_GLOSSY", "BSDF_ANISOTROPIC", "BSDF_METALLIC"):
        return _with_normal(Look(color=_input(node, "Base Color") if kind == "BSDF_METALLIC" else color,
                                 roughness=rough, metallic=1.0), node)
    if kind in ("BSDF_GLASS", "BSDF_REFRACTION"):
        return _with_normal(Look(color=color, roughness=rough, transmission=1.0, ior=_input(node, "IOR")), node)
    if kind == "BSDF_TRANSPARENT":
        if is_constant(color) and min(color[:3]) > 0.999:
            look = Look(alpha=0.0)
            look.clear = True
            return look
        return Look(color=color, roughness=0.0, transmission=1.0, ior=1.0)
    if kind == "EMISSION":
        return Look(color=(0.0, 0.0, 0.0, 1.0), specular=0.0, roughness=1.0, emission=color,
                    strength=_input(node, "Strength"))
    if kind == "BSDF_TRANSLUCENT":
        look = Look(color=color, roughness=1.0, specular=0.0)
        look.values["translucent"] = 1.0
        return look
    look = Look(color=color if color is not None else PLAIN["color"], roughness=1.0)
    look.doubts.append(f"'{node.name}' becomes a rough surface of its colour")
    return look


def _blend(a, b, share):
    """Of constants."""
    if isinstance(a, tuple):
        return tuple(x + (y - x) * share for x, y in zip(a, b))
    return a + (b - a) * share


def _mix(node):
    fac = _input(node, "Fac")
    first, second = (look_of(node.inputs[i]) for i in (1, 2))
    if not is_constant(fac) and fac.node.type == "LIGHT_PATH":
        return second if fac.name == "Is Camera Ray" else first
    if first.clear != second.clear:
        kept = second if first.clear else first
        if is_constant(fac):
            alpha = fac if first.clear else 1.0 - fac
            own = kept.get("alpha")
            kept.values["alpha"] = alpha * own if is_constant(own) else alpha
        elif first.clear and kept.get("metallic") == 1.0:
            # Gloss towards the edges and nothing else: a pane.
            kept.values.update(metallic=0.0, transmission=1.0, ior=1.45)
        elif first.clear:
            kept.values["alpha"] = fac
        else:
            kept.values["alpha"] = ("inverse", fac)
        return kept
    if not is_constant(fac):
        if fac.name == "Backfacing":
            return first
        if first.get("metallic") == 0.0 and second.get("metallic") == 1.0:
            # The way to a dielectric before the Principled BSDF, and to a tinted pane.
            first.values.update(specular=0.5, roughness=second.get("roughness"))
            if first.get("ior") == 1.0:
                first.values["ior"] = 1.45
            return first
        first.doubts.append(f"the mix '{node.name}' changes from place to place: it comes across as a mean")
        fac = 0.1 if fac.name == "Fresnel" or fac.node.type == "FRESNEL" else 0.5
    if fac <= 0.0 or fac >= 1.0:
        return first if fac <= 0.0 else second
    major = first if fac < 0.5 else second
    mixed = Look()
    mixed.doubts = first.doubts + second.doubts
    for key in PLAIN:
        a, b = first.get(key), second.get(key)
        mixed.values[key] = _blend(a, b, fac) if is_constant(a) and is_constant(b) else major.get(key)
    glow = [tuple(c * l.get("strength") for c in l.get("emission")[:3])
            for l in (first, second) if is_constant(l.get("strength")) and is_constant(l.get("emission"))]
    if len(glow) == 2:
        mixed.values["emission"], mixed.values["strength"] = _blend(glow[0], glow[1], fac) + (1.0,), 1.0
    mixed.values["normal"] = major.get("normal")
    return mixed


def _add(node):
    first, second = (look_of(node.inputs[i]) for i in (0, 1))
    dark = lambda look: is_constant(look.get("color")) and max(look.get("color")[:3]) == 0.0
    lamp, body = (first, second) if dark(first) else (second, first)
    if dark(lamp):
        body.values.update(emission=lamp.get("emission"), strength=lamp.get("strength"))
    else:
        body.doubts.append(f"of the sum '{node.name}' only one shader comes across")
    return body


def look_of(socket):
    found = source_of(socket)
    if found is None:
        return Look(color=(0.0, 0.0, 0.0, 1.0), specular=0.0)
    node = found.node
    if node.type == "BSDF_PRINCIPLED":
        return Look(node)
    if node.type == "MIX_SHADER":
        return _mix(node)
    if node.type == "ADD_SHADER":
        return _add(node)
    if node.type == "GROUP":
        look = Look()
        look.doubts.append(f"the group '{node.name}' is missing")
        return look
    return _simple(node)


def _set(tree, node, key, value):
    socket = put(node, key)
    if socket is None or value is None:
        return
    for link in list(socket.links):
        tree.links.remove(link)
    if isinstance(value, tuple) and value and value[0] == "inverse":
        math = tree.nodes.new("ShaderNodeMath")
        math.operation = "SUBTRACT"
        math.inputs[0].default_value = 1.0
        tree.links.new(value[1], math.inputs[1])
        value = math.outputs[0]
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


def fill_slots(objects):
    """What has no material gets Cycles' own."""
    plain = bpy.data.materials.new("no material")
    _make_matt(plain, PLAIN["color"])
    for each in objects:
        try:
            if not each.material_slots:
                each.data.materials.append(plain)
            for slot in each.material_slots:
                slot.material = slot.material or plain
        except (AttributeError, RuntimeError):
            pass  # of a library


def simplify(material, report):
    """Leaves a Principled BSDF at the output, and returns it; None: there is no output."""
    if not material.use_nodes or material.node_tree is None:
        _make_matt(material, (*material.diffuse_color[:3], 1.0))
    tree = material.node_tree
    unpack_groups(tree)
    output = output_of(tree)
    if output is None:
        return None
    for name in ("Volume", "Displacement"):
        if output.inputs[name].is_linked:
            report.warn(f"material '{material.name}': its {name.lower()} does not come across")
    look = look_of(output.inputs["Surface"])
    for doubt in look.doubts:
        report.warn(f"material '{material.name}': {doubt}")
    node = look.node
    if node is None or look.values:
        fresh = tree.nodes.new("ShaderNodeBsdfPrincipled")
        if look.node is None:
            fresh["ods_own"] = 1  # it stands for other shaders
        for key in list(PLAIN) + ["normal"]:
            _set(tree, fresh, key, look.get(key))
        node = fresh
        if "translucent" in look.values:
            material["ods_translucent"] = 1
    for link in list(output.inputs["Surface"].links):
        tree.links.remove(link)
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    # Cycles always heeds alpha and both sides; the exporter asks the viewport's settings.
    alpha = put(node, "alpha")
    material.blend_method = "BLEND" if alpha.is_linked or alpha.default_value < 1.0 else "OPAQUE"
    material.use_backface_culling = False
    return node


def _reads_image(socket, depth=0):
    """Whether the exporter finds a picture there: an Image Texture, at most behind a factor."""
    found = source_of(socket)
    if found is None or depth > 6:
        return False
    node = found.node
    if node.type == "TEX_IMAGE":
        return node.image is not None
    if node.type not in THROUGH:
        return False
    return any(_reads_image(i, depth + 1) for i in node.inputs if i.is_linked)


def _is_plain_normal(socket):
    """Whether its nodes change nothing: Blender's importers leave a normal map without a picture in each material."""
    found = source_of(socket)
    if found is None:
        return True
    node = found.node
    if node.type == "NORMAL_MAP":
        color = node.inputs["Color"]
        return not color.is_linked and max(abs(a - b) for a, b in zip(color.default_value, (0.5, 0.5, 1.0))) < 1e-3
    return node.type == "BUMP" and not node.inputs["Height"].is_linked and _is_plain_normal(node.inputs["Normal"])


def computed_inputs(node):
    """The inputs of a Principled BSDF whose nodes the exporter does not follow."""
    found = []
    for key in BAKED:
        socket = put(node, key)
        is_plain = key == "normal" and _is_plain_normal(socket)
        if socket is not None and socket.is_linked and not is_plain and not _reads_image(socket):
            found.append(key)
    return found


def name_missing_pictures(report):
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
        report.warn(f"the picture{'s' if len(missing) > 1 else ''} {some(missing)} cannot be found")


def albedo_scale(node):
    """How much brighter the Principled BSDF of Blender 3.x scatters than glTF's materials of the same colour.

    There the gloss lies on top of the diffuse part and takes nothing from it, and the diffuse part is Disney's. Fitted
    to what a sphere in a white world sends back, of either renderer, at seven roughnesses (docs/blender.md): within one
    percent.
    """
    if bpy.app.version >= (4, 0, 0):
        return 1.0
    values = {key: put(node, key) for key in ("roughness", "specular", "metallic", "transmission")}
    if values["metallic"].is_linked or values["transmission"].is_linked:
        return 1.0
    roughness = 0.5 if values["roughness"].is_linked else values["roughness"].default_value
    specular = 0.5 if values["specular"].is_linked else values["specular"].default_value
    diffuse = (1 - values["metallic"].default_value) * (1 - values["transmission"].default_value)
    scale = (0.955 + 0.11 * roughness) / (1 - (0.089 - 0.071 * roughness) * 2 * min(specular, 1.0))
    return 1.0 + (scale - 1.0) * diffuse


def finish_in_file(glb, strengths, translucent, scales):
    """What the exporter does not know: by material name the emission's colour and strength, and albedo_scale()."""
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
    emission, strength = put(node, "emission"), put(node, "strength")
    if strength is None or strength.is_linked:
        return None
    color = (1.0, 1.0, 1.0) if emission.is_linked else tuple(emission.default_value)[:3]
    return color, strength.default_value
