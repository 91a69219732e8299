# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What `ods blender` runs inside Blender: install.py -- PROGRAM. Installs and enables the add-on that this file is in."""
import os
import sys
import tempfile
import traceback
import zipfile

import bpy

OURS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def say(word, text):
    sys.stderr.write(f"ods-bridge {word} {text}\n")
    sys.stderr.flush()


def archive(path):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for folder, _, names in os.walk(OURS):
            for name in sorted(names):
                if name.endswith((".py", ".toml")):
                    full = os.path.join(folder, name)
                    file.write(full, os.path.join("omnistereo", os.path.relpath(full, OURS)))


def install(program):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "omnistereo.zip")
        archive(path)
        if bpy.app.version >= (4, 2, 0):
            bpy.ops.extensions.package_install_files(filepath=path, repo="user_default", enable_on_install=True)
            module = "bl_ext.user_default.omnistereo"
        else:
            bpy.ops.preferences.addon_install(filepath=path, overwrite=True)
            module = "omnistereo"
            bpy.ops.preferences.addon_enable(module=module)
    if module not in bpy.context.preferences.addons:
        raise RuntimeError("Blender did not enable the add-on")
    bpy.context.preferences.addons[module].preferences.program = program
    bpy.ops.wm.save_userpref()


code = 0
try:
    install(sys.argv[sys.argv.index("--") + 1])
    say("done", 1)
except BaseException as error:
    traceback.print_exc()
    say("error", f"Blender did not take the add-on: {error}")
    code = 3
os._exit(code)
