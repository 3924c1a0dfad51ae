# Fails as soon as a step fails, and shows what it said.
function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
set(link "")
if(FLAGS)
  set(link "-DCMAKE_EXE_LINKER_FLAGS=-fsanitize=${FLAGS}")
endif()
step("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
step("${CMAKE_COMMAND}" -S "${EXAMPLE}" -B "${WORK}/build" -G "${GENERATOR}" ${link}
     "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
     "-DCMAKE_BUILD_TYPE=Release")
step("${CMAKE_COMMAND}" --build "${WORK}/build")
# Eight seconds of the operation: long enough for the surgeon to have stroked the bone.
step("${WORK}/build/example" 240)
if(NOT said MATCHES "digitize L4  [1-9][0-9]* points")
  message(FATAL_ERROR "the example tracked nothing:\n${said}")
endif()

# A device from outside is opened by its own URI; an unknown scheme is told with it.
step("${WORK}/build/device" "skeleton:30")
if(NOT said MATCHES "skeleton: [23][0-9] frames shown")
  message(FATAL_ERROR "the device showed nothing:\n${said}")
endif()
execute_process(COMMAND "${WORK}/build/device" "skeletn:30" RESULT_VARIABLE status ERROR_VARIABLE said)
if(status EQUAL 0 OR NOT said MATCHES "openxr:\\+URI and skeleton:PAIRS")
  message(FATAL_ERROR "an unknown scheme was not refused with the known ones:\n${said}")
endif()
