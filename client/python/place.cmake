# What `cmake --install` does of the package `metamer`: its modules where Debian's Python looks for them, and metamer-bench.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(python_version python3)
endif()
set(root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
file(GLOB described "${built}/*.egg-info")
# Which looks at DESTDIR by itself; the rest does not.
file(INSTALL "${built}/metamer" ${described} DESTINATION "${CMAKE_INSTALL_PREFIX}/lib/${python_version}/dist-packages"
  PATTERN __pycache__ EXCLUDE)
file(WRITE "${root}/bin/metamer-bench"
  "#!/usr/bin/python3\nimport sys\n\nfrom metamer.bench import main\n\nsys.exit(main())\n")
file(CHMOD "${root}/bin/metamer-bench" PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
