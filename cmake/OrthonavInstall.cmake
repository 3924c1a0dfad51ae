# Install rules: `cmake --install build/release --prefix P` makes a package that others find with
# `find_package(orthonav)` and link as `orthonav::engine` (or a part: orthonav::nav, ::hal_api, ...).
include(CMakePackageConfigHelpers)

get_property(orthonav_libraries GLOBAL PROPERTY ORTHONAV_LIBRARIES)
set(orthonav_package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/orthonav")

install(TARGETS ${orthonav_libraries} EXPORT orthonavTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev
        FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/orthonav" COMPONENT dev)
install(EXPORT orthonavTargets NAMESPACE orthonav:: DESTINATION "${orthonav_package_folder}" COMPONENT dev)
# What each library links, that of others of ours included: a program that names its components needs no more.
function(orthonav_links target out)
  get_target_property(direct ${target} INTERFACE_LINK_LIBRARIES)
  set(links "")
  foreach(link IN LISTS direct)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" link "${link}")
    if(link MATCHES "^orthonav::")
      orthonav_links(${link} link)
    endif()
    list(APPEND links ${link})
  endforeach()
  list(REMOVE_DUPLICATES links)
  list(FILTER links EXCLUDE REGEX "-NOTFOUND$")
  set(${out} "${links}" PARENT_SCOPE)
endfunction()
set(orthonav_components "")
set(orthonav_links_of_components "")
foreach(library IN LISTS orthonav_libraries)
  orthonav_links(${library} links)
  string(REGEX REPLACE "^orthonav_" "" component "${library}")
  list(APPEND orthonav_components ${component})
  string(APPEND orthonav_links_of_components "set(orthonav_links_of_${component} ${links})\n")
endforeach()
# The contract tests of devices, for those who write a device outside this tree.
set(orthonav_contract_folder "${CMAKE_INSTALL_DATADIR}/orthonav/contract")
install(FILES "${PROJECT_SOURCE_DIR}/tests/contract/contract_test.cpp"
              "${PROJECT_SOURCE_DIR}/tests/contract/depth_contract_test.cpp"
              "${PROJECT_SOURCE_DIR}/tests/contract/tool_poses_contract_test.cpp"
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
