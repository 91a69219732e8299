#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes docs/images/kinds.jpg: scenes of sixteen kinds, rendered with no option but their size and their number of
# samples; the left eye of each. Needs build/release/ods, build/release/kinds_of_scene and oiiotool. Takes some minutes.
set -eu
cd "$(dirname "$0")/.."
build=build/release
work=${1:-$(mktemp -d)}
"$build/kinds_of_scene" "$work"
count=10
for name in chair ring lighthouse still-life glasses asteroids hills far-courtyard neon-street room-with-lamps \
  room-without-a-lamp small-window baked-room tiny-room huge-room cave; do
  count=$((count + 1))
  samples=16
  case $name in room-with-lamps | small-window) samples=64 ;; esac
  "$build/ods" render "$work/$name.glb" -o "$work/$name.png" --width 512 --samples $samples
  caption=$(echo "$name" | tr - ' ')
  oiiotool "$work/$name.png" --cut 512x256+0+0 --resize 448x224 --cut 448x246+0+0 \
    --text:x=224:y=240:size=15:xalign=center:color=1,1,1:font=DejaVuSans.ttf "$caption" -d uint8 -o "$work/tile-$count.png"
done
oiiotool "$work"/tile-*.png --mosaic:pad=6 4x4 --compression jpeg:86 -d uint8 -o docs/images/kinds.jpg
