# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Opens a file in Blender: a .blend, or one that Blender imports."""
import ctypes
import gzip
import os
import zlib

import bpy

from .ledger import some
from .report import Failure


def repair_numpy():
    """Some versions of Blender call names that newer versions of NumPy lack."""
    import numpy

    for name, kind in (("bool", bool), ("int", int), ("float", float), ("object", object)):
        if name not in numpy.__dict__:
            setattr(numpy, name, kind)


class _Buffer(ctypes.Structure):
    """ZSTD_inBuffer and ZSTD_outBuffer."""

    _fields_ = [("start", ctypes.c_char_p), ("size", ctypes.c_size_t), ("at", ctypes.c_size_t)]


def _unpacked(start, most):
    """The first bytes of what Zstandard has packed; Blender's Python has no module for that. Empty: no library."""
    try:
        zstd = ctypes.CDLL("libzstd.so.1")
    except OSError:
        return b""
    zstd.ZSTD_createDStream.restype = ctypes.c_void_p
    stream, space = ctypes.c_void_p(zstd.ZSTD_createDStream()), ctypes.create_string_buffer(most)
    source, result = _Buffer(start, len(start), 0), _Buffer(ctypes.cast(space, ctypes.c_char_p), most, 0)
    zstd.ZSTD_decompressStream(stream, ctypes.byref(result), ctypes.byref(source))
    zstd.ZSTD_freeDStream(stream)
    return space.raw[:result.at]


def _start_of(path):
    """The first bytes of a file, packed or not."""
    with open(path, "rb") as file:
        start = file.read(1 << 18)  # a block of Zstandard has half of that at most
    if start.startswith(b"\x28\xb5\x2f\xfd"):
        return _unpacked(start, 17)
    if start.startswith(b"\x1f\x8b"):
        with gzip.open(path) as file:
            return file.read(17)
    return start[:17]


def _version_of(path):
    """Of the Blender that saved a file, by its first bytes; (0, 0): they do not tell."""
    try:
        start = _start_of(path)
    except (EOFError, zlib.error):
        return (0, 0)
    # BLENDER-v304, and from 5.0 on BLENDER17-01v0500.
    digits = start[13:17] if start[7:9].isdigit() else start[9:12]
    return divmod(int(digits), 100) if start.startswith(b"BLENDER") and digits.isdigit() else (0, 0)


def _refuse_newer(made):
    """Of a newer minor version, Blender opens a file and leaves out what it does not know."""
    own = bpy.app.version
    if made[0] > own[0]:
        raise Failure(f"it was saved by Blender {made[0]}.{made[1]}, and this is {own[0]}.{own[1]}: "
                      "give a newer one with --blender PATH")


def _open_blend(path):
    try:
        _refuse_newer(_version_of(path))  # Blender 3.4 crashes when it opens a file of 4.3
        bpy.ops.wm.open_mainfile(filepath=path, load_ui=False, use_scripts=False)
    except (OSError, RuntimeError) as error:
        raise Failure(f"Blender cannot open it: {one_line(error)}") from None
    _refuse_newer(bpy.data.version)


def one_line(error):
    """The first line, or of an add-on's traceback the error at its end."""
    lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Location:")]
    if not lines:
        return type(error).__name__
    return lines[-1 if "Traceback" in lines[0] else 0].removeprefix("Error: ").strip()


def _importers(kind):
    """In the order in which they are tried: their names and options."""
    return {
        ".fbx": [("import_scene.fbx", {})],
        ".obj": [("wm.obj_import", {}), ("import_scene.obj", {})],
        ".dae": [("wm.collada_import", {})],
        ".ply": [("wm.ply_import", {}), ("import_mesh.ply", {})],
        ".stl": [("wm.stl_import", {}), ("import_mesh.stl", {})],
        ".abc": [("wm.alembic_import", {"as_background_job": False})],
    }.get(kind, [("wm.usd_import", {})])


def _import(path):
    kind = os.path.splitext(path)[1].lower()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for name, options in _importers(kind):
        group, operator = name.split(".")
        call = getattr(getattr(bpy.ops, group), operator)
        try:
            call.get_rna_type()
        except (KeyError, AttributeError):
            continue
        try:
            result = call(filepath=path, **options)
        except Exception as error:  # an add-on's own errors are of any kind
            raise Failure(f"Blender cannot read it: {one_line(error)}") from None
        if "FINISHED" not in result or not bpy.data.objects:
            raise Failure("Blender finds nothing in it")
        return
    raise Failure(f"this Blender does not read {kind} files")


def _choose_scene(context, name):
    """Shows a scene of the file, by its name or its number: the active one is 0."""
    scenes = sorted(bpy.data.scenes, key=lambda s: s != context.scene)
    if not name:
        return
    chosen = bpy.data.scenes.get(name) or (scenes[int(name)] if name.isdigit() and int(name) < len(scenes) else None)
    if chosen is None:
        raise Failure(f"--scene: it has no scene '{name}', only {some([s.name for s in scenes], 20)}")
    context.window.scene = chosen


def open_scene(path, name):
    """name: of one of its scenes, or its number; empty: the active one."""
    if path.lower().endswith(".blend"):
        _open_blend(path)
    else:
        _import(path)
    _choose_scene(bpy.context, name)
