# cmake -D SOURCE=... -D WORK=... -D CONSUMER=... -D CXX=... -D GENERATOR=... -D DATA_SHEET=...
#       -P subproject_test.cmake
#
# A project that has Gearlash in its own tree, in C++23 with all warnings as errors, keeps its own
# targets as they were, installs nothing of Gearlash, and its programs print what those of the
# installed package print (CONSUMER, of consumer_test.cmake). It works on one thread, for which TBB
# is not looked for, without optimisation and several files at a time: it is compiled for this test
# alone.

file(REMOVE_RECURSE "${WORK}")
set(warnings "-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wold-style-cast")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/parent" -B "${WORK}/build"
          -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX}" "-DGEARLASH=${SOURCE}"
          -DCMAKE_CXX_STANDARD=23 -DCMAKE_UNITY_BUILD=ON "-DCMAKE_CXX_FLAGS=-O0 ${warnings} -Werror"
          -DGEARLASH_BUILD_IO=ON -DGEARLASH_BUILD_CLI=OFF
          -DGEARLASH_THREADS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${WORK}/build" --prefix "${WORK}/prefix"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE installed "${WORK}/prefix/*")
if(installed)
  message(FATAL_ERROR "installed from the tree of another project: ${installed}")
endif()

file(STRINGS "${WORK}/build/programs" programs)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/build" --target ${programs}
                COMMAND_ERROR_IS_FATAL ANY)
foreach(program IN LISTS programs)
  foreach(build IN ITEMS "${WORK}" "${CONSUMER}")
    execute_process(COMMAND "${build}/build/${program}" "${DATA_SHEET}"
                    WORKING_DIRECTORY "${build}" OUTPUT_VARIABLE "output_of_${build}"
                    COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  if(NOT output_of_${WORK} STREQUAL output_of_${CONSUMER})
    message(FATAL_ERROR "${program} prints\n${output_of_${WORK}}\nand, as built against the \
installed package,\n${output_of_${CONSUMER}}")
  endif()
endforeach()
