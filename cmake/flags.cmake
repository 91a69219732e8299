# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# The flags for compiling everything here.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
find_program(CCACHE ccache)
if(CCACHE)  # required with precompiled headers; another clone's objects serve this one
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=true ${CCACHE})
endif()
set(precompiled <algorithm> <filesystem> <functional> <optional> <string> <vector> <fmt/format.h> <glm/glm.hpp>)

# The kernel gives the same bits with every compiler: no contraction, no reordering of floating point. Its speed comes
# from Release's -O3 instead of -O2, and no errno or traps.
add_library(ods_flags INTERFACE)
set(gcc12 $<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>)  # the compiler of CI
target_compile_options(ods_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion $<$<OR:$<BOOL:${ODS_WERROR}>,$<AND:${gcc12}>>:-Werror>
  -ffp-contract=off -fno-math-errno -fno-trapping-math $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
  $<$<AND:${gcc12}>:-Wno-array-bounds -Wno-restrict
    -Wno-stringop-overflow -Wno-stringop-overread>  # false positives in strings
  $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)  # for files included by another, as in unite()
target_link_options(ods_flags INTERFACE -Wl,--as-needed)  # a program starts faster without unused libraries
if(ODS_SANITIZE)  # g++ 12 has false positives in <regex>
  target_compile_options(ods_flags INTERFACE -fsanitize=${ODS_SANITIZE} -fno-sanitize-recover=all
    -fno-omit-frame-pointer $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_definitions(ods_flags INTERFACE _GLIBCXX_ASSERTIONS ODS_SANITIZED)
  target_link_options(ods_flags INTERFACE -fsanitize=${ODS_SANITIZE})
endif()

# Up to sixteen files of a folder are compiled as one, in less than half the time. Code that two of them need belongs in
# one place; a name that two tests use for different things, in `namespace ods::FILE`.
function(unite target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ODS_UNITY} UNITY_BUILD_MODE GROUP)
  foreach(source ${ARGN})
    string(REGEX REPLACE "^${PROJECT_SOURCE_DIR}/(.*)/.*" "\\1" folder ${source})
    string(REPLACE "/" "_" folder ${folder})
    math(EXPR group "0${count_${folder}} / 16")
    math(EXPR count_${folder} "0${count_${folder}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${group})
  endforeach()
endfunction()
