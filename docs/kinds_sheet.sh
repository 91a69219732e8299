#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes docs/images/kinds.jpg: scenes of sixteen kinds, each as the left eye sees it in a view of 90 x 90 degrees,
# without any option that changes the viewer's place, the light or the exposure. Needs build/release/ods,
# build/release/kinds_of_scene (cmake --build build/release --target kinds_of_scene) and oiiotool. Takes about ten minutes.
#   docs/kinds_sheet.sh [FOLDER [NAME...]]: renders only these again, for the others takes the pictures in the folder
set -eu
cd "$(dirname "$0")/.."
build=build/release
work=${1:-$(mktemp -d)}
[ $# -eq 0 ] || shift
mkdir -p "$work"
"$build/kinds_of_scene" "$work"
count=10
for name in chair ring lighthouse still-life glasses asteroids hills far-courtyard neon-street room-with-lamps \
  room-without-a-lamp small-window baked-room tiny-room huge-room cave; do
  count=$((count + 1))
  wanted=no
  [ $# -eq 0 ] && wanted=yes
  for only in "$@"; do [ "$only" = $name ] && wanted=yes; done
  if [ $wanted = yes ]; then
    "$build/ods" render "$work/$name.glb" -o "$work/$name.png" --eyes left --projection perspective --fov 90 \
      --width 576 --height 576 --samples 64
  fi
  caption=$(echo "$name" | tr - ' ')
  oiiotool "$work/$name.png" --resize 360x360 --cut 360x384+0+0 \
    --text:x=180:y=377:size=15:xalign=center:color=1,1,1:font=DejaVuSans.ttf "$caption" -d uint8 -o "$work/tile-$count.png"
done
oiiotool "$work"/tile-*.png --mosaic:pad=6 4x4 --compression jpeg:84 -d uint8 -o docs/images/kinds.jpg
