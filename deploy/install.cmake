# cmake --install BUILD --prefix PREFIX [--component COMPONENT]: the programs, what systemd and a desktop want to know, man
# pages. Each component is a Debian package (debian/): each file is of exactly one.
install(TARGETS metamerd RUNTIME DESTINATION bin COMPONENT daemon)
install(TARGETS metamer-worker RUNTIME DESTINATION bin COMPONENT worker)
install(TARGETS metamer RUNTIME DESTINATION bin COMPONENT cli)
install(TARGETS metamer-file-formats LIBRARY DESTINATION lib/metamer COMPONENT formats)  # common/image/file_formats
install(FILES ${CMAKE_BINARY_DIR}/man/metamer.1 DESTINATION share/man/man1 COMPONENT cli)
install(FILES ${CMAKE_BINARY_DIR}/man/metamerd.8 DESTINATION share/man/man8 COMPONENT daemon)
install(FILES ${CMAKE_BINARY_DIR}/man/metamerd.toml.5 DESTINATION share/man/man5 COMPONENT daemon)
install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")" COMPONENT daemon)
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/systemd/place.cmake COMPONENT daemon)
set(METAMER_COMPONENTS daemon worker cli formats)

if(TARGET metamer-gui)
  install(TARGETS metamer-gui RUNTIME DESTINATION bin COMPONENT gui)
  install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/booth DESTINATION share/metamer COMPONENT gui
    PATTERN make EXCLUDE PATTERN *.png EXCLUDE)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/desktop/metamer-gui.desktop DESTINATION share/applications COMPONENT gui)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/desktop/metamer.svg DESTINATION share/icons/hicolor/scalable/apps COMPONENT gui)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/desktop/metamer-scene.xml DESTINATION share/mime/packages COMPONENT gui)
  list(APPEND METAMER_COMPONENTS gui)
endif()

# Where Debian's Python looks: /usr/lib/python3/dist-packages, or another prefix's of its version.
if(TARGET metamer_python)
  execute_process(COMMAND ${METAMER_PYTHON} -c "import sys; print('python%d.%d' % sys.version_info[:2])"
    OUTPUT_VARIABLE python_version OUTPUT_STRIP_TRAILING_WHITESPACE)
  install(CODE "set(python_version ${python_version})\nset(built \"${CMAKE_BINARY_DIR}/python\")" COMPONENT python)
  install(SCRIPT ${PROJECT_SOURCE_DIR}/client/python/place.cmake COMPONENT python)
  list(APPEND METAMER_COMPONENTS python)
endif()

include(${CMAKE_CURRENT_LIST_DIR}/debian/cpack.cmake)
