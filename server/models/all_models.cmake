# Writes all_models.inc: the shared structs, each model's parameter struct, and each model's source,
# in the order of models.def. C++ includes it once for f32 and once for f64.
set(models_def ${CMAKE_CURRENT_SOURCE_DIR}/models/models.def)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${models_def})
file(STRINGS ${models_def} lines REGEX "^METAMER_MODEL\\(")
set(text "// Written by server/models/all_models.cmake from models.def.\n")
string(APPEND text "#include \"shaders/models/lobes.glsl\"\n")
string(APPEND text "#define METAMER_PARAMETER(name, ...) Real name;\n")
string(APPEND text "#define METAMER_MODEL(number, name, Type, citation, ...) \\\n")
string(APPEND text "  struct Type { Real diffuseness; Real specularness; __VA_ARGS__ };\n")
string(APPEND text "#include \"server/models/models.def\"\n")
string(APPEND text "#undef METAMER_MODEL\n#undef METAMER_PARAMETER\n")
foreach(line ${lines})
  string(REGEX REPLACE "^METAMER_MODEL\\([0-9]+, ([a-z0-9_]+),.*" "\\1" name "${line}")
  string(APPEND text "#include \"shaders/models/${name}.glsl\"\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/include/server/models/all_models.inc
  CONTENT "${text}" @ONLY)
target_include_directories(metamer_render PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/include)
