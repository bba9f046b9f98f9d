cmake_minimum_required(VERSION 3.25)  # policies of a script run by itself

# cmake -D SOURCE=... -D WORK=... -D CXX=... -D CXX_FLAGS=... -D GENERATOR=... -P first_program_test.cmake
#
# The five minutes of docs/start/cpp.md: the project that the page shows is built beside the library
# that WORK/prefix holds, and its program run.
set(folder "${WORK}/first-program")
file(REMOVE_RECURSE "${folder}")
file(READ "${SOURCE}/docs/start/cpp.md" page)
string(REGEX MATCH "```cmake\n([^`]*)```" block "${page}")
file(WRITE "${folder}/CMakeLists.txt" "${CMAKE_MATCH_1}")
file(COPY "${SOURCE}/examples/programs/change_file.cpp" "${SOURCE}/examples/first-servo.toml"
     DESTINATION "${folder}")

execute_process(COMMAND "${CMAKE_COMMAND}" -B build -G "${GENERATOR}"
                        "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
                        "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
                WORKING_DIRECTORY "${folder}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build build
                WORKING_DIRECTORY "${folder}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND build/change_file first-servo.toml OUTPUT_VARIABLE printed
                WORKING_DIRECTORY "${folder}" COMMAND_ERROR_IS_FATAL ANY)
# The page shows the line of the tool for the same changes.
string(FIND "${page}" "\n${printed}```" place)
if(NOT printed MATCHES "^hunts: " OR place EQUAL -1)
  message(FATAL_ERROR "docs/start/cpp.md does not show: ${printed}")
endif()
