# The installed library as its users find it: installs to an empty folder, builds and runs the C++
# example against it, and runs TestPython.py with its Python package.
# Needs: BUILD, SOURCE, FOLDER, GENERATOR. If there is a package: PYTHON, PACKAGES (its folder).
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${FOLDER}/prefix")
run(${CMAKE_COMMAND} -S "${SOURCE}/Examples/Cxx" -B "${FOLDER}/build" -G "${GENERATOR}"
  "-DCMAKE_PREFIX_PATH=${FOLDER}/prefix" -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build "${FOLDER}/build")
run("${FOLDER}/build/LevelsOfDetail" "${FOLDER}/hierarchy.vtp")
message("${output}")
if(NOT output MATCHES "tolerance 20: [1-9][0-9]* triangles" OR NOT EXISTS "${FOLDER}/hierarchy.vtp")
  message(FATAL_ERROR "The example did not do its work.")
endif()

if(PYTHON)
  run(${CMAKE_COMMAND} -E env "PYTHONPATH=${FOLDER}/prefix/${PACKAGES}"
    "${PYTHON}" "${SOURCE}/Testing/Python/TestPython.py")
  message("${output}")
endif()
