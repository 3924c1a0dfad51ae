# orthonav_embed(target name file) makes `std::string_view orthonav::embedded::<name>()` of a file,
# declared in the generated header "embedded/<name>.h".
function(orthonav_embed target name file)
  set(out "${CMAKE_CURRENT_BINARY_DIR}/embedded")
  # The header needs nothing but the name: it is there before anything is built.
  set(header "#pragma once\n\n#include <string_view>\n\nnamespace orthonav::embedded {
std::string_view ${name}();\n}\n")
  file(CONFIGURE OUTPUT "${out}/${name}.h" CONTENT "${header}" @ONLY)
  add_custom_command(
    OUTPUT "${out}/${name}.cpp"
    COMMAND "${CMAKE_COMMAND}" -DNAME=${name} "-DFILE=${file}" "-DOUT=${out}"
            -P "${PROJECT_SOURCE_DIR}/cmake/embed_file.cmake"
    DEPENDS "${file}" "${PROJECT_SOURCE_DIR}/cmake/embed_file.cmake"
    VERBATIM)
  target_sources(${target} PRIVATE "${out}/${name}.cpp" "${out}/${name}.h")
  target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}")
endfunction()
