#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# test.sh SOURCE GLSLANG SPIRV-VAL: the kernel is valid Vulkan GLSL, the whole of it in pipelines for ray tracing, and
# what graphics cards render in compute shaders.
set -eu
cd "$1"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for shader in tests/glsl/*.rgen tests/glsl/*.rahit ods/render/gpu/shaders/*.comp; do
  "$2" -V --target-env vulkan1.2 -I. -Itests/glsl "$shader" -o "$folder/spirv"
  "$3" --target-env vulkan1.2 --scalar-block-layout "$folder/spirv"
done
