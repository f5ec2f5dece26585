# The CIE's tables become part of metamer_color at build time; the binaries don't need the package.
set(METAMER_COLORD_DATA /usr/share/colord CACHE PATH
  "The CIE tables of Debian's package colord-data (folders cmf, illuminant, ref)")
file(GLOB cie_files CONFIGURE_DEPENDS
  ${METAMER_COLORD_DATA}/cmf/CIE*.cmf ${METAMER_COLORD_DATA}/illuminant/CIE-*.sp
  ${METAMER_COLORD_DATA}/ref/CIE-TCS.sp
  ${METAMER_COLORD_DATA}/ref/CIE-1986-daylight-SPD.cmf)
if(NOT EXISTS ${METAMER_COLORD_DATA}/ref/CIE-TCS.sp)
  message(FATAL_ERROR
    "The CIE tables are not in ${METAMER_COLORD_DATA}. Install the package colord-data "
    "(apt install colord-data), or set METAMER_COLORD_DATA to the folder that has them.")
endif()

add_executable(embed_cie spectral/embed/embed_cie_main.cpp)
target_link_libraries(embed_cie PRIVATE metamer_spectrum)

set(cie_tables ${CMAKE_CURRENT_BINARY_DIR}/cie_tables.cpp)
add_custom_command(
  OUTPUT ${cie_tables}
  COMMAND embed_cie ${METAMER_COLORD_DATA} ${cie_tables}
  DEPENDS embed_cie ${cie_files}
  COMMENT "Embedding the CIE's tables")
target_sources(metamer_color PRIVATE ${cie_tables})
