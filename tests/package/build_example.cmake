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
step("${WORK}/build/example")
if(NOT said MATCHES "guide L4 left: [0-9.]+ deg off the plan")
  message(FATAL_ERROR "the example printed no guidance:\n${said}")
endif()
