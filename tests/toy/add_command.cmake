# cmake -DSOURCE=… -DSCRATCH=… -P add_command.cmake: see README.md. A second run builds what has changed.
file(REMOVE_RECURSE ${SCRATCH}/source)
foreach(part CMakeLists.txt common proto server client shaders tests)
  file(COPY ${SOURCE}/${part} DESTINATION ${SCRATCH}/source)
endforeach()

# The file and the line.
configure_file(${SOURCE}/tests/toy/toy_command.cpp ${SCRATCH}/source/client/cli/commands/toy.cpp COPYONLY)
file(APPEND ${SCRATCH}/source/client/cli/commands.def "METAMER_COMMAND(toy)\n")

foreach(command
    "${CMAKE_COMMAND};-S;${SCRATCH}/source;-B;${SCRATCH}/build;-G;Ninja;-DCMAKE_BUILD_TYPE=Debug;-DCMAKE_CXX_FLAGS_DEBUG=-O0"
    "${CMAKE_COMMAND};--build;${SCRATCH}/build;--target;metamer")
  execute_process(COMMAND ${command} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${command}")
  endif()
endforeach()

# expect(CODE TEXT WORDS…): metamer WORDS… ends with CODE and says TEXT.
function(expect code text)
  execute_process(COMMAND ${SCRATCH}/build/bin/metamer ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL ${code} OR NOT said MATCHES "${text}")
    message(FATAL_ERROR "metamer ${ARGN}: ${result} in place of ${code}, or not \"${text}\" in:\n${said}")
  endif()
  message(STATUS "ok: metamer ${ARGN}")
endfunction()
expect(0 "toy  +add numbers up" --help)
expect(0 "numbers UINT:INT in .0 - 100. ... REQUIRED" toy --help)
expect(0 "^42\n$" toy 40 2)
expect(0 "\"sum\": 42" toy 40 2 --json)
expect(2 "101" toy 101)
expect(2 "numbers is required" toy)
