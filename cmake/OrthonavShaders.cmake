# orthonav_shaders(target) compiles every shader of shaders/ to SPIR-V and embeds it in the target as
# `orthonav::embedded::<name>_<stage>()`, such as mesh_vert().
include(OrthonavEmbed)

function(orthonav_shaders target)
  find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED
               DOC "Compiler of the shaders (Debian: glslang-tools)")
  set(folder "${PROJECT_SOURCE_DIR}/shaders")
  file(GLOB shaders CONFIGURE_DEPENDS "${folder}/*.vert" "${folder}/*.frag")
  file(GLOB included CONFIGURE_DEPENDS "${folder}/*.glsl")
  file(MAKE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/spirv")
  foreach(shader IN LISTS shaders)
    get_filename_component(file_name "${shader}" NAME)
    string(REPLACE "." "_" name "${file_name}")
    set(spirv "${CMAKE_CURRENT_BINARY_DIR}/spirv/${name}.spv")
    add_custom_command(
      OUTPUT "${spirv}"
      COMMAND "${GLSLANG_VALIDATOR}" --quiet -V --target-env vulkan1.1 "-I${folder}"
              -o "${spirv}" "${shader}"
      DEPENDS "${shader}" ${included}
      COMMENT "Compiling ${file_name}"
      VERBATIM)
    orthonav_embed(${target} ${name} "${spirv}")
  endforeach()
endfunction()
