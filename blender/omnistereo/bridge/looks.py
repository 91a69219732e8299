# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Reads a tree of shaders: what it looks like as one Principled BSDF.

Each value of a look is a constant or the socket that computes it. A mix of what is not constant is a new node, which is
then computed like any other: as a picture, or as a mean.
"""
import bpy

# Inputs of the Principled BSDF that glTF has, by their names in Blender 3.x and from 4.0 on.
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
PLAIN = {  # the initial values of our Principled BSDF
    "color": (0.8, 0.8, 0.8, 1.0), "metallic": 0.0, "roughness": 0.5, "ior": 1.45, "specular": 0.5, "transmission": 0.0,
    "alpha": 1.0, "emission": (0.0, 0.0, 0.0, 1.0), "strength": 1.0,
}
# Further inputs that the exporter takes from a Principled BSDF that stays as it is.
KEPT = ("Clearcoat", "Clearcoat Roughness", "Clearcoat Normal", "Coat Weight", "Coat Roughness", "Coat Normal",
        "Specular Tint", "Sheen Weight", "Sheen Roughness", "Sheen Tint")
# Nodes whose answer depends on the direction from which a surface is seen.
ANGLES = {"FRESNEL", "LAYER_WEIGHT", "LIGHT_PATH", "CAMERA"}
BLACK = (0.0, 0.0, 0.0, 1.0)


def principled_input(node, key):
    return next((node.inputs[name] for name in INPUTS.get(key, ()) if name in node.inputs), None)


def source_of(socket):
    """What is linked to an input, past reroutes and muted nodes; None: nothing."""
    while socket is not None and socket.is_linked:
        link = socket.links[0]
        node = link.from_node
        if link.is_muted:
            return None
        if node.type == "REROUTE":
            socket = node.inputs[0]
        elif node.mute:
            socket = next((l.from_socket for l in node.internal_links if l.to_socket == link.from_socket), None)
        else:
            return link.from_socket
    return None


def output_of(tree):
    outputs = [n for n in tree.nodes if n.type == "OUTPUT_MATERIAL" and n.target in ("ALL", "CYCLES")]
    return next((n for n in outputs if n.is_active_output), outputs[0] if outputs else None)


def is_constant(value):
    return not isinstance(value, bpy.types.NodeSocket)


def nodes_behind(socket, found=None):
    """All nodes that a socket's value depends on."""
    found = {} if found is None else found
    node = socket.node
    if node.name not in found:
        found[node.name] = node
        for each in node.inputs:
            source = source_of(each)
            if source is not None:
                nodes_behind(source, found)
    return list(found.values())


def label_of(node):
    """Blender's own words for a node: "Image Texture (Box)"."""
    words = node.bl_label
    if getattr(node, "projection", "FLAT") not in ("FLAT", "EQUIRECTANGULAR"):
        words = f"{node.projection.capitalize()} projection"
    return words


class Look:
    """What a shader looks like: per input a constant, or the socket that computes it."""

    def __init__(self, node=None, **values):
        self.node = node  # a Principled BSDF that is it already
        self.values = values
        self.clear = False  # a white Transparent BSDF: nothing

    def get(self, key):
        if key in self.values:
            return self.values[key]
        socket = principled_input(self.node, key) if self.node is not None else None
        return PLAIN.get(key) if socket is None else value_of(socket)


def value_of(socket):
    """A constant or a socket; None: there is no such input, or it is a normal that nothing changes."""
    if socket is None:
        return None
    source = source_of(socket)
    if source is not None and source.node.type not in ("RGB", "VALUE"):
        return source
    if not hasattr(socket, "default_value") or socket.type not in ("RGBA", "VALUE"):
        return None
    value = (source or socket).default_value
    value = tuple(value) if hasattr(value, "__len__") else value
    if socket.type == "RGBA":
        return value if isinstance(value, tuple) else (value, value, value, 1.0)
    return 0.2126 * value[0] + 0.7152 * value[1] + 0.0722 * value[2] if isinstance(value, tuple) else value


