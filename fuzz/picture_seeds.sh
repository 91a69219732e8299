#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Small pictures as written by cameras, as seeds of the fuzzers: fuzz/picture_seeds.sh build/release/ods FOLDER
# Needs heif-enc (libheif-examples).
set -eu
ods=$(realpath "$1")
mkdir -p "$2/heif" "$2/photo"
cd "$2"
"$ods" render furnace --width 64 --samples 1 -o eyes.png --layout separate --mono 2>/dev/null ||
  "$ods" render furnace --width 64 --samples 1 -o eyes.png --eyes mono
"$ods" render furnace --width 32 --samples 1 -o photo/cardboard.vr.jpg
"$ods" render furnace --width 32 --samples 1 --projection vr180 -o photo/vr180.vr.jpg
heif-enc -q 40 eyes.png -o heif/one.heic
heif-enc -q 40 eyes.png eyes.png -o heif/two.heic
heif-enc -q 40 -A eyes.png -o heif/one.avif || echo "this heif-enc writes no AVIF" >&2
heif-enc -q 40 -b 10 eyes.png -o heif/ten.heic || echo "this heif-enc writes no 10 bits" >&2
rm eyes.png
