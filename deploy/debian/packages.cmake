# Read by cpack: what each package is called, says and needs. Libraries are found by dpkg-shlibdeps.
set(debian ${CPACK_METAMER_SOURCE}/deploy/debian)

# A commit says when it is from, so that what is made later is newer; a tag is what it says.
execute_process(COMMAND git -C ${CPACK_METAMER_SOURCE} describe --tags --match "v[0-9]*" --long --dirty
  RESULT_VARIABLE untagged OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git -C ${CPACK_METAMER_SOURCE} log -1 "--date=format:%Y%m%d.%H%M" --format=%cd.g%h
  RESULT_VARIABLE no_git OUTPUT_VARIABLE committed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(version ${CPACK_PACKAGE_VERSION})
if(NOT untagged AND described MATCHES "^v([0-9.]+)-([0-9]+)-(.*)$")
  set(version ${CMAKE_MATCH_1})
  if(CMAKE_MATCH_2 GREATER 0 OR CMAKE_MATCH_3 MATCHES dirty)
    string(REPLACE "-" "." rest ${CMAKE_MATCH_3})
    string(APPEND version "+${CMAKE_MATCH_2}.${rest}")
  endif()
elseif(NOT no_git)
  string(APPEND version "+git${committed}")
endif()

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_VERSION ${version})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

# metamer_package(COMPONENT NAME SECTION SUMMARY TEXT [FIELD VALUE]…): TEXT is what more the description says.
macro(metamer_package component name section summary text)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${text}")
  set(fields ${ARGN})
  while(fields)
    list(POP_FRONT fields field value)
    set(CPACK_DEBIAN_${upper}_${field} "${value}")
  endwhile()
endmacro()

metamer_package(daemon metamerd graphics "spectral render service: the daemon"
  "metamerd takes scenes from clients over sockets, queues them, has workers\nrender them by whole spectra, and says how accurate each picture is. It\nstarts at once, on a Unix socket alone: /etc/metamer/metamerd.toml says\nwhere else."
  PACKAGE_DEPENDS "metamer-worker (= ${version}), systemd | systemd-standalone-sysusers, systemd | systemd-standalone-tmpfiles"
  PACKAGE_RECOMMENDS "metamer (= ${version})"
  PACKAGE_SUGGESTS "slurm-client")
set(CPACK_DEBIAN_DAEMON_PACKAGE_CONTROL_EXTRA ${debian}/metamerd/postinst ${debian}/metamerd/prerm ${debian}/metamerd/postrm
  ${debian}/metamerd/conffiles)
metamer_package(worker metamer-worker graphics "spectral render service: the renderer"
  "metamer-worker renders what metamerd asks for, in a sandbox of its own: by\nray tracing on processors with AVX2, or by OpenGL 4.5. A node of a Slurm\ncluster needs this package alone."
  PACKAGE_RECOMMENDS "libegl1, libopengl0, libegl-mesa0, libgl1-mesa-dri")
metamer_package(cli metamer graphics "spectral render service: the command line"
  "metamer renders and watches scenes, compares and relights pictures, looks\nfor methods and metamers, and shows what models and spectra are. Without a\nserver of a name it starts one of its own, where metamerd is installed."
  PACKAGE_RECOMMENDS "metamerd (= ${version}), metamer-file-formats (= ${version})"
  PACKAGE_SUGGESTS "gnuplot-nox")
metamer_package(formats metamer-file-formats graphics "spectral render service: legends, labels and JPEGs"
  "A module of metamer and metamer-gui, apart for the many libraries that\nOpenImageIO brings: it draws the legends of compared pictures and the labels\nof contact sheets, and reads JPEGs. All else does without it."
  PACKAGE_DEPENDS "fonts-dejavu-core")
metamer_package(gui metamer-gui graphics "spectral render service: the window"
  "metamer-gui edits scenes and shows them live: lights, paints and methods\nchange while one looks, and pictures are relit without a ray."
  PACKAGE_RECOMMENDS "metamerd (= ${version}), metamer-file-formats (= ${version}), qt6-qpa-plugins"
  PACKAGE_SUGGESTS "metamer")
metamer_package(python python3-metamer python "spectral render service: the package for Python"
  "A client of metamerd: pictures and spectra as numpy arrays, relighting,\nviews, and metamer-bench, which says what got slower."
  PACKAGE_ARCHITECTURE all
  PACKAGE_SHLIBDEPS OFF
  PACKAGE_DEPENDS "python3 (>= 3.11), python3-numpy, python3-protobuf (>= 3.21)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${debian}/python3-metamer/postinst ${debian}/python3-metamer/prerm)
