# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Datablocks of other files, made the scene's own: what follows changes them."""
import bpy

KINDS = ("objects", "meshes", "curves", "metaballs", "armatures", "lights", "cameras", "materials", "node_groups",
         "worlds", "images", "particles", "collections", "textures", "actions", "shape_keys")


def make_local():
    for kind in KINDS:
        for each in list(getattr(bpy.data, kind, ())):
            if each.library is not None:
                try:
                    each.make_local()
                except (RuntimeError, ReferenceError):
                    pass  # of a kind that only its owner makes local
