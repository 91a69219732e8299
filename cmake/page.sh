#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# page.sh SOURCE COMPILER OUTPUT: writes the files of web/ as C++, for ods/view/page.h. Shaders include the kernel;
# WebGL has no #include, so a C preprocessor comes first, the version line is added before its result, and spaces that
# GLSL does not need are left out.
set -eu
cd "$1"
compiler=$2
output=$3

contents() {
  case $1 in
    *.frag | *.vert)
      echo '#version 300 es'
      "$compiler" -E -P -x c -I. "$1" | sed -E 's/^ +//; s/ *([-+*/=<>!&|?:,;(){}]) */\1/g'
      ;;
    *) cat "$1" ;;
  esac
}

{
  printf '// Made from web/ by cmake/page.sh.\n#include "ods/view/page.h"\nnamespace {\n'
  for file in web/*; do
    printf 'const unsigned char k%s[] = {\n' "$(basename "$file" | tr -c 'a-zA-Z0-9\n' _)"
    contents "$file" | od -An -v -tx1 | sed 's/ \(..\)/0x\1,/g'
    printf '};\n'
  done
  printf 'template <size_t kSize>\nstd::string_view text(const unsigned char (&bytes)[kSize]) {\n'
  printf '  return {reinterpret_cast<const char*>(bytes), kSize};\n}\n}  // namespace\n'
  printf 'std::span<const ods::PageFile> ods::page_files() {\n  static const PageFile kFiles[] = {\n'
  for file in web/*; do
    name=$(basename "$file")
    printf '    {"%s", text(k%s)},\n' "$name" "$(echo "$name" | tr -c 'a-zA-Z0-9\n' _)"
  done
  printf '  };\n  return kFiles;\n}\n'
} >"$output"
