#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# shaders.sh SOURCE GLSLANG BUILD: compiles ods/render/gpu/shaders for Vulkan 1.2, and writes them as C++ for
# ods/render/gpu/shaders.h. Those that see materials are compiled twice: for plain scenes, and for all.
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
# compile STAGE NAME [OPTION]: adds the words of a stage as k_NAME.
compile() {
  "$glslang" -V --target-env vulkan1.2 -I. ${3:+"$3"} --vn "k_$2" "ods/render/gpu/shaders/$1.comp" -o "$made.words" \
    >"$made.log" || {
    cat "$made.log" >&2
    exit 1
  }
  grep -v '#pragma' "$made.words" >>"$made.tmp"
}
compile begin begin
compile trace trace
compile shade shade
compile trace trace_whole -DODS_WHOLE
compile shade shade_whole -DODS_WHOLE
cat >>"$made.tmp" <<'END'
}  // namespace
ods::GpuShaders ods::gpu_shaders(bool whole) {
  if (whole) return {k_begin, k_trace_whole, k_shade_whole};
  return {k_begin, k_trace, k_shade};
}
END
mv "$made.tmp" "$made"
rm -f "$made.words" "$made.log"
