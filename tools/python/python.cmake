# The Python package voussoir: the module _voussoir, compiled for the Python that is found, beside files of Python. In the
# build tree it lies in python/ (PYTHONPATH). Left out where there is no pybind11.
set(PYBIND11_FINDPYTHON ON)
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)  # of the system, as its libraries are; others on request
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.11 QUIET COMPONENTS Interpreter Development.Module)
if(Python_FOUND)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
if(NOT Python_FOUND OR NOT pybind11_FOUND OR VOUSSOIR_SANITIZE OR VOUSSOIR_FUZZ)
  message(STATUS "No Python package (Debian: python3-dev pybind11-dev python3-numpy; not in builds with sanitizers)")
  return()
endif()
set(python_folder ${CMAKE_CURRENT_BINARY_DIR}/python/voussoir)
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/python/module/*.cpp)
add_library(voussoir_python MODULE ${sources})
compile_as_one(voussoir_python)
target_link_libraries(voussoir_python PRIVATE voussoir_verbs pybind11::module)
target_precompile_headers(voussoir_python REUSE_FROM voussoir_precompiled)
set_target_properties(voussoir_python PROPERTIES PREFIX "" OUTPUT_NAME _voussoir SUFFIX ".${Python_SOABI}${CMAKE_SHARED_MODULE_SUFFIX}"
                      LIBRARY_OUTPUT_DIRECTORY ${python_folder} DEFINE_SYMBOL "")
file(GLOB python_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/python/voussoir/*.py ${PROJECT_SOURCE_DIR}/tools/python/voussoir/*.pyi
     ${PROJECT_SOURCE_DIR}/tools/python/voussoir/py.typed)
file(MAKE_DIRECTORY ${python_folder})
foreach(file ${python_files})
  cmake_path(GET file FILENAME name)
  file(CREATE_LINK ${file} ${python_folder}/${name} SYMBOLIC)
endforeach()
