# What `cmake --install` does besides copying: files that name the places where the rest is put.
set(root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
set(BINDIR ${CMAKE_INSTALL_PREFIX}/bin)
# A system's programs have their configuration in /etc.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(etc /etc/metamer)
else()
  set(etc ${CMAKE_INSTALL_PREFIX}/etc/metamer)
endif()
set(CONFIG ${etc}/metamerd.toml)

foreach(unit metamerd.service metamerd.socket)
  configure_file(${source}/deploy/systemd/${unit} ${root}/lib/systemd/system/${unit} @ONLY)
endforeach()
configure_file(${source}/deploy/systemd/metamer.sysusers ${root}/lib/sysusers.d/metamer.conf COPYONLY)
configure_file(${source}/deploy/systemd/metamer.tmpfiles ${root}/lib/tmpfiles.d/metamer.conf COPYONLY)

# What an administrator has written stays.
if(NOT EXISTS "$ENV{DESTDIR}${CONFIG}")
  configure_file(${source}/deploy/metamerd.toml "$ENV{DESTDIR}${CONFIG}" COPYONLY)
endif()
