# Writes all_lights.inc: the struct of each line of lights.def, then the sources in shaders/lights. C++
# includes it once for eight lanes of f32 and once for f64.
set(lights_def ${CMAKE_CURRENT_SOURCE_DIR}/lights/lights.def)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${lights_def})
file(STRINGS ${lights_def} lines REGEX "^METAMER_LIGHT\\([0-9]+, " ENCODING UTF-8)
set(text [[
// Written by common/lights/all_lights.cmake from lights.def.
#include "shaders/lights/incident.glsl"
#define METAMER_POSITION(name, ...) Vec3 name;
#define METAMER_DIRECTION(name, ...) Vec3 name;
#define METAMER_ANGLE(name, ...) Real name##_versine;
#define METAMER_PARAMETER(name, ...) Real name;
#define METAMER_LIGHT(number, name, Type, citation, equation, ...) \
  struct Type##Light { Real reference_squared; __VA_ARGS__ };
#include "common/lights/lights.def"
]])
foreach(line ${lines})
  if(NOT line MATCHES "^METAMER_LIGHT\\([0-9]+, ([a-z][a-z0-9_]*), ")
    message(FATAL_ERROR "${lights_def}: can't read: ${line}")
  endif()
  string(APPEND text "#include \"shaders/lights/${CMAKE_MATCH_1}.glsl\"\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/include/common/lights/all_lights.inc
  CONTENT "${text}" @ONLY)
