#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# shaders.sh SOURCE GLSLANG BUILD: compiles ods/render/gpu/shaders for Vulkan 1.2, and writes them as C++ for
# ods/render/gpu/shaders.h.
set -eu
cd "$1"
glslang=$2
build=$3
made=$build/gpu_shaders.cpp

{
  echo '// Made by cmake/shaders.sh.'
  echo '#include "ods/render/gpu/shaders.h"'
  echo 'namespace {'
} >"$made.tmp"
for stage in trace begin shade; do
  "$glslang" -V --target-env vulkan1.2 -I. --vn "k_$stage" "ods/render/gpu/shaders/$stage.comp" -o "$made.words" \
    >"$made.log" || {
    cat "$made.log" >&2
    exit 1
  }
  grep -v '#pragma' "$made.words" >>"$made.tmp"
done
{
  echo '}  // namespace'
  for stage in trace begin shade; do
    echo "std::span<const uint32_t> ods::${stage}_shader() { return k_$stage; }"
  done
} >>"$made.tmp"
mv "$made.tmp" "$made"
rm -f "$made.words" "$made.log"
