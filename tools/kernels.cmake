# The innermost loops of a step for AVX2 (x86-64-v3) and AVX-512 (x86-64-v4), beside those that all processors run: one
# program for every x86-64 (solver/model/kernels.h). Each set is compiled by itself and linked into one object in which
# nothing but its table is seen from outside: what headers define inline cannot get mixed up between the sets. Left out
# where everything is compiled for one processor, and in builds with sanitizers.
set(kernel_sources solver/contact/contact_lanes.cpp solver/contact/interface_lanes.cpp solver/contact/joint_lanes.cpp
    solver/contact/pairs.cpp solver/fill/nodes.cpp solver/fill/tet_flow.cpp solver/fill/tet_lanes.cpp
    solver/fill/tet_stress.cpp solver/step/body_pass.cpp solver/step/kernel_table.cpp)
if(VOUSSOIR_NATIVE OR VOUSSOIR_SANITIZE OR VOUSSOIR_FUZZ OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  return()
endif()
foreach(level v3 v4)
  set(kernels voussoir_kernels_${level})
  add_library(${kernels} OBJECT ${kernel_sources})
  target_link_libraries(${kernels} PRIVATE voussoir_flags fmt::fmt Eigen3::Eigen OpenMP::OpenMP_CXX nlohmann_json::nlohmann_json)
  target_include_directories(${kernels} SYSTEM PRIVATE ${CHOLMOD_INCLUDE} ${SPECTRA_INCLUDE})
  target_compile_options(${kernels} PRIVATE -march=x86-64-${level})
  target_compile_definitions(${kernels} PRIVATE VOUSSOIR_KERNEL_TABLE=${kernels})
  set(whole ${CMAKE_CURRENT_BINARY_DIR}/${kernels}.o)
  add_custom_command(OUTPUT ${whole} DEPENDS ${kernels} $<TARGET_OBJECTS:${kernels}> COMMAND_EXPAND_LISTS VERBATIM
                     COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${whole}.all $<TARGET_OBJECTS:${kernels}>
                     COMMAND ${CMAKE_OBJCOPY} --keep-global-symbol=${kernels} ${whole}.all ${whole}
                     COMMENT "Kernels for x86-64-${level}")
  set_source_files_properties(${whole} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  target_sources(voussoir_solver PRIVATE ${whole})
endforeach()
set_source_files_properties(solver/step/kernels.cpp PROPERTIES COMPILE_DEFINITIONS VOUSSOIR_MANY_KERNELS)
# The narrower ones, for the tests.
set(VOUSSOIR_KERNEL_NAMES avx2 sse2)
