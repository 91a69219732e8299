# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# cmake -DODS=path/of/ods -DOUT=folder -P manual.cmake: what the command says about itself, for man and for shells.
function(write format file)  # ARGN: a command's name, or nothing
  execute_process(COMMAND ${ODS} ${ARGN} --help=${format} OUTPUT_FILE ${OUT}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT}/man1)
write(bash ods)
write(zsh _ods)
write(man man1/ods.1)
file(STRINGS ${OUT}/man1/ods.1 rows REGEX "^\\.BR ods\\\\-")
foreach(row ${rows})
  string(REGEX REPLACE ".*-([a-z]+) .*" "\\1" command "${row}")
  write(man man1/ods-${command}.1 ${command})
endforeach()
file(GLOB pages ${OUT}/man1/*.1)
execute_process(COMMAND gzip -9n ${pages} COMMAND_ERROR_IS_FATAL ANY)
