# cmake --install BUILD --prefix PREFIX: the programs, what systemd wants to know, man pages; with --component service
# no window, which client/gui installs.
install(TARGETS metamer metamerd metamer-worker metamer-file-formats
  RUNTIME DESTINATION bin COMPONENT service
  LIBRARY DESTINATION bin COMPONENT service)  # the module lies beside the programs that load it
foreach(page metamer.1 metamerd.8 metamerd.toml.5)
  string(REGEX REPLACE ".*\\." "" section ${page})
  install(FILES ${CMAKE_BINARY_DIR}/man/${page} DESTINATION share/man/man${section} COMPONENT service)
endforeach()
install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")" COMPONENT service)
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/systemd/place.cmake COMPONENT service)
