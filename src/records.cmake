# What the headers of structs say of their members, made from them when the project is built: the
# members for C++ (output/records.hpp, output/documents.hpp) and the JSON Schemas in
# ${PROJECT_BINARY_DIR}/schemas. python and web make their own from the same headers.
set(GEARLASH_MAKE_RECORDS "${PROJECT_SOURCE_DIR}/records/make")
file(GLOB GEARLASH_RECORD_MAKERS CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/records/*.py"
     "${GEARLASH_MAKE_RECORDS}")

# A header stands after those that it needs.
set(GEARLASH_PUBLIC_RECORDS fault bounds parameter quantity answer analyse motion sensitivity grid
                            design tolerance tune comparison)
list(TRANSFORM GEARLASH_PUBLIC_RECORDS PREPEND "${PROJECT_SOURCE_DIR}/include/gearlash/")
list(TRANSFORM GEARLASH_PUBLIC_RECORDS APPEND ".hpp")
set(GEARLASH_DOCUMENTS answer_report comparison_report describe_report design_report drive_text grid_table
                       motion_report tolerance_report tune_report)
list(TRANSFORM GEARLASH_DOCUMENTS PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/output/")
list(TRANSFORM GEARLASH_DOCUMENTS APPEND ".hpp")
# Those that have other structs of documents.
set(inner_headers input/units model/parameters model/firmware model/gains numeric/transfer_function
                  general/assemble/time_scale question/loop/describing/describing_function
                  question/loop/describing/harmonic_balance question/loop/describing/describing
                  question/loop/ceiling/enclosed_ceiling question/change/target
                  question/change/design question/series/samples question/series/worst_corner
                  question/map/region_boundary question/map/map_regions output/json_writer
                  output/report_units output/parameter_text)
list(TRANSFORM inner_headers PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
list(TRANSFORM inner_headers APPEND ".hpp")

set(headers_made "${PROJECT_BINARY_DIR}/include/output")
set(schemas "${PROJECT_BINARY_DIR}/schemas")
# A stamp, so that a header whose text stays as it was compiles nothing again.
set(records_made "${CMAKE_CURRENT_BINARY_DIR}/records.stamp")
add_custom_command(
  OUTPUT "${records_made}"
  BYPRODUCTS "${headers_made}/records.hpp" "${headers_made}/documents.hpp"
  COMMAND Python3::Interpreter "${GEARLASH_MAKE_RECORDS}" members "${headers_made}/records.hpp"
          --of ${GEARLASH_PUBLIC_RECORDS}
  COMMAND Python3::Interpreter "${GEARLASH_MAKE_RECORDS}" members "${headers_made}/documents.hpp"
          --of ${GEARLASH_DOCUMENTS} --with ${GEARLASH_PUBLIC_RECORDS} ${inner_headers}
  COMMAND Python3::Interpreter "${GEARLASH_MAKE_RECORDS}" schemas "${schemas}"
          --of ${GEARLASH_DOCUMENTS} --with ${GEARLASH_PUBLIC_RECORDS} ${inner_headers}
  COMMAND ${CMAKE_COMMAND} -E touch "${records_made}"
  DEPENDS ${GEARLASH_RECORD_MAKERS} ${GEARLASH_PUBLIC_RECORDS} ${GEARLASH_DOCUMENTS} ${inner_headers}
  COMMENT "Making what the headers of structs say of their members")
set(GEARLASH_MAKE_RECORDS "${GEARLASH_MAKE_RECORDS}" PARENT_SCOPE)
set(GEARLASH_RECORD_MAKERS "${GEARLASH_RECORD_MAKERS}" PARENT_SCOPE)
set(GEARLASH_PUBLIC_RECORDS "${GEARLASH_PUBLIC_RECORDS}" PARENT_SCOPE)
add_custom_target(gearlash_records DEPENDS "${records_made}")
add_dependencies(gearlash_output gearlash_records)
