# Writes built_with.h: the versions of the libraries, for `voussoir --version`, and the folder in which the program's own
# loadable libraries are installed.
function(version_in variable header regex)
  file(STRINGS ${header} lines REGEX ${regex})
  string(REGEX REPLACE "[^0-9.;]" "" numbers "${lines}")
  list(JOIN numbers "." numbers)
  set(${variable} ${numbers} PARENT_SCOPE)
endfunction()
version_in(gmsh_version ${GMSH_INCLUDE}/gmsh.h "define GMSH_API_VERSION ")
version_in(cholmod_version ${CHOLMOD_INCLUDE}/cholmod_core.h "define CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION ")
set(built_with "Eigen ${Eigen3_VERSION}" "CHOLMOD ${cholmod_version}" "Ceres ${Ceres_VERSION}" "HDF5 ${HDF5_VERSION}" "VTK ${VTK_VERSION}"
    "cairo ${CAIRO_cairo_VERSION}" "Gmsh ${gmsh_version}" "Boost ${Boost_VERSION_STRING}" "fmt ${fmt_VERSION}" "nlohmann-json ${nlohmann_json_VERSION}"
    "toml++ ${tomlplusplus_VERSION}" "OpenSSL ${OPENSSL_VERSION}")
if(CGAL_FOUND)
  list(APPEND built_with "CGAL ${CGAL_VERSION}")
endif()
if(GLPK_LIBRARY AND GLPK_INCLUDE)
  version_in(glpk_version ${GLPK_INCLUDE}/glpk.h "define GLP_(MAJOR|MINOR)_VERSION ")
  list(APPEND built_with "GLPK ${glpk_version}")
endif()
list(JOIN built_with ", " built_with)
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/commit/built_with.h
     CONTENT "#define VOUSSOIR_BUILT_WITH \"${built_with}\"\n#define VOUSSOIR_LIBRARY_FOLDER \"${CMAKE_INSTALL_LIBDIR}/voussoir\"\n")
