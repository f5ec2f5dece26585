# Writes OUTPUT, which says what SOURCE was built from; leaves it as it is where it says so already.
# A copy of the sources within another repository is none of its commits.
cmake_minimum_required(VERSION 3.25)
set(id "")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-toplevel
    OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH "${SOURCE}" source)
  if(top STREQUAL source)
    set(ENV{GIT_OPTIONAL_LOCKS} 0)
    execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --tags --abbrev=12
      OUTPUT_VARIABLE id OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()
if(NOT id MATCHES "^[A-Za-z0-9._+-]+$")
  set(id "${VERSION}")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
  "#include \"common/program/build_id.h\"\n\nconst char* metamer::build_id() { return \"@id@\"; }\n" @ONLY)
