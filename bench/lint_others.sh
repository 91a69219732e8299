#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Correct stereo pictures by other renderers, for lint_bench --others: a yard and a hall by POV-Ray, from slits, and by
# Blender's Cycles, with its own stereo panorama and few samples. Existing pictures are kept.
#
#   bench/lint_others.sh build/release/ods FOLDER
set -eu
ods=$(realpath "$1")
mkdir -p "$2"
cd "$2"

pov_scene() {  # yard or hall
  cat <<'POV'
# version 3.7;
global_settings { assumed_gamma 1 }
# declare R = seed(7);
# declare Stone = texture { pigment { granite scale 0.7 color_map { [0 rgb <.35,.3,.25>] [1 rgb <.8,.75,.65>] } }
  normal { granite 0.3 scale 0.3 } finish { diffuse 0.8 ambient 0.05 specular 0.1 } }
# declare Tiles = texture { pigment { checker rgb <.55,.5,.45> rgb <.25,.2,.2> scale 0.5 }
  finish { diffuse 0.8 ambient 0.05 reflection 0.08 } }
POV
  if [ "$1" = yard ]; then
    cat <<'POV'
sky_sphere { pigment { gradient y color_map { [0 rgb <.7,.8,.9>] [1 rgb <.15,.3,.7>] } }
  pigment { bozo turbulence 0.6 scale <.4,.15,.4> color_map { [0.5 rgbt 1] [0.9 rgb 0.95] } } }
light_source { <40, 60, -30> rgb <1.3, 1.2, 1.0> }
plane { y, 0 texture { pigment { bozo turbulence 0.5 scale 0.4 color_map { [0 rgb <.1,.2,.05>] [1 rgb <.3,.35,.12>] } }
  finish { diffuse 0.8 ambient 0.05 } } }
# for (I, 1, 40)
  # local A = 2 * pi * rand(R); #local D = 1.6 + 8 * rand(R); #local H = 0.5 + 3 * rand(R);
  union {
    cylinder { 0, y * H, 0.1 texture { Stone } }
    sphere { y * H, 0.3 + 0.3 * rand(R) texture { pigment { bozo scale 0.15 color_map {
      [0 rgb <.05,.2,.05>] [1 rgb <.4,.5,.1>] } } normal { bumps 0.8 scale 0.1 } finish { diffuse 0.8 ambient 0.05 } } }
    translate <D * sin(A), 0, D * cos(A)>
  }
# end
POV
  else
    cat <<'POV'
light_source { <1.5, 2.6, 1> rgb 0.8 fade_distance 3 fade_power 2 }
light_source { <-1.5, 2.4, -1.5> rgb <.9,.8,.6> fade_distance 3 fade_power 2 }
box { <-3, 0, -4>, <3.5, 3, 3.2> hollow texture { Stone } }
box { <-3, -0.1, -4>, <3.5, 0.001, 3.2> texture { Tiles } }
# for (I, 0, 11)
  cylinder { <2.4 * sin(I * pi / 6 + 0.2), 0, 2.4 * cos(I * pi / 6 + 0.2)>,
    <2.4 * sin(I * pi / 6 + 0.2), 3, 2.4 * cos(I * pi / 6 + 0.2)>, 0.12 texture { Tiles scale 0.3 } }
# end
# for (I, 1, 20)
  sphere { <3 * rand(R) - 1.5, 0.15, 3 * rand(R) - 1.5>, 0.15
    pigment { rgb <rand(R), rand(R), rand(R)> } finish { diffuse 0.7 ambient 0.05 reflection 0.2 specular 0.6 } }
# end
POV
  fi
  echo '#include "rig.povray.inc"'
}

by_povray() {
  mkdir -p "pov-$1/views"
  pov_scene "$1" >"pov-$1/scene.pov"
  (
    cd "pov-$1"
    "$ods" rig --width 1024 --slits 48 --position 0,1.6,0 -o rig.json --for povray
    povray rig.povray.ini +Iscene.pov +A0.2
    "$ods" stitch rig.json 'views/view####.exr' -o ../"POV-Ray-$1_360_TB.png"
  ) >"pov-$1.log" 2>&1 </dev/null
  rm -r "pov-$1"
}

