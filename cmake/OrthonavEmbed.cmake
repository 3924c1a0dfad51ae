# orthonav_embed(target name file) makes `std::string_view orthonav::embedded::<name>()` of a file,
# declared in the generated header "embedded/<name>.h". It is compiled in an object library of its own, which links
# nothing: a target that generates a source would wait with all of its sources for every library that it links.
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
  set(objects ${target}_embedded)
  if(NOT TARGET ${objects})
    add_library(${objects} OBJECT)
    target_include_directories(${objects} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}")
    orthonav_hardened(${objects})
    orthonav_unity(${objects})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
    target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}")
  endif()
  target_sources(${objects} PRIVATE "${out}/${name}.cpp" "${out}/${name}.h")
endfunction()
