# `cpack --config build/release/CPackConfig.cmake` makes Debian packages: orthonav (the command),
# liborthonav-dev (what programs are built with), python3-orthonav where the module is built, and orthonav-doc.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME orthonav)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_VENDOR "The orthonav developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
    GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev doc)
set(packages "runtime orthonav" "dev liborthonav-dev" "doc orthonav-doc")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The orthonav developers <maintainers@orthonav.org>")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME orthonav)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "mesa-vulkan-drivers, pocketsphinx-en-us")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "orthonav-doc")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "Tracks a pointer and a drill guide in the images of a headset's two cameras,
registers preoperative vertebrae to strokes over the bone, guides pedicle
screws, templates rods, and draws all of it as holograms. Brings a simulated
operating room. Not certified for use on patients.")

# What the static libraries are built with, as in tools/setup: libraries only, without those for the
# window and for scans, which only the command uses.
execute_process(COMMAND "${PROJECT_SOURCE_DIR}/tools/setup" --list-libraries OUTPUT_VARIABLE libraries
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ", " libraries "${libraries}")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME liborthonav-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${libraries}")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "orthonav-doc, libgtest-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION
    "Static libraries, headers and the CMake package: a program calls
find_package(orthonav) and links orthonav::engine or a part of it.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME orthonav-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOC_DESCRIPTION
    "How it works, how accurate it is and how that is measured, file formats,
headsets, decisions, pages of the headers, and examples in C++ and Python.")

if(ORTHONAV_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  list(APPEND packages "python python3-orthonav")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-orthonav)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # The module is for this version of Python; with the next one it has to be built anew.
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "mesa-vulkan-drivers")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "orthonav, orthonav-doc")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "The Python module orthonav: tracks tools in pairs of images, registers points
to vertebrae, guides tools to planned screws and draws scenes, with NumPy
arrays. Not certified for use on patients.")
endif()

# Each package carries its copyright and changelog (gzip was searched for with the manual).
if(GZIP_PROGRAM)
  set(papers "${PROJECT_BINARY_DIR}/papers")
  # Of data/golden_vertebra.ply; blank lines are dots in this format.
  file(READ "${PROJECT_SOURCE_DIR}/tests/data/anatomy/visible-human/LICENSE" bsd)
  string(STRIP "${bsd}" bsd)
  string(REGEX REPLACE "\n\n" "\n.\n" bsd "${bsd}")
  string(REPLACE "\n" "\n " bsd "${bsd}")
  file(WRITE "${papers}/copyright" "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: orthonav

Files: *
Copyright: 2026 The orthonav developers
License: Apache-2.0
 On Debian systems the full text is in /usr/share/common-licenses/Apache-2.0.

Files: data/golden_vertebra.ply
Copyright: 2021 Robin Remus
License: BSD-3-Clause
 ${bsd}
")
  configure_file("${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${papers}/changelog" COPYONLY)
  file(WRITE "${papers}/changelog.Debian" "orthonav (${PROJECT_VERSION}-1) unstable; urgency=medium

  * As the changelog says.

 -- The orthonav developers <maintainers@orthonav.org>  Sat, 01 Aug 2026 12:00:00 +0000
")
  execute_process(COMMAND "${GZIP_PROGRAM}" -9nf "${papers}/changelog" "${papers}/changelog.Debian"
                  COMMAND_ERROR_IS_FATAL ANY)
  foreach(part IN LISTS packages)
    separate_arguments(part)
    list(GET part 0 component)
    list(GET part 1 package)
    install(FILES "${papers}/copyright" "${papers}/changelog.gz" "${papers}/changelog.Debian.gz"
            DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT ${component})
  endforeach()
endif()
include(CPack)
