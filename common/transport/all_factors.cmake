# Writes all_factors.inc: the definition of each line of factors.def.
set(factors_def ${CMAKE_CURRENT_SOURCE_DIR}/transport/factors.def)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${factors_def})
file(STRINGS ${factors_def} lines REGEX "^METAMER_FACTOR\\([0-9]+, ")
set(text "// Written by common/transport/all_factors.cmake from factors.def.\n")
foreach(line ${lines})
  if(NOT line MATCHES "^METAMER_FACTOR\\([0-9]+, ([a-z][a-z0-9_]*), ")
    message(FATAL_ERROR "${factors_def}: can't read: ${line}")
  endif()
  string(APPEND text "#include \"common/transport/factors/${CMAKE_MATCH_1}.h\"\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/include/common/transport/all_factors.inc
  CONTENT "${text}" @ONLY)
