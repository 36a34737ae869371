# SPDX-License-Identifier: LGPL-2.1-or-later
# Wrong input and the command line, case by case, from a file for
# tests/parameters/bad_input.py: FOLDER/bad/<case>, FOLDER/good/<case>; every
# N-th one on two ranks, which take the same errors to all ranks.
find_program(PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
function(nacre_bad_input folder cases every)
  set(driver ${CMAKE_SOURCE_DIR}/tests/parameters/bad_input.py)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${driver} ${cases})
  execute_process(COMMAND ${PYTHON3} ${driver} --list ${cases}
    OUTPUT_VARIABLE names COMMAND_ERROR_IS_FATAL ANY
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "\n" ";" names "${names}")
  set(number 0)
  foreach(name ${names})
    math(EXPR number "(${number} + 1) % ${every}")
    set(ranks 1)
    if(number EQUAL 1)
      set(ranks 2)
    endif()
    add_test(NAME ${folder}/${name}.np${ranks}
      COMMAND ${PYTHON3} -S ${driver} $<TARGET_FILE:nacre> ${ranks} ${cases}
              ${name})
    # bad_input.py itself ends what hangs, after 20 seconds a run.
    set_tests_properties(${folder}/${name}.np${ranks} PROPERTIES
      TIMEOUT 100 PROCESSORS ${ranks})
  endforeach()
endfunction()
