# Writes OUTPUT: every file of FILES below FOLDER as a raw string, under its path. Run by
# server/CMakeLists.txt at build time, so that an edited shader is embedded anew.
set(text "#include \"server/gl/model_source.h\"\n\nnamespace metamer::gl {\n\n")
string(APPEND text "std::string_view shader_text(std::string_view path) {\n")
foreach(file ${FILES})
  file(READ ${FOLDER}/${file} content)
  string(APPEND text "  if (path == \"${file}\") return R\"glsl(${content})glsl\";\n")
endforeach()
string(APPEND text "  return {};\n}\n\n}  // namespace metamer::gl\n")
file(WRITE ${OUTPUT} "${text}")
