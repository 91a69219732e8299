#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# test.sh COMPILER LIBRARY PROGRAM FOLDER: COMPILER's render_digest, built in FOLDER on top of LIBRARY, prints what PROGRAM,
# the one of this build, prints.
set -eu
compiler=$1 library=$2 program=$3 folder=$4
if [ ! -x "$compiler" ]; then
  echo "skipped: there is no second compiler here (clang++ or g++)"
  exit
fi
cmake -S "$(dirname "$0")" -B "$folder" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
  -DLIBRARY="$library"
cmake --build "$folder"
ours=$("$program")
theirs=$("$folder/render_digest")
[ "$ours" = "$theirs" ] || { echo "this build's picture is $ours, $compiler's is $theirs"; exit 1; }
