# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# cmake -DSOURCE=... -DBUILD=... -DCOMPILER=... -DPROGRAM=... -P same_bits_test.cmake
# Builds render_digest with another compiler and compares what it prints with what PROGRAM, this build's own, prints.
if(NOT COMPILER)
  message("skipped: there is no second compiler here (clang++ or g++)")
  return()
endif()
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE errors RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(other ${BUILD}/other_compiler)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${other} -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${other} --target render_digest)
run(${PROGRAM})
set(ours ${output})
run(${other}/render_digest)
if(NOT ours STREQUAL output)
  message(FATAL_ERROR "this build's picture is ${ours}${COMPILER}'s is ${output}")
endif()
