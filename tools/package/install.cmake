# cmake --install: the program with what it reads (component runtime), and the libraries for other programs (component
# development). All paths between installed files are relative, so a prefix may be moved.
include(CMakePackageConfigHelpers)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # only the target `installed` must be built
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/voussoir)
set(shipped_folder ${CMAKE_INSTALL_DATADIR}/voussoir)

install(TARGETS voussoir RUNTIME COMPONENT runtime)
install(TARGETS voussoir_mesher LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/voussoir COMPONENT runtime)
if(TARGET voussoir_cutter)
  install(TARGETS voussoir_cutter LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/voussoir COMPONENT runtime)
endif()
install(DIRECTORY cases DESTINATION ${shipped_folder} COMPONENT runtime)
# README, docs and cases keep their relative positions of the source tree, so that the links between them work.
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime
        PATTERN draw-house EXCLUDE PATTERN draw-pictures EXCLUDE PATTERN example-project EXCLUDE)
cmake_path(RELATIVE_PATH shipped_folder BASE_DIRECTORY ${CMAKE_INSTALL_DOCDIR} OUTPUT_VARIABLE from_docs)
install(CODE "file(CREATE_LINK ${from_docs}/cases \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}/cases\" SYMBOLIC)" COMPONENT runtime)

# The installed program makes the manual pages and the completion from the descriptions that --help prints.
set(manual ${CMAKE_CURRENT_BINARY_DIR}/manual)
find_program(GZIP gzip REQUIRED)
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" -E rm -rf \"${manual}\")
execute_process(COMMAND \"$<TARGET_FILE:voussoir>\" manual \"${manual}\" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB pages \"${manual}/man1/*.1\")
execute_process(COMMAND \"${GZIP}\" -9n \${pages} COMMAND_ERROR_IS_FATAL ANY)" COMPONENT runtime)
install(DIRECTORY ${manual}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT runtime)
install(DIRECTORY ${manual}/completions DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion COMPONENT runtime)

# The Python package, for the Python that it was compiled for (component python).
if(TARGET voussoir_python)
  set(python_packages lib/python3/dist-packages)
  install(TARGETS voussoir_python LIBRARY DESTINATION ${python_packages}/voussoir COMPONENT python)
  install(FILES ${python_files} DESTINATION ${python_packages}/voussoir COMPONENT python)
endif()

# Libraries for other programs: cases, assemblies and runs. Pictures are not included, because they need VTK.
foreach(room flags base geometry solver io)
  set_target_properties(voussoir_${room} PROPERTIES EXPORT_NAME ${room})
  install(TARGETS voussoir_${room} EXPORT voussoir ARCHIVE COMPONENT development)
endforeach()
install(DIRECTORY geometry solver io DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/voussoir COMPONENT development FILES_MATCHING PATTERN "*.h"
        PATTERN io/vtk EXCLUDE PATTERN geometry/gmsh EXCLUDE PATTERN geometry/cgal EXCLUDE)
install(EXPORT voussoir NAMESPACE voussoir:: FILE voussoirTargets.cmake DESTINATION ${cmake_folder} COMPONENT development)
configure_package_config_file(tools/package/voussoirConfig.cmake.in voussoirConfig.cmake INSTALL_DESTINATION ${cmake_folder})
write_basic_package_version_file(voussoirConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/voussoirConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/voussoirConfigVersion.cmake tools/package/libraries.cmake
        DESTINATION ${cmake_folder} COMPONENT development)
# Programs must compile inline functions for the same processor as the libraries.
string(REGEX MATCHALL "-m[^ ]+" processor_flags "${CMAKE_CXX_FLAGS}")
target_compile_options(voussoir_flags INTERFACE "$<INSTALL_INTERFACE:${processor_flags}>")
install(DIRECTORY docs/example-project DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libvoussoir-dev COMPONENT development)
