# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What the bridge has read of the scene, and what the picture will lack.

Translators read the scene through the ledger, which ticks what they read. What differs from a fresh datablock of its
kind, may change the picture and has no tick is a loss; so a setting that a new Blender adds is named without anyone
having thought of it. Losses of one sort are one line with the names of all that they concern.
"""
import re

import bpy

# Settings that do not affect a render: settings of viewports, editors, other renderers, and of evaluation, whose
# results are read.
UNSEEN = re.compile(
    r"(.*\.)?(name|name_full|original|preview|use_fake_user|use_extra_user|tag|library.*|asset_data|override_library|"
    r"animation_data|animation_visualization|motion_path|rna_type|bl_.*|location|width.*|height|label|parent.*|select|"
    r"use_custom_color|color_tag|warning_propagation|display.*|show_.*|hide_viewport|hide_select|hide|lock_.*|delta_.*|"
    r"rotation_.*|scale|dimensions|matrix_.*|empty_.*|use_empty_.*|field|collision|soft_body|rigid_body.*|pose.*|"
    r"track_axis|up_axis|active_.*|use_shape_key_edit_mode|lineart|use_mesh_mirror_.*|lightgroup|pass_index|"
    r"instance_.*|use_instance_.*|use_camera_lock_parent|use_grease_pencil_lights|add_rest_position_attribute|"
    r"eevee|shadow_(?!term).*|use_contact_shadow|contact_shadow_.*|falloff_.*|.*_attenuation|.*_coefficient|distance|"
    r"use_custom_distance|cutoff_distance|use_square|passepartout_.*|clip_.*|lens_unit|angle_.*|light_settings|"
    r"mist_settings|"
    r"probe_.*|sun_(threshold|angle|shadow).*|use_eevee.*|use_sun_shadow.*|use_shadow_jitter|use_soft_falloff|"
    r"diffuse_factor|specular_factor|volume_factor|session_uid|is_.*_update|users|is_embedded_data|is_missing|"
    r"node_tree|use_nodes|data|motion_steps|dicing_rate|use_.*_cull|use_multiple_importance_sampling|sampl.*|"
    r"volume_(sampling|interpolation|step.*)|homogeneous_volume|max_bounces|is_caustics_.*|tile_.*|color|"
    r"texture_mapping.*|color_mapping.*|parent_bone|use_deform_motion|use_motion_blur|ao_distance|"
    r"light_linking|composite_.*|bake.*|stereo)"
)


# Settings of a scene that change its pictures: settings of display, of film and of Cycles.
SEEN = re.compile(r"view_settings\.(?!view_transform|curve_mapping).*|render\.(film_transparent|use_freestyle)|"
                  r"cycles\.(film_exposure|use_fast_gi)")
SCENE_PARTS = ("view_settings", "render", "cycles")


def _plain(value):
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value


def _differs(a, b):
    a, b = _plain(a), _plain(b)
    if isinstance(a, float) and isinstance(b, float):
        return abs(a - b) > 1e-5 * max(1.0, abs(b))
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) != len(b) or any(_differs(x, y) for x, y in zip(a, b))
    return a != b


def _new(owner):
    """A fresh datablock of the owner's kind."""
    if isinstance(owner, bpy.types.Light):
        return bpy.data.lights.new("ods fresh", owner.type)
    if isinstance(owner, bpy.types.Object):
        return bpy.data.objects.new("ods fresh", owner.data)
    kinds = ((bpy.types.Camera, "cameras"), (bpy.types.World, "worlds"), (bpy.types.Scene, "scenes"))
    return getattr(bpy.data, next(name for kind, name in kinds if isinstance(owner, kind))).new("ods fresh")


class Ledger:
    def __init__(self):
        self._ticks = {}  # pointer: paths
        self._losses = {}  # (sentence, kind, remedy): names
        self._notes = []

    # --- reading

    def tick(self, owner, *paths):
        self.ticked(owner).update(paths)

    def read(self, owner, path, default=None):
        """The value of a setting, "dof.use_dof"; the default where this Blender has none."""
        self.tick(owner, path)
        for name in path.split("."):
            owner = getattr(owner, name, None)
            if owner is None:
                return default
        return owner

    def ticked(self, owner):
        return self._ticks.setdefault(owner.as_pointer(), set())

    @staticmethod
    def differs(socket, usual):
        """Whether an input has another value than a fresh one."""
        return hasattr(socket, "default_value") and _differs(socket.default_value, usual.default_value)

    def changed(self, owner, fresh, prefix=""):
        """The settings without a tick that differ: their paths and Blender's own words for them."""
        found = []
        for prop in owner.bl_rna.properties:
            path = prefix + prop.identifier
            is_part = not isinstance(owner, bpy.types.Scene) or path in SCENE_PARTS
            if prop.type == "COLLECTION" or not is_part or (UNSEEN.fullmatch(path) and not SEEN.fullmatch(path)):
                continue
            value, usual = getattr(owner, prop.identifier, None), getattr(fresh, prop.identifier, None)
            if prop.type == "POINTER" and value is not None and not isinstance(value, bpy.types.ID):
                if usual is not None and prefix.count(".") < 1:
                    found += self.changed(value, usual, path + ".")
            elif (not prop.is_readonly or prop.type == "POINTER") and _differs(value, usual):
                found.append((path, prop.name))
        return found if prefix else [(path, words) for path, words in found if path not in self.ticked(owner)]

    # --- losing

    def lose(self, sentence, kind, name, remedy=""):
        """sentence: what becomes of it, without its name; remedy: what to try."""
        names = self._losses.setdefault((sentence, kind, remedy), [])
        if name not in names:
            names.append(name)

    def say(self, text):
        """A loss of the whole scene."""
        if text not in self._notes:
            self._notes.append(text)

    def close(self, kind, owners):
        """Whatever is set on these datablocks and has no tick is lost."""
        fresh = {}
        for owner in owners:
            sort = (type(owner), getattr(owner, "type", None))
            if sort not in fresh:
                fresh[sort] = _new(owner)
            for path, words in self.changed(owner, fresh[sort]):
                if kind == "scene" and not SEEN.fullmatch(path):
                    continue
                self.lose(f"the setting '{words}' does not come across", kind, owner.name)
        if fresh:
            bpy.data.batch_remove(list(fresh.values()))

    def lines(self):
        return self._notes + [_line(*key, names) for key, names in self._losses.items()]


def _line(sentence, kind, remedy, names):
    many = len(names) > 1
    count = f"{len(names)} " if len(names) > 4 else ""
    return f"{sentence}: {count}{kind}{'s' if many else ''} {some(names)}" + (f"; {remedy}" if remedy else "")


def some(names, most=4):
    """ 'a', 'b' and 3 more """
    names = [f"'{name}'" for name in names]
    if len(names) <= most:
        return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]
    return ", ".join(names[:most]) + f" and {len(names) - most} more"
