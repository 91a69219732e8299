#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes docs/images/comfort.jpg and comfort-merged.jpg: what strains in the built-in room, without a merge and with --merge
# auto. Needs build/release/ods and oiiotool.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
ods="$here/build/release/ods"
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$work"
show() {
  "$ods" comfort "$1" --heat heat_360_TB.png >report.txt 2>&1 || head -1 report.txt
  oiiotool heat_360_TB.png --crop 768x384+0+0 --fullpixels --compression jpeg:84 -o "$here/docs/images/$2"
}
"$ods" render room --width 768 --samples "${SAMPLES:-32}" --indirect cache --denoise own --merge none -q -o picture.exr
"$ods" convert picture.exr --merge auto --sidecar -q -o merged.exr
show picture.exr comfort.jpg
show merged.exr comfort-merged.jpg