class Reader:
    """Reads one material."""

    def __init__(self, material, ledger):
        self.material, self.ledger, self.tree = material, ledger, material.node_tree
        self.fresh, self.reads = {}, {}  # by the kind of a node: a fresh one; by its name: the inputs that were read

    def lose(self, sentence, remedy=""):
        self.ledger.lose(sentence, "material", self.material.name, remedy)

    # --- computing

    def _node(self, kind, *inputs):
        """A new node that computes something of values."""
        node = self.tree.nodes.new(kind)
        for socket, value in zip(node.inputs, inputs):
            if not is_constant(value):
                self.tree.links.new(value, socket)
            elif value is not None:
                grey = socket.type == "RGBA" and not isinstance(value, tuple)
                socket.default_value = (value, value, value, 1.0) if grey else value
        return node

    def mixed(self, a, b, share):
        """a, and as much of b as the share says."""
        if (is_constant(a) == is_constant(b) and a == b) or share == 0.0:
            return a
        if a is None or b is None or share == 1.0:
            return b if a is None or share == 1.0 else a
        if a == 0.0 and b == 1.0:
            return share
        if all(is_constant(each) for each in (a, b, share)):
            if isinstance(a, tuple):
                return tuple(x + (y - x) * share for x, y in zip(a, b))
            return a + (b - a) * share
        return self._node("ShaderNodeMixRGB", share, a, b).outputs[0]

    def times(self, color, factor):
        if is_constant(color) and is_constant(factor):
            return (*(c * factor for c in color[:3]), 1.0)
        if factor == 1.0:
            return color
        node = self._node("ShaderNodeMixRGB", 1.0, color, factor)
        node.blend_type = "MULTIPLY"
        return node.outputs[0]

    # --- shaders

    def input(self, node, name):
        self.reads.setdefault(node.name, set()).add(name)
        return value_of(node.inputs.get(name))

    def _rest(self, node):
        """Names what is set on a shader and was not read."""
        if node.bl_idname not in self.fresh:
            self.fresh[node.bl_idname] = self.tree.nodes.new(node.bl_idname)
        fresh = self.fresh[node.bl_idname]
        reads = self.reads.get(node.name, ())
        for socket, usual in zip(node.inputs, fresh.inputs):
            weight = node.inputs.get(socket.name.split()[0]) or node.inputs.get(socket.name.split()[0] + " Weight")
            is_idle = (weight is not None and weight != socket and weight.type == "VALUE" and not weight.is_linked
                       and weight.default_value == 0.0)
            if socket.name in reads or is_idle or not socket.enabled:
                continue
            if source_of(socket) is not None or self.ledger.differs(socket, usual):
                self.lose(f"'{socket.name}' of {node.bl_label} does not come across")

    def finish(self):
        for node in self.fresh.values():
            self.tree.nodes.remove(node)

    def look_of(self, socket):
        found = source_of(socket)
        if found is None:
            return Look(color=BLACK, specular=0.0)
        node = found.node
        if node.type == "MIX_SHADER":
            return self._mix(node)
        if node.type == "ADD_SHADER":
            return self._add(node)
        look = self._closure(node)
        self._rest(node)
        return look

    def _closure(self, node):
        kind = node.type
        if kind == "BSDF_PRINCIPLED":
            self.reads[node.name] = {*KEPT, *(name for names in INPUTS.values() for name in names)}
            return Look(node)
        if kind == "GROUP":
            self.lose("a missing node group is shown as grey")
            return Look()
        color, rough = self.input(node, "Color"), self.input(node, "Roughness")
        if kind == "BSDF_DIFFUSE":
            look = Look(color=color, roughness=1.0, specular=0.0)
        elif kind in ("BSDF_GLOSSY", "BSDF_ANISOTROPIC", "BSDF_METALLIC"):
            color = self.input(node, "Base Color") if kind == "BSDF_METALLIC" else color
            look = Look(color=color, roughness=rough, metallic=1.0)
        elif kind in ("BSDF_GLASS", "BSDF_REFRACTION"):
            look = Look(color=color, roughness=rough, transmission=1.0, ior=self.input(node, "IOR"))
        elif kind == "BSDF_TRANSPARENT" and is_constant(color) and min(color[:3]) > 0.999:
            look = Look(alpha=0.0)
            look.clear = True
        elif kind == "BSDF_TRANSPARENT":
            look = Look(color=color, roughness=0.0, transmission=1.0, ior=1.0)
        elif kind == "EMISSION":
            look = Look(color=BLACK, specular=0.0, roughness=1.0, emission=color, strength=self.input(node, "Strength"))
        elif kind == "BSDF_TRANSLUCENT":
            look = Look(color=color, roughness=1.0, specular=0.0, translucent=1.0)
        elif kind == "BACKGROUND":
            look = Look(color=BLACK, specular=0.0, roughness=1.0, emission=color, strength=self.input(node, "Strength"))
        else:
            look = Look(color=color if color is not None else PLAIN["color"], roughness=1.0)
            self.lose(f"{node.bl_label} is shown as a rough surface of its colour")
        normal = self.input(node, "Normal")
        if normal is not None:
            look.values["normal"] = normal
        return look

    def _share(self, node):
        """How much of the second shader a mix has; of what depends on the angle, a mean."""
        share = self.input(node, "Fac")
        if is_constant(share):
            return min(max(share, 0.0), 1.0)
        kinds = {n.type: n for n in nodes_behind(share)}
        if "LIGHT_PATH" in kinds:
            used = {o.name for o in kinds["LIGHT_PATH"].outputs if o.is_linked}
            if used != {"Is Shadow Ray"}:  # lets light through glass, as ours does
                self.lose("a shader that only some rays see (Light Path) comes across as the camera sees it")
            return 1.0 if "Is Camera Ray" in used else 0.0
        if share.name == "Backfacing":
            self.lose("the shader of the backs of faces (Backfacing) does not come across")
            return 0.0
        if ANGLES & set(kinds) and not any(kind.startswith("TEX_") for kind in kinds):
            return None
        return share

    def _mix(self, node):
        share = self._share(node)
        if share in (0.0, 1.0):
            return self.look_of(node.inputs[2 if share else 1])
        first, second = (self.look_of(node.inputs[i]) for i in (1, 2))
        if share is None:
            if first.clear and second.get("metallic") == 1.0:
                # Gloss towards the edges and nothing else: a pane.
                second.values.update(metallic=0.0, transmission=1.0, ior=1.45)
                return second
            if first.get("metallic") == 0.0 and second.get("metallic") == 1.0:
                # The way to a dielectric before the Principled BSDF, and to a tinted pane.
                first.values.update(specular=0.5, roughness=second.get("roughness"))
                if first.get("ior") == 1.0:
                    first.values["ior"] = 1.45
                return first
            self.lose("a mix that depends on the angle comes across as a mean")
            share = 0.1 if source_of(node.inputs["Fac"]).name == "Fresnel" else 0.5
        if first.clear or second.clear:
            kept = second if first.clear else first
            look = Look(kept.node, **kept.values)
            look.clear = first.clear and second.clear
        else:
            self._divide(first)
            self._divide(second)
            look = Look(**{key: self.mixed(first.get(key), second.get(key), share)
                           for key in (*PLAIN, "normal", "translucent")
                           if key not in ("alpha", "emission", "strength") and first.get(key) is not None
                           or second.get(key) is not None})
            self._mix_glow(look, first, second, share)
        look.values["alpha"] = self.mixed(first.get("alpha"), second.get("alpha"), share)
        return look

    def _divide(self, look):
        """Names what a Principled BSDF loses that becomes a part of another."""
        if look.node is not None:
            self.reads[look.node.name] -= set(KEPT)
            self._rest(look.node)

    def _mix_glow(self, look, first, second, share):
        glows = [(each.get("emission"), each.get("strength")) for each in (first, second)]
        if glows[0] == glows[1]:
            look.values["emission"], look.values["strength"] = glows[0]
            return
        look.values["emission"] = self.mixed(*(self.times(*glow) for glow in glows), share)
        look.values["strength"] = 1.0

    def _add(self, node):
        first, second = (self.look_of(node.inputs[i]) for i in (0, 1))
        dark = lambda look: is_constant(look.get("color")) and max(look.get("color")[:3]) == 0.0
        lamp, body = (first, second) if dark(first) else (second, first)
        if dark(lamp) and not body.clear:
            body.values.update(emission=lamp.get("emission"), strength=lamp.get("strength"))
        else:
            self.lose("of a sum of two shaders (Add Shader) only one comes across")
            body = lamp if body.clear else body
        return body
