# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Which inputs of a material Blender's exporter takes as they are, and what it does not take.

A node is taken if every setting that differs from a fresh node's is one that a rule here knows; so a setting that is
new in Blender makes a picture computed, not wrong.
"""
from .looks import label_of, nodes_behind, principled_input, source_of

BAKED = ("color", "metallic", "roughness", "transmission", "alpha", "emission", "normal")
FLAT = ("specular", "ior")  # never baked; the exporter drops what it does not take
SRGB = ("color", "emission")
MISSING = "a picture that is missing"
SPLIT = {"SEPRGB", "SEPARATE_COLOR"}
PAIRS = (("color", "alpha"), ("metallic", "roughness"))  # which glTF has in one picture


def has_pixels(node):
    """Whether an Image Texture has a picture; without one Cycles shows one colour all over."""
    return node.image is not None and (node.image.source != "FILE" or node.image.size[0] > 0)


class Rules:
    """For the trees of one export."""

    def __init__(self, ledger):
        self.ledger = ledger

    def _is_set(self, node, *known):
        """Whether something is set on a node that is not known here."""
        fresh = node.id_data.nodes.new(node.bl_idname)
        found = [path for path, _ in self.ledger.changed(node, fresh) if path.split(".")[0] not in known]
        node.id_data.nodes.remove(fresh)
        return bool(found)

    def layout_fault(self, socket):
        """What of a picture's coordinates does not come across; None: nothing."""
        source = source_of(socket)
        if source is None:
            return None
        node = source.node
        if node.type == "MAPPING":
            places = [i for i in node.inputs if i.name != "Vector"]
            turned = any(abs(a) > 1e-6 for a in node.inputs["Rotation"].default_value[:2])
            if any(i.is_linked for i in places) or turned or node.vector_type not in ("POINT", "TEXTURE", "VECTOR"):
                return label_of(node)
            uneven = len({round(s, 5) for s in node.inputs["Scale"].default_value[:2]}) > 1
            if node.vector_type == "TEXTURE" and uneven and abs(node.inputs["Rotation"].default_value[2]) > 1e-6:
                return label_of(node)
            return self.layout_fault(node.inputs["Vector"])
        if node.type == "TEX_COORD":
            return None if source.name == "UV" and not node.from_instancer else f"{source.name} coordinates"
        return None if node.type == "UVMAP" and not node.from_instancer else label_of(node)

    def picture_fault(self, node, is_color):
        """The same of an Image Texture: its picture, how that is laid out and repeated."""
        if self._is_set(node, "image", "image_user", "interpolation", "extension"):
            return label_of(node)
        if not has_pixels(node):
            return MISSING
        layout = self.layout_fault(node.inputs["Vector"])
        if layout is not None:
            return layout
        if node.extension not in ("REPEAT", "EXTEND"):
            return f"{node.extension.capitalize()} of a picture"
        if node.image.source not in ("FILE", "GENERATED"):
            return {"TILED": "UDIM tiles"}.get(node.image.source, "a picture that changes")
        space = node.image.colorspace_settings.name
        if is_color and (space != "sRGB" or node.image.is_float):
            return f"a picture in {space}" if space != "sRGB" else "a picture in floats"
        if not is_color and not node.image.colorspace_settings.is_data:
            return f"data of a picture in {space}"
        return None

    def fault(self, key, socket):
        """What of a linked input the exporter would not take; None: nothing."""
        source = source_of(socket)
        if source is None:
            return None
        node = source.node
        if key == "normal":
            if node.type != "NORMAL_MAP" or node.space != "TANGENT" or node.inputs["Strength"].is_linked:
                return label_of(node)
            return self.fault("map", node.inputs["Color"])
        if node.type in SPLIT and key not in (*SRGB, "map", "alpha"):
            inner = source_of(node.inputs[0])
            if getattr(node, "mode", "RGB") != "RGB" or inner is None:
                return label_of(node)
            source, node = inner, inner.node
        if node.type == "TEX_IMAGE":
            if (source.name == "Alpha") != (key == "alpha") and not (source.name == "Color" and key == "alpha"):
                return "the alpha of a picture"
            return self.picture_fault(node, key in SRGB or source.name == "Alpha")
        return label_of(node)


def changes(node):
    """Whether a picture is another in each frame."""
    sources = [source_of(socket) for socket in node.inputs]
    return any(each.type == "TEX_IMAGE" and each.image and each.image.source in ("SEQUENCE", "MOVIE")
               for source in sources if source for each in nodes_behind(source))


def is_plain_normal(socket):
    """Whether its nodes change nothing: Blender's importers leave a normal map without a picture in each material."""
    found = source_of(socket)
    if found is None:
        return True
    node = found.node
    if node.type == "NORMAL_MAP":
        color = node.inputs["Color"]
        return not color.is_linked and max(abs(a - b) for a, b in zip(color.default_value, (0.5, 0.5, 1.0))) < 1e-3
    return node.type == "BUMP" and not node.inputs["Height"].is_linked and is_plain_normal(node.inputs["Normal"])


def _layout(socket):
    """Where the picture behind an input lies: inputs of one picture have the same."""
    source = source_of(socket)
    if source is None:
        return None
    node = source.node if source.node.type == "TEX_IMAGE" else source_of(source.node.inputs[0]).node
    vector = source_of(node.inputs["Vector"])
    return (vector.node.name if vector else "", node.extension, node.interpolation)


def computed_inputs(node, rules):
    """The inputs of a Principled BSDF that the exporter does not take: what of each it does not take, by key."""
    found = {}
    for key in BAKED:
        socket = principled_input(node, key)
        if socket is None or not socket.is_linked or (key == "normal" and is_plain_normal(socket)):
            continue
        fault = rules.fault(key, socket)
        if fault is not None:
            found[key] = fault
    for pair in PAIRS:
        first, second = (principled_input(node, key) for key in pair)
        if not (first.is_linked and second.is_linked):
            continue
        faulty = [key for key in pair if key in found]
        if len(faulty) == 1 or (not faulty and _layout(first) != _layout(second)):
            found.update({key: found.get(key, "pictures of different layouts") for key in pair})
    return found
