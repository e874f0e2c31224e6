# Test executables and their ctest entries. One entry per executable and number of ranks: starting MPI costs more than
# most tests.
find_package(MPI REQUIRED COMPONENTS CXX)

# A hang is a failure. The sanitizers slow everything down.
set(SCULPT_TEST_TIMEOUT 120)
# Open MPI takes these from the environment, other MPIs ignore them: start as root, more ranks than cores, no use of
# system calls that containers forbid.
set(SCULPT_TEST_ENVIRONMENT
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none)
if(SCULPT_SANITIZE)
  set(SCULPT_TEST_TIMEOUT 600)
  list(APPEND SCULPT_TEST_ENVIRONMENT ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1)  # MPI leaks at exit
endif()

# sculpt_test_properties(<test> <label> <ranks>)
function(sculpt_test_properties name label ranks)
  set_tests_properties(${name} PROPERTIES LABELS ${label} PROCESSORS ${ranks} TIMEOUT ${SCULPT_TEST_TIMEOUT}
    ENVIRONMENT "${SCULPT_TEST_ENVIRONMENT}")
endfunction()

# sculpt_test_program(<name> <folder> LIBRARIES <target>...): an executable of all sources of a folder with the shared
# main(). Private headers of the rooms are in reach, as "<room>/<header>.hpp".
function(sculpt_test_program name folder)
  cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  add_executable(${name} ${sources})
  # The code under test is optimised in its own libraries; compiling the tests should be quick. GCC notes that vector
  # types are passed differently by other compilers, and takes GoogleTest's macros after a plain `if` for a mistake.
  set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS "-O0;-Wno-psabi;-Wno-dangling-else")
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name} PRIVATE SCULPT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} sculpt_test_main)
endfunction()

# sculpt_unit_tests(<room> [LIBRARIES <target>...]): tests/unit/<room> against sculpt_<room>, on one rank.
function(sculpt_unit_tests room)
  cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
  sculpt_test_program(unit_${room} ${CMAKE_CURRENT_SOURCE_DIR}/unit/${room} LIBRARIES sculpt_${room} ${arg_LIBRARIES})
  add_test(NAME unit.${room} COMMAND unit_${room} --gtest_brief=1)
  sculpt_test_properties(unit.${room} unit 1)
endfunction()

# sculpt_parallel_tests(<folder> RANKS <n>... [LIBRARIES <target>...]): tests/parallel/<folder>, on every number of ranks.
function(sculpt_parallel_tests folder)
  cmake_parse_arguments(arg "" "" "RANKS;LIBRARIES" ${ARGN})
  set(program parallel_${folder})
  sculpt_test_program(${program} ${CMAKE_CURRENT_SOURCE_DIR}/parallel/${folder} LIBRARIES ${arg_LIBRARIES})
  foreach(n IN LISTS arg_RANKS)
    add_test(NAME parallel.${folder}.np${n} COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${n} ${MPIEXEC_PREFLAGS}
      $<TARGET_FILE:${program}> ${MPIEXEC_POSTFLAGS} --gtest_brief=1)
    sculpt_test_properties(parallel.${folder}.np${n} parallel ${n})
  endforeach()
endfunction()
