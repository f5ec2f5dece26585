# Run by cpack before it packs what lies there: what Debian wants of each package beside its files.
set(debian ${CPACK_METAMER_SOURCE}/deploy/debian)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component ${CPACK_COMPONENTS_ALL})
  set(staged ${CPACK_TEMPORARY_DIRECTORY}/${component})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(documents ${staged}/usr/share/doc/${package})
  file(MAKE_DIRECTORY ${documents})
  file(COPY_FILE ${debian}/copyright ${documents}/copyright)
  if(component STREQUAL "gui")
    file(READ ${debian}/copyright.gui more)
    file(APPEND ${documents}/copyright "${more}")
  endif()
  file(WRITE ${documents}/changelog "metamer (${CPACK_DEBIAN_PACKAGE_VERSION}) bookworm; urgency=medium

  * See CHANGELOG.md of the sources.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
  file(GLOB_RECURSE pages ${staged}/usr/share/man/*)
  list(FILTER pages EXCLUDE REGEX "\\.gz$")
  execute_process(COMMAND gzip -9nf ${documents}/changelog ${pages} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND chmod -R u=rwX,go=rX ${documents} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
