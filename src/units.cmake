# The table of units, made when the project is built: nothing of UDUNITS-2 is needed afterwards.
find_package(Python3 COMPONENTS Interpreter REQUIRED)
find_file(UDUNITS2_DATABASE udunits2.xml PATH_SUFFIXES xml/udunits udunits
          PATHS /usr/share /usr/local/share REQUIRED)
mark_as_advanced(UDUNITS2_DATABASE)

set(unit_table "${PROJECT_BINARY_DIR}/include/input/unit_table.inc")
set(unit_script "${PROJECT_SOURCE_DIR}/scripts/unit-table")
set(unit_aliases "${CMAKE_CURRENT_SOURCE_DIR}/input/units_of_engineers.txt")
add_custom_command(
  OUTPUT "${unit_table}"
  COMMAND Python3::Interpreter "${unit_script}" "${UDUNITS2_DATABASE}" "${unit_aliases}"
          "${unit_table}"
  DEPENDS "${unit_script}" "${unit_aliases}" "${UDUNITS2_DATABASE}"
  COMMENT "Writing the table of units")
# By a target of its own, the table waits for no library.
add_custom_target(gearlash_unit_table DEPENDS "${unit_table}")
target_sources(gearlash_input PRIVATE "${unit_table}")
add_dependencies(gearlash_input gearlash_unit_table)