blender_scene() {
  cat <<'PY'
import bpy, random, sys
from math import cos, sin, pi
random.seed(7)
is_yard = "yard" in sys.argv
bpy.ops.object.select_all(action='SELECT')
bpy.ops.object.delete()

def material(low, high, scale, kind='ShaderNodeTexNoise'):
    made = bpy.data.materials.new('m')
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    texture, place = nodes.new(kind), nodes.new('ShaderNodeTexCoord')
    ramp = nodes.new('ShaderNodeMixRGB')
    texture.inputs['Scale'].default_value = scale
    ramp.inputs[1].default_value, ramp.inputs[2].default_value = (*low, 1), (*high, 1)
    links.new(place.outputs['Object'], texture.inputs['Vector'])
    links.new(texture.outputs['Fac'], ramp.inputs[0])
    links.new(ramp.outputs[0], nodes['Principled BSDF'].inputs['Base Color'])
    return made

def put(shape, place, size, its_material, turn=0):
    getattr(bpy.ops.mesh, 'primitive_' + shape + '_add')(location=place, rotation=(0, 0, turn))
    bpy.context.object.scale = size
    bpy.context.object.data.materials.append(its_material)

stone = material((.3, .25, .2), (.8, .75, .65), 6)
tiles = material((.55, .5, .45), (.2, .18, .18), 2, 'ShaderNodeTexChecker')
leaves = material((.03, .12, .03), (.35, .45, .1), 9)
world = bpy.data.worlds.new('world')
world.use_nodes = True
bpy.context.scene.world = world
background = world.node_tree.nodes['Background']
if is_yard:
    sky = world.node_tree.nodes.new('ShaderNodeTexSky')
    sky.sun_elevation = 0.7
    background.inputs['Strength'].default_value = 0.15
    world.node_tree.links.new(sky.outputs[0], background.inputs['Color'])
    put('plane', (0, 0, 0), (60, 60, 1), leaves)
    for i in range(40):
        a, d, h = 2 * pi * random.random(), 1.6 + 8 * random.random(), 0.5 + 3 * random.random()
        put('cube', (d * sin(a), d * cos(a), h / 2), (0.08, 0.08, h / 2), stone, a)
        put('monkey', (d * sin(a), d * cos(a), h), (0.4, 0.4, 0.4), leaves, 3 * a)
else:
    background.inputs['Strength'].default_value = 0.05
    put('cube', (0.2, -0.4, 1.5), (3.2, 3.6, 1.5), stone)
    put('plane', (0.2, -0.4, 0.001), (3.2, 3.6, 1), tiles)
    for i in range(12):
        put('cylinder', (2.4 * sin(i * pi / 6 + 0.2), 2.4 * cos(i * pi / 6 + 0.2), 1.5), (0.12, 0.12, 1.5), tiles)
    for i in range(20):
        put('uv_sphere', (3 * random.random() - 1.5, 3 * random.random() - 1.5, 0.15), (0.15, 0.15, 0.15), stone)
    for place in ((1.5, 1, 2.5), (-1.5, -1.5, 2.3)):
        bpy.ops.object.light_add(type='POINT', location=place)
        bpy.context.object.data.energy = 100
PY
}

by_cycles() {
  {
    blender_scene
    "$ods" camera --for blender --merge cosine,60,90 --position 0,1.6,0 --width 1024
    printf '%s\n' "scene.cycles.samples = 24" "scene.cycles.use_denoising = False" "scene.cycles.max_bounces = 3" \
      "image.file_format = 'PNG'" "scene.render.filepath = '$(pwd)/Cycles-$1_360_TB.png'" \
      "bpy.ops.render.render(write_still=True)"
  } >"cycles-$1.py"
  blender -b --factory-startup --python-exit-code 1 -P "cycles-$1.py" -- "$1" >"cycles-$1.log" 2>&1 </dev/null
}

for scene in yard hall; do
  for each in "POV-Ray povray by_povray" "Cycles blender by_cycles"; do
    # shellcheck disable=SC2086  # three words
    set -- $each
    if [ -f "$1-${scene}_360_TB.png" ]; then continue; fi
    if ! command -v "$2" >/dev/null; then
      echo "$2 is not installed: no $scene by $1" >&2
      continue
    fi
    "$3" "$scene"
  done
done
