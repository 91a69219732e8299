#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes docs/images/denoise.jpg: part of the room's left eye, with 16 samples and denoised. Needs oiiotool. Run it in the
# repository's root after building; it takes some minutes.
set -e
ods=build/release/ods
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$ods" render room --width 1536 --samples 16 --statistics -o "$work/noisy.exr"
"$ods" denoise "$work/noisy.exr" -o "$work/clean.exr"
for each in noisy clean; do
  "$ods" convert "$work/$each.exr" -o "$work/$each.png" --exposure 0.3
done
oiiotool "$work/noisy.png" --cut 420x360+530+250 "$work/clean.png" --cut 420x360+530+250 --mosaic:pad=4 2x1 \
  --compression jpeg:86 -o docs/images/denoise.jpg
