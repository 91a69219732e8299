#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes docs/images/projections.jpg, layouts.jpg, merges.jpg, poles.jpg, eyes.jpg and testcard.jpg, or one of them:
#   docs/camera_sheet.sh projections
# Needs build/release/ods and oiiotool.
set -eu
cd "$(dirname "$0")/.."
ods=build/release/ods
count=10
only=${1:-}
parts=$(mktemp -d)
trap 'rm -rf "$parts"' EXIT

# The sheet that follows is wanted.
begin() {
  wanted=no
  if [ -z "$only" ] || [ "$only" = "$1" ]; then wanted=yes; fi
}

# tile NAME OPTION...: the axis scene seen so, fitted into a box with its name below.
tile() {
  [ $wanted = yes ] || return 0
  name=$1
  shift
  count=$((count + 1))
  "$ods" render axis --quiet --samples 24 -o "$parts/raw.png" "$@" > /dev/null
  oiiotool "$parts/raw.png" --ch R,G,B --fit:pad=1 320x240 --cut 320x268+0+0 \
    --text:x=160:y=262:size=17:xalign=center:color=1,1,1:font=DejaVuSans.ttf "$name" -d uint8 -o "$parts/tile-$(printf %02d $count).png"
}

# sheet COLUMNSxROWS FILE
sheet() {
  [ $wanted = yes ] || return 0
  oiiotool "$parts"/tile-*.png --mosaic:pad=8 "$1" --compression jpeg:90 -d uint8 -o "docs/images/$2"
  rm "$parts"/tile-*.png
}

begin projections
for name in $("$ods" render room --projection unknown 2>&1 | sed -n 's/.* is one of \(.*\), not .*/\1/p' | tr -d ,); do
  width=480
  [ $name = cube-1x6 ] && width=120
  tile $name --eyes left --projection $name --width $width
done
tile "--range -60,60,-30,45" --eyes left --range -60,60,-30,45 --width 480
sheet 4x4 projections.jpg

begin layouts
for name in top-bottom bottom-top side-by-side cross-eyed top-bottom-half side-by-side-half row-interleaved \
  column-interleaved checkerboard anaglyph anaglyph-half anaglyph-dubois; do
  tile $name --layout $name --width 480
done
tile "--eyes left" --eyes left --width 480
tile "--eyes mono" --eyes mono --width 480
sheet 5x3 layouts.jpg

begin merges
# Straight down at the floor's grid, where a merge shows most: red-cyan, with eyes far apart.
for merge in none linear,30,90 cosine,30,90 cosine,0,90,0.2 smoothstep,30,90 smootherstep,30,90 gaussian,0,90 power,0,90,10 \
  tilt-brush,0,72; do
  tile "$merge" --layout anaglyph --projection fisheye --lens-direction 0,-90 --ipd 0.4 --merge "$merge" --width 320
done
sheet 3x3 merges.jpg

begin poles
# The room's floor below the viewer.
for merge in none cosine,60,90; do
  [ $wanted = yes ] || continue
  count=$((count + 1))
  "$ods" render room --quiet --samples 96 -o "$parts/raw.png" --layout anaglyph --projection fisheye --fov 100 --lens-direction 0,-90 --ipd 0.2 \
    --merge "$merge" --width 400 > /dev/null
  oiiotool "$parts/raw.png" --ch R,G,B --cut 400x428+0+0 --text:x=200:y=422:size=17:xalign=center:color=1,1,1:font=DejaVuSans.ttf \
    "--merge $merge" -d uint8 -o "$parts/tile-$(printf %02d $count).png"
done
sheet 2x1 poles.jpg

begin eyes
# Ahead and a little down, red-cyan, eyes 20 cm apart where nothing else is said.
window="--merge none --layout anaglyph --projection perspective --fov 80 --lens-direction 0,-15 --width 320"
tile "--ipd 0.2" $window --ipd 0.2
tile "--ipd 0.065" $window --ipd 0.065
tile "--convergence toe-in,3" $window --ipd 0.2 --convergence toe-in,3
tile "--convergence shift,3" $window --ipd 0.2 --convergence shift,3
tile "--eye-to-neck 0.8" $window --ipd 0.2 --eye-to-neck 0.8
tile "--roll 20" $window --ipd 0.2 --roll 20
tile "--roll 20 --axis world" $window --ipd 0.2 --roll 20 --axis world
tile "--lens 0.15,2" $window --ipd 0.2 --lens 0.15,2
tile "--left-handed" $window --ipd 0.2 --left-handed
down="--layout anaglyph --projection fisheye --lens-direction 0,-90 --width 320"
tile "--camera-preset povray" $down --camera-preset povray:odsIPD=0.4
tile "--camera-preset ospray" $down --camera-preset ospray:interpupillaryDistance=0.4
tile "--camera-preset cycles:use_pole_merge=1" $down --camera-preset cycles:interocular_distance=0.4,convergence_mode=PARALLEL,use_pole_merge=1
sheet 4x3 eyes.jpg

begin testcard
# What one sees ahead and straight up, of each eye.
for look in 0,0 0,90; do
  for eye in left right; do
    [ $wanted = yes ] || continue
    "$ods" testcard --quiet -o "$parts/tile-$look-$eye.png" --eyes $eye --projection perspective --fov 84 --lens-direction $look --width 560 > /dev/null
  done
done
sheet 2x2 testcard.jpg
