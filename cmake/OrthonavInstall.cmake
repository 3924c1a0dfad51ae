# Install rules: `cmake --install build/release --prefix P` makes a package that others find with
# `find_package(orthonav)` and link as `orthonav::engine` (or a part: orthonav::nav, ::hal_api, ...).
include(CMakePackageConfigHelpers)

get_property(orthonav_libraries GLOBAL PROPERTY ORTHONAV_LIBRARIES)
set(orthonav_package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/orthonav")

install(TARGETS ${orthonav_libraries} EXPORT orthonavTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
install(EXPORT orthonavTargets NAMESPACE orthonav:: DESTINATION "${orthonav_package_folder}" COMPONENT dev)
# Headers but those of libraries that are not installed, and those by which a library is made. Of the study, the
# simulated room of a case alone is installed.
file(GLOB_RECURSE ORTHONAV_HEADERS CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}"
     base/*.h hal/*.h nav/*.h render/*.h engine/*.h)
list(FILTER ORTHONAV_HEADERS EXCLUDE REGEX
     "^(render/(font_maker|vulkan)|engine/(golden|scan|evaluation)|hal/igtl)/")
list(APPEND ORTHONAV_HEADERS study/set_up.h study/sim_scenario.h)
if(ORTHONAV_HEADSET)
  list(FILTER ORTHONAV_HEADERS EXCLUDE REGEX "^(engine/(planning|print)|hal/(hl2ss|desktop|voice|open))/")
endif()
foreach(header IN LISTS ORTHONAV_HEADERS)
  get_filename_component(room "${header}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/orthonav/${room}"
          COMPONENT dev)
endforeach()
# The contract tests of devices, for those who write a device outside this tree.
set(orthonav_contract_folder "${CMAKE_INSTALL_DATADIR}/orthonav/contract")
install(FILES "${PROJECT_SOURCE_DIR}/tests/contract/contract_test.cpp"
              "${PROJECT_SOURCE_DIR}/tests/contract/depth_contract_test.cpp"
        DESTINATION "${orthonav_contract_folder}" COMPONENT dev)
foreach(header contract/device_cases support/session_log)
  get_filename_component(folder "${header}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/tests/${header}.h"
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/orthonav/tests/${folder}" COMPONENT dev)
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/data/tools.json" DESTINATION "${CMAKE_INSTALL_DATADIR}/orthonav"
        COMPONENT runtime)
install(FILES "${PROJECT_SOURCE_DIR}/data/languages/template.toml" "${PROJECT_SOURCE_DIR}/data/languages/de.toml"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/orthonav/languages" COMPONENT runtime)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/orthonav-doc" COMPONENT doc)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" "${PROJECT_SOURCE_DIR}/tools/example"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/orthonav-doc" COMPONENT doc)

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/orthonavConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/orthonavConfig.cmake"
                              INSTALL_DESTINATION "${orthonav_package_folder}"
                              PATH_VARS orthonav_contract_folder)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/orthonavConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/orthonavConfig.cmake"
              "${PROJECT_BINARY_DIR}/orthonavConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindOpenCVCalib3d.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindPocketSphinx.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindOpenIgtLink.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/OrthonavApriltag.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/OrthonavImported.cmake"
        DESTINATION "${orthonav_package_folder}" COMPONENT dev)

# The command, and what is made with it.
if(TARGET orthonav)
  # Building the targets orthonav and manual is enough to install everything but the pages of the headers.
  add_dependencies(orthonav ${orthonav_libraries})
  install(TARGETS orthonav RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT runtime)
  include(OrthonavManual)
  include(OrthonavApi)
  include(OrthonavPackages)
endif()
