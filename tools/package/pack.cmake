# cpack: the Debian packages voussoir and libvoussoir-dev (-G DEB), and an archive of both that runs from any folder
# (-G TZST). Included after install.cmake.
set(CPACK_PACKAGE_NAME voussoir)
set(CPACK_PACKAGE_VENDOR "The voussoir authors")
# This address does not exist. Whoever publishes packages must give an address.
set(VOUSSOIR_MAINTAINER "The voussoir authors <voussoir@example.org>" CACHE STRING "Maintainer of the Debian packages: NAME <ADDRESS>")
set(CPACK_PACKAGE_CONTACT "${VOUSSOIR_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "masonry arch bridges, stone by stone")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB TZST)
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_THREADS 2)
# The name shows if a package runs only on processors like the one on which it was built.
string(TOLOWER "${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}" system)
set(CPACK_SYSTEM_NAME ${system})
if(VOUSSOIR_NATIVE)
  string(APPEND CPACK_SYSTEM_NAME "-native")
endif()
set(CPACK_PACKAGE_FILE_NAME voussoir-${PROJECT_VERSION}-${CPACK_SYSTEM_NAME})

set(CPACK_COMPONENTS_ALL runtime development)
set(debian_packages voussoir libvoussoir-dev)
if(TARGET voussoir_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  list(APPEND debian_packages python3-voussoir)
endif()
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Computes masonry arch bridges by the distinct element method: every stone is a
rigid body, and every joint can open, slide and break. The program builds a
bridge from its dimensions, brings it to rest under its weight, loads or shakes
it, and shows where it cracks. The package also contains cases, vehicles,
tutorials and documentation.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Static libraries, headers and a CMake package (find_package(voussoir)) for
programs that build and run models of voussoir themselves.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python package that runs models of voussoir in the Python process: cases as
dictionaries, callbacks, the state as numpy arrays, modes, diagnosis, rating.")
if(VOUSSOIR_NATIVE)
  foreach(component RUNTIME DEVELOPMENT PYTHON)
    string(APPEND CPACK_COMPONENT_${component}_DESCRIPTION "
This package was compiled for the processor of the machine on which it was built.")
  endforeach()
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME voussoir)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Every run draws pictures. They need a virtual display and the fonts of the drawings.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "xvfb, libgl1-mesa-dri, fonts-liberation | fonts-dejavu-core")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "libopenblas0-pthread, man-db, bash-completion")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "chromium, paraview, libvoussoir-dev")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-voussoir)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
math(EXPR next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy, voussoir (= ${PROJECT_VERSION}-1)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_BINARY_DIR}/debian/postinst ${CMAKE_CURRENT_BINARY_DIR}/debian/prerm)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libvoussoir-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "g++, pkg-config, libeigen3-dev, libfmt-dev, nlohmann-json3-dev, libtomlplusplus-dev, libssl-dev, libhdf5-dev, libceres-dev, libsuitesparse-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, voussoir")
if(VOUSSOIR_NATIVE)
  set(deb_end _native)
endif()

# Architecture and file names follow those of Debian's own packages.
find_program(DPKG dpkg)
if(DPKG)
  execute_process(COMMAND ${DPKG} --print-architecture OUTPUT_VARIABLE architecture OUTPUT_STRIP_TRAILING_WHITESPACE)
  foreach(package ${debian_packages})
    string(REPLACE "libvoussoir-dev" DEVELOPMENT component ${package})
    string(REPLACE "python3-voussoir" PYTHON component ${component})
    string(REPLACE "voussoir" RUNTIME component ${component})
    set(CPACK_DEBIAN_${component}_FILE_NAME ${package}_${PROJECT_VERSION}-1_${architecture}${deb_end}.deb)
  endforeach()
endif()

# Files that Debian requires in the documentation of each package: the licence in Debian's format, and compressed
# changelogs.
file(READ LICENSE licence)
string(REGEX REPLACE "^[^\n]*\n\nCopyright \\(c\\) ([^\n]*)\n\n" "" terms "${licence}")
set(holder "${CMAKE_MATCH_1}")
string(STRIP "${terms}" terms)
string(REGEX REPLACE "\n\n" "\n.\n" terms "${terms}")
string(REGEX REPLACE "\n" "\n " terms "${terms}")
set(debian ${CMAKE_CURRENT_BINARY_DIR}/debian)
file(CONFIGURE OUTPUT ${debian}/copyright CONTENT "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: voussoir

Files: *
Copyright: ${holder}
License: BSD-3-Clause
 ${terms}
")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # from SOURCE_DATE_EPOCH if that is set
foreach(package ${debian_packages})
  file(CONFIGURE OUTPUT ${debian}/${package}/changelog.Debian CONTENT "voussoir (${PROJECT_VERSION}-1) unstable; urgency=medium

  * Made from the sources by cpack. The changes of the program are listed in
    /usr/share/doc/voussoir/changelog.gz.

 -- ${VOUSSOIR_MAINTAINER}  ${date}
")
  configure_file(CHANGELOG.md ${debian}/${package}/changelog COPYONLY)
  execute_process(COMMAND ${GZIP} -9nf ${debian}/${package}/changelog ${debian}/${package}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
endforeach()
install(FILES ${debian}/copyright ${debian}/voussoir/changelog.gz ${debian}/voussoir/changelog.Debian.gz
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(FILES ${debian}/copyright ${debian}/libvoussoir-dev/changelog.gz ${debian}/libvoussoir-dev/changelog.Debian.gz
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libvoussoir-dev COMPONENT development)
if(TARGET voussoir_python)
  install(FILES ${debian}/copyright ${debian}/python3-voussoir/changelog.gz ${debian}/python3-voussoir/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-voussoir COMPONENT python)
  # Python compiles the package when it is installed. The compiled files are removed together with it.
  file(WRITE ${debian}/postinst "#!/bin/sh\nset -e\nif [ \"$1\" = configure ] && command -v py3compile >/dev/null; then py3compile -p python3-voussoir; fi\n")
  file(WRITE ${debian}/prerm "#!/bin/sh\nset -e\nif command -v py3clean >/dev/null; then py3clean -p python3-voussoir; fi\n")
  file(CHMOD ${debian}/postinst ${debian}/prerm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endif()
include(CPack)
