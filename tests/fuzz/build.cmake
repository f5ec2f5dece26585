# cmake -D SOURCE=… -P build.cmake: builds the fuzz targets into SOURCE/build/fuzz, one at a time
# where several builds are tested at once.
find_program(CLANG clang++)
if(NOT CLANG)
  message(FATAL_ERROR "The fuzz targets need Clang: apt install clang libclang-rt-14-dev")
endif()
file(MAKE_DIRECTORY ${SOURCE}/build)
file(LOCK ${SOURCE}/build/fuzz.lock TIMEOUT 2300)
execute_process(COMMAND ${CMAKE_COMMAND} --preset fuzz
  WORKING_DIRECTORY ${SOURCE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build --preset fuzz
  WORKING_DIRECTORY ${SOURCE} COMMAND_ERROR_IS_FATAL ANY)
