# Pamgen, the mesh generator of Trilinos. Its own CMake config asks for the compilers that Trilinos was built with.
find_path(Pamgen_INCLUDE_DIR create_inline_mesh.h PATH_SUFFIXES trilinos)
find_library(Pamgen_LIBRARY NAMES trilinos_pamgen pamgen)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Pamgen REQUIRED_VARS Pamgen_LIBRARY Pamgen_INCLUDE_DIR)
if(Pamgen_FOUND AND NOT TARGET Pamgen::Pamgen)
  add_library(Pamgen::Pamgen UNKNOWN IMPORTED)
  set_target_properties(Pamgen::Pamgen PROPERTIES IMPORTED_LOCATION ${Pamgen_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${Pamgen_INCLUDE_DIR})
endif()
