# What the headers of structs say of their members, made from them when the project is built: the
# members for C++ (output/records.hpp, output/documents.hpp) and the JSON Schemas in
# ${PROJECT_BINARY_DIR}/schemas. python and web make their own from the same headers.

# gearlash_make_records(<target> [MEMBERS <file>] [SCHEMAS <folder>] [TYPES <file>]
#                       [PYTHON <file> METHODS <file>] OF <header>...)
# Files whose text stays as it was are left alone, so that they compile nothing again.
function(gearlash_make_records target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "MEMBERS;SCHEMAS;TYPES;PYTHON;METHODS" "OF")
  find_package(Python3 COMPONENTS Interpreter REQUIRED)
  set(folder "${PROJECT_SOURCE_DIR}/records")
  set(stamp "${CMAKE_CURRENT_BINARY_DIR}/${target}.stamp")
  foreach(kind IN ITEMS MEMBERS SCHEMAS TYPES PYTHON METHODS)
    if(DEFINED arg_${kind})
      string(TOLOWER "--${kind}" option)
      list(APPEND outputs ${option} "${arg_${kind}}")
    endif()
  endforeach()
  file(GLOB makers CONFIGURE_DEPENDS "${folder}/*.py")
  add_custom_command(
    OUTPUT "${stamp}"
    BYPRODUCTS ${arg_MEMBERS} ${arg_PYTHON}
    COMMAND Python3::Interpreter "${folder}/make" ${outputs} --stamp "${stamp}" --of ${arg_OF}
    DEPENDS "${folder}/make" ${makers} ${arg_OF} ${arg_METHODS}
    DEPFILE "${stamp}.d"
    COMMENT "Making what the headers of structs say of their members")
  add_custom_target(${target} DEPENDS "${stamp}")
endfunction()

set(GEARLASH_PUBLIC_RECORDS fault bounds parameter quantity answer analyse motion sensitivity grid
                            design tolerance tune comparison plot picture output)
list(TRANSFORM GEARLASH_PUBLIC_RECORDS PREPEND "${PROJECT_SOURCE_DIR}/include/gearlash/")
list(TRANSFORM GEARLASH_PUBLIC_RECORDS APPEND ".hpp")
set(GEARLASH_PUBLIC_RECORDS ${GEARLASH_PUBLIC_RECORDS} PARENT_SCOPE)
set(documents answer_report comparison_report describe_report design_report drive_text grid_table
              motion_report tolerance_report tune_report)
list(TRANSFORM documents PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/output/")
list(TRANSFORM documents APPEND ".hpp")
set(made "${PROJECT_BINARY_DIR}/include/output")
gearlash_make_records(gearlash_records MEMBERS "${made}/records.hpp" OF ${GEARLASH_PUBLIC_RECORDS})
gearlash_make_records(gearlash_documents MEMBERS "${made}/documents.hpp"
                      SCHEMAS "${PROJECT_BINARY_DIR}/schemas" OF ${documents})
add_dependencies(gearlash_output gearlash_records gearlash_documents)
