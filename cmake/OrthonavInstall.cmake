# Install rules: `cmake --install build/release --prefix P` makes a package that others find with
# `find_package(orthonav)` and link as `orthonav::engine` (or a part: orthonav::nav, ::hal_api, ...).
include(CMakePackageConfigHelpers)

get_property(orthonav_libraries GLOBAL PROPERTY ORTHONAV_LIBRARIES)
set(orthonav_package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/orthonav")

# Whoever builds the command alone can install everything.
add_dependencies(orthonav ${orthonav_libraries})
install(TARGETS ${orthonav_libraries} EXPORT orthonavTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
install(EXPORT orthonavTargets NAMESPACE orthonav:: DESTINATION "${orthonav_package_folder}" COMPONENT dev)
install(TARGETS orthonav RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT runtime)
foreach(folder base hal nav render engine)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}"
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/orthonav" COMPONENT dev FILES_MATCHING PATTERN "*.h"
          PATTERN "font_maker" EXCLUDE PATTERN "golden" EXCLUDE PATTERN "scan" EXCLUDE PATTERN "igtl" EXCLUDE)
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/data/tools.json" DESTINATION "${CMAKE_INSTALL_DATADIR}/orthonav"
        COMPONENT runtime)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/orthonav-doc" COMPONENT doc)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" "${PROJECT_SOURCE_DIR}/tools/example"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/orthonav-doc" COMPONENT doc)
include(OrthonavManual)

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/orthonavConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/orthonavConfig.cmake"
                              INSTALL_DESTINATION "${orthonav_package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/orthonavConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/orthonavConfig.cmake"
              "${PROJECT_BINARY_DIR}/orthonavConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindOpenCVCalib3d.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindPocketSphinx.cmake"
        DESTINATION "${orthonav_package_folder}" COMPONENT dev)
include(OrthonavPackages)
