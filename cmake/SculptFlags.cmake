# Flags of every room. Nothing that changes a floating-point value may stand here: the mesh must be the
# same to the last bit for any number of ranks (docs/architecture.md).
add_library(sculpt_flags INTERFACE)
target_compile_features(sculpt_flags INTERFACE cxx_std_20)
target_compile_options(sculpt_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wfloat-conversion -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false alarms on std::string in GCC 12
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  $<$<CONFIG:Release>:-O3>)
target_compile_definitions(sculpt_flags INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX
  SCULPT_VERSION="${PROJECT_VERSION}")
target_include_directories(sculpt_flags INTERFACE ${PROJECT_SOURCE_DIR}/include)
target_link_libraries(sculpt_flags INTERFACE fmt::fmt)
if(SCULPT_SANITIZE)
  target_compile_options(sculpt_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(sculpt_flags INTERFACE -fsanitize=address,undefined)
endif()
