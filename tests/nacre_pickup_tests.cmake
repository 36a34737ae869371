# SPDX-License-Identifier: LGPL-2.1-or-later
# The tests of a folder in the grammar of deal.II's test suite: name.cc or
# name.prm beside name.output, name.mpirun=2.output, name.release.output. They
# run and compare by deal.II's scripts. deal.II's own macro has each test call
# the build tool, which compiles an empty file and links the program again, one
# test at a time; here `test_programs` has built all of them before.
find_program(NUMDIFF_EXECUTABLE numdiff REQUIRED)
# deal.II links with gold where it is, which takes three times as long.
find_program(LLD_EXECUTABLE ld.lld)
set(NACRE_RUN_TEST ${CMAKE_CURRENT_LIST_DIR}/run_test.sh
                   ${DEAL_II_PATH}/${DEAL_II_SHARE_RELDIR}/scripts)

# The program of FOLDER/name.cc, once for all numbers of ranks.
function(nacre_test_program target name)
  if(TARGET ${target})
    return()
  endif()
  add_executable(${target} EXCLUDE_FROM_ALL ${name}.cc)
  nacre_target(${target})
  target_link_libraries(${target} libnacre)
  target_compile_definitions(${target} PRIVATE
    SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}")
  if(LLD_EXECUTABLE)
    target_link_options(${target} PRIVATE -fuse-ld=lld)
  endif()
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name}
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${name}.program)
endfunction()

function(nacre_pickup_tests)
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  string(TOLOWER ${CMAKE_BUILD_TYPE} type)
  file(GLOB outputs *.output)
  foreach(output ${outputs})
    get_filename_component(file ${output} NAME)
    string(REGEX MATCH
      "^([^.]+)(\\.mpirun=([0-9]+))?(\\.(debug|release))?\\.output$"
      grammar ${file})
    if(NOT grammar)
      message(FATAL_ERROR "${output}: not NAME[.mpirun=N][.release].output")
    endif()
    set(name ${CMAKE_MATCH_1})
    set(variant "${CMAKE_MATCH_2}")
    set(ranks ${CMAKE_MATCH_3})
    if(CMAKE_MATCH_5 AND NOT CMAKE_MATCH_5 STREQUAL type)
      continue()
    endif()
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${name}.cc)
      nacre_test_program(${folder}.${name}.${type} ${name})
      set(command $<TARGET_FILE:${folder}.${name}.${type}>)
    else()
      set(command $<TARGET_FILE:nacre> ${CMAKE_CURRENT_SOURCE_DIR}/${name}.prm)
    endif()
    if(ranks)
      list(PREPEND command ${DEAL_II_MPIEXEC} ${DEAL_II_MPIEXEC_NUMPROC_FLAG}
           ${ranks} ${DEAL_II_MPIEXEC_PREFLAGS})
    endif()
    set(test ${folder}/${name}${variant}.${type})
    set(run_folder ${CMAKE_CURRENT_BINARY_DIR}/${name}${variant}.${type})
    file(MAKE_DIRECTORY ${run_folder})
    add_test(NAME ${test} WORKING_DIRECTORY ${run_folder}
      COMMAND sh ${NACRE_RUN_TEST} ${test} ${NUMDIFF_EXECUTABLE} ${output}
              ${command})
    set_tests_properties(${test} PROPERTIES TIMEOUT 600)
    if(ranks)
      set_tests_properties(${test} PROPERTIES PROCESSORS 2)
    endif()
  endforeach()
endfunction()
