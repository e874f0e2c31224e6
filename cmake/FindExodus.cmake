# Exodus II ships neither a CMake config nor a pkg-config file in Debian: library exoIIv2c, header exodusII.h.
find_path(Exodus_INCLUDE_DIR exodusII.h)
find_library(Exodus_LIBRARY NAMES exoIIv2c exodus)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Exodus REQUIRED_VARS Exodus_LIBRARY Exodus_INCLUDE_DIR)
if(Exodus_FOUND AND NOT TARGET Exodus::Exodus)
  add_library(Exodus::Exodus UNKNOWN IMPORTED)
  set_target_properties(Exodus::Exodus PROPERTIES IMPORTED_LOCATION ${Exodus_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${Exodus_INCLUDE_DIR})
endif()
