# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# cmake -DBUILD=... -DSOURCE=... -P install_test.cmake: installs ods, then builds and runs the examples and the command from there.
set(prefix ${BUILD}/install_test)
file(REMOVE_RECURSE ${prefix})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${SOURCE}/examples -B ${prefix}/examples -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${prefix}/examples)
run(${prefix}/examples/room ${prefix}/example.png 16 1)
run(${prefix}/examples/video toys ${prefix}/example.mp4)
run(${prefix}/bin/ods render room -q --width 16 --samples 1 --output ${prefix}/command.png)
foreach(name example.png example.mp4 command.png)
  file(SIZE ${prefix}/${name} size)
  if(size EQUAL 0)
    message(FATAL_ERROR "${name} is empty")
  endif()
endforeach()
