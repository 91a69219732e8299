# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# -DSOURCE -DBUILD -DCOMPILER -DGLSLANG: whether tests/glsl/camera.frag is GLSL ES 3.00.
execute_process(COMMAND ${COMPILER} -E -P -x c -I${SOURCE} ${SOURCE}/tests/glsl/camera.frag
  OUTPUT_VARIABLE shader COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${BUILD}/camera_webgl.frag "#version 300 es\n${shader}")
execute_process(COMMAND ${GLSLANG} ${BUILD}/camera_webgl.frag COMMAND_ERROR_IS_FATAL ANY)
