# cmake -DBUILD=<build tree> -DWORK=<scratch> -DFLAGS=<compiler flags> -P check.cmake
# Installs the build, then configures, builds and runs the stranger's project against it.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G Ninja
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/stranger ${WORK}/ramp.svg)
run(${WORK}/prefix/bin/quadrille --version)
if(EXISTS ${BUILD}/bin/quadrille-view)
  run(${WORK}/prefix/bin/quadrille-view --version)
endif()
