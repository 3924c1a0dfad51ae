# Installs what the presets headset and arm64 build into a folder of its own, builds the examples against it, and runs
# one that needs no device.
include("${CMAKE_CURRENT_LIST_DIR}/step.cmake")

file(REMOVE_RECURSE "${WORK}")
step("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
set(cross "")
if(TOOLCHAIN)
  # The toolchain looks for packages on the headset's side; this one lies elsewhere.
  set(cross "-DCMAKE_TOOLCHAIN_FILE=${TOOLCHAIN}" "-Dorthonav_DIR=${WORK}/prefix/lib/cmake/orthonav")
endif()
step("${CMAKE_COMMAND}" -S "${EXAMPLE}" -B "${WORK}/build" -G "${GENERATOR}" ${cross} "-DCMAKE_CXX_COMPILER=${COMPILER}"
     "-DCMAKE_PREFIX_PATH=${WORK}/prefix")
step("${CMAKE_COMMAND}" --build "${WORK}/build")
if(EXISTS "${WORK}/build/device")
  message(FATAL_ERROR "the example device was built, although hal_open is not installed")
endif()
step(${EMULATOR} "${WORK}/build/register_points")
if(NOT said MATCHES "accepted, error to expect at the screws 0[.][0-4]")
  message(FATAL_ERROR "the points were not registered:\n${said}")
endif()
