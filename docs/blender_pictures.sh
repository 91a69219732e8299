#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes docs/images/blender.jpg and docs/images/blender-cycles.jpg: a scene that a script builds in Blender, rendered
# from its .blend without an option that changes its light, its camera or its exposure, and the left eye's view beside
# Cycles' own, with the scene's settings but for more samples. Needs build/release/ods, Blender and oiiotool; takes about ten minutes.
#   docs/blender_pictures.sh INTERIOR.PY [FOLDER]: what is in the folder already is not rendered again
set -eu
interior=$(realpath "$1")
cd "$(dirname "$0")/.."
ods=$(realpath build/release/ods)
work=${2:-$(mktemp -d)}
[ -e "$work/interior.blend" ] || (cd "$work" && blender -b --factory-startup --python-exit-code 1 -P "$interior")
[ -e "$work/interior_360_TB.png" ] || "$ods" render "$work/interior.blend" --width 768 -o "$work/interior_360_TB.png"
[ -e "$work/cycles.png" ] || blender -b "$work/interior.blend" --python-exit-code 1 --python-expr "
import bpy
scene = bpy.context.scene
render = scene.render
render.resolution_percentage = 75
render.views['right'].use = False
render.use_border = render.use_crop_to_border = True
render.border_min_x, render.border_max_x = 290 / 768, 690 / 768
render.border_min_y, render.border_max_y = 64 / 384, 284 / 384
scene.cycles.samples = 256
render.filepath = '$work/cycles.png'
bpy.ops.render.render(write_still=True)"
[ -e "$work/cycles.png" ] || mv "$work/cycles_L.png" "$work/cycles.png"
oiiotool "$work/interior_360_TB.png" --compression jpeg:84 -o docs/images/blender.jpg
oiiotool "$work/cycles.png" --ch R,G,B "$work/interior_360_TB.png" --ch R,G,B --cut 400x220+290+100 \
  --mosaic:pad=6 2x1 --compression jpeg:86 -o docs/images/blender-cycles.jpg
