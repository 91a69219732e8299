#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# page.sh SOURCE COMPILER BUILD: writes files as C++, those of web/ for ods/view/page.h and those of blender/ for
# cli/bridge/bridge_files.h, and the add-on for Blender as an archive. Shaders include the kernel; WebGL has no #include,
# so a C preprocessor comes first, the version line is added before its result, and spaces that GLSL does not need are
# left out, as are comments, indentation and empty lines in scripts and styles; the example is for people.
set -eu
cd "$1"
compiler=$2
build=$3

contents() {
  case $1 in
    *.frag | *.glsl)
      echo '#version 300 es'
      "$compiler" -E -P -x c -I. "$1" | sed -E 's/^ +//; s/^%/#/; s/ *([-+*/=<>!&|?:,;(){}]) */\1/g'
      ;;
    web/*.js) sed -E '/^ *\/\//d; s/^ +//; s, // [^`'"'"'"]*$,,; /^$/d' "$1" ;;
    web/example.css) cat "$1" ;;
    *.css) sed -zE 's,/\*[^*]*\*+([^/*][^*]*\*+)*/,,g; s/\n +/\n/g; s/\n+/\n/g; s/([:;,]|\{)\s+/\1/g; s/ \{/{/g; s/;\}/}/g' "$1" ;;
    *) cat "$1" ;;
  esac
}

# files_as FOLDER HEADER TYPE FUNCTION: the files in a folder as an array of that type.
files_as() {
  files=$(find "$1" -type f ! -name '*.pyc' ! -path 'web/package/*' | LC_ALL=C sort)
  printf '// Made from %s/ by cmake/page.sh.\n#include "%s"\nnamespace {\n' "$1" "$2"
  for file in $files; do
    printf 'const unsigned char k_%s[] = {\n' "$(echo "$file" | tr -c 'a-zA-Z0-9\n' _)"
    contents "$file" | od -An -v -tx1 | sed 's/ \(..\)/0x\1,/g'
    printf '};\n'
  done
  printf 'template <size_t kSize>\nstd::string_view text(const unsigned char (&bytes)[kSize]) {\n'
  printf '  return {reinterpret_cast<const char*>(bytes), kSize};\n}\n}  // namespace\n'
  printf 'std::span<const %s> %s() {\n  static const %s kFiles[] = {\n' "$3" "$4" "$3"
  for file in $files; do
    printf '    {"%s", text(k_%s)},\n' "${file#"$1"/}" "$(echo "$file" | tr -c 'a-zA-Z0-9\n' _)"
  done
  printf '  };\n  return kFiles;\n}\n'
}

files_as web ods/view/page.h ods::PageFile ods::page_files >"$build/page_files.cpp"
files_as blender cli/bridge/bridge_files.h BridgeFile bridge_files >"$build/bridge_files.cpp"
cd blender
cmake -E tar cf "$build/omnistereo_blender.zip" --format=zip omnistereo
