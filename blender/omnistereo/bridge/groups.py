# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Node groups, unpacked into the tree that uses them: what follows looks at one tree."""

MOST = 500  # groups in a material
NOT_COPIED = {"parent", "name", "select", "location", "width", "height", "show_texture"}


def _copy_ramp(source, to):
    to.color_mode, to.interpolation = source.color_mode, source.interpolation
    to.hue_interpolation = source.hue_interpolation
    while len(to.elements) < len(source.elements):
        to.elements.new(1.0)
    while len(to.elements) > len(source.elements):
        to.elements.remove(to.elements[-1])
    for number, element in enumerate(source.elements):
        to.elements[number].position, to.elements[number].color = element.position, element.color


def _copy_curves(source, to):
    for curve, copy in zip(source.curves, to.curves):
        while len(copy.points) < len(curve.points):
            copy.points.new(1.0, 1.0)
        for point, made in zip(curve.points, copy.points):
            made.location, made.handle_type = point.location, point.handle_type
    to.update()


def _copy_values(source, to):
    for one, other in zip(source, to):
        if hasattr(one, "default_value") and one.type == other.type:
            other.default_value = one.default_value


def _copy(tree, node):
    copy = tree.nodes.new(node.bl_idname)
    for prop in node.bl_rna.properties:
        name = prop.identifier
        if name == "color_ramp":
            _copy_ramp(node.color_ramp, copy.color_ramp)
        elif name == "mapping" and hasattr(node.mapping, "curves"):
            _copy_curves(node.mapping, copy.mapping)
        elif not prop.is_readonly and name not in NOT_COPIED:
            try:
                setattr(copy, name, getattr(node, name))
            except (AttributeError, TypeError, ValueError):
                pass  # of another kind of tree
    _copy_values(node.inputs, copy.inputs)
    _copy_values(node.outputs, copy.outputs)
    return copy


def _same(socket, others):
    """The socket of a copy, or of the other side of a group; older files have other identifiers. None: there is none."""
    found = next((s for s in others if s.identifier == socket.identifier), None)
    return found or next((s for s in others if s.name == socket.name), None)


def _give(value, socket):
    """A group's own value, to an input of a perhaps other type."""
    if value is None or not hasattr(socket, "default_value") or socket.hide_value:
        return
    many, wants = hasattr(value, "__len__"), hasattr(socket.default_value, "__len__")
    if many and not wants:
        value = 0.2126 * value[0] + 0.7152 * value[1] + 0.0722 * value[2]
    elif wants:
        size = len(socket.default_value)
        value = (list(value)[:size] if many else [value] * min(size, 3)) + [1.0] * size
        value = value[:size]
    try:
        socket.default_value = value
    except (TypeError, ValueError):
        pass  # text and the like


def _start(link):
    """The link that a link continues, past reroutes; None: nothing leads there. A value cannot be given to a reroute."""
    while link is not None and not link.is_muted and link.from_node.type == "REROUTE":
        link = next(iter(link.from_node.inputs[0].links), None)
    return None if link is None or link.is_muted else link


def _ends(socket):
    """The inputs that an output leads to, past reroutes."""
    for link in socket.links:
        if link.to_node.type == "REROUTE":
            yield from _ends(link.to_node.outputs[0])
        else:
            yield link.to_socket


def _unpack(tree, group):
    inside = group.node_tree
    copies = {n.name: _copy(tree, n) for n in inside.nodes
              if n.type not in ("GROUP_INPUT", "GROUP_OUTPUT", "FRAME", "REROUTE")}
    output = next((n for n in inside.nodes if n.type == "GROUP_OUTPUT" and n.is_active_output), None)

    def connect(link, target):
        """What an inner link leads to its end, to an input outside."""
        if link.from_node.type != "GROUP_INPUT":
            source = _same(link.from_socket, copies[link.from_node.name].outputs)
            if source is not None:
                tree.links.new(source, target)
            return
        given = _same(link.from_socket, group.inputs)
        if given is not None and given.is_linked:
            tree.links.new(given.links[0].from_socket, target)
        elif given is not None:
            _give(getattr(given, "default_value", None), target)

    for link in inside.links:
        target = _same(link.to_socket, copies[link.to_node.name].inputs) if link.to_node.name in copies else None
        start = _start(link)
        if target is not None and start is not None:
            connect(start, target)
    for socket in group.outputs:
        ends = list(_ends(socket))
        last = _same(socket, output.inputs) if output else None
        for end in ends:
            if last is not None and last.is_linked:
                start = _start(last.links[0])
                if start is not None:
                    connect(start, end)
            elif last is not None:
                for link in list(end.links):
                    tree.links.remove(link)
                _give(getattr(last, "default_value", None), end)
    tree.nodes.remove(group)


def unpack_groups(tree):
    for _ in range(MOST):
        group = next((n for n in tree.nodes if n.type == "GROUP" and n.node_tree is not None), None)
        if group is None:
            return
        _unpack(tree, group)
