# The libraries that the libraries of voussoir (base, geometry, solver, io) need. The build and find_package(voussoir) read
# this file. All are required.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(fmt REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(OpenSSL 3.0 REQUIRED COMPONENTS Crypto)
find_package(PkgConfig REQUIRED)
# The serial HDF5. The dependencies of VTK also install the MPI build, and the two must not be mixed.
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)
# Debian's Ceres links ATLAS. The dense kernels of CHOLMOD must come from the BLAS of the system (OpenBLAS) instead.
set(BLA_VENDOR Generic)
find_package(Ceres 2.1 REQUIRED)
get_target_property(ceres_needs Ceres::ceres INTERFACE_LINK_LIBRARIES)
list(FILTER ceres_needs EXCLUDE REGEX "f77blas|atlas")
set_target_properties(Ceres::ceres PROPERTIES INTERFACE_LINK_LIBRARIES "${ceres_needs}")
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
if(NOT TARGET voussoir_cholmod)
  add_library(voussoir_cholmod UNKNOWN IMPORTED)
  set_target_properties(voussoir_cholmod PROPERTIES IMPORTED_LOCATION ${CHOLMOD_LIBRARY})
endif()
