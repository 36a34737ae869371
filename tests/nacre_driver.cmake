# SPDX-License-Identifier: LGPL-2.1-or-later
# Tests of a program in Python that lists them, a line each, by --list: NAME,
# or NAME RANKS. A line becomes the test FOLDER/NAME, or FOLDER/NAME.npRANKS,
# and the program is called with Nacre's, RANKS if given, and NAME.
#   nacre_driver(FOLDER program.py [TIMEOUT seconds])
find_program(PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
function(nacre_driver folder program)
  cmake_parse_arguments(ARGUMENT "" "TIMEOUT" "" ${ARGN})
  set(driver ${CMAKE_CURRENT_SOURCE_DIR}/${program})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${driver})
  execute_process(COMMAND ${PYTHON3} ${driver} --list
    OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "\n" ";" lines "${lines}")
  foreach(line ${lines})
    separate_arguments(words UNIX_COMMAND ${line})
    list(POP_FRONT words name)
    set(test ${folder}/${name})
    if(words)
      string(APPEND test .np${words})
    endif()
    add_test(NAME ${test}
      COMMAND ${PYTHON3} ${driver} $<TARGET_FILE:nacre> ${words} ${name})
    if(words)
      set_tests_properties(${test} PROPERTIES PROCESSORS ${words})
    endif()
    # For tests/mutations
    set_property(GLOBAL PROPERTY nacre_study/${test}
      ${PYTHON3} ${driver} $<TARGET_FILE:nacre> ${words} ${name})
    if(ARGUMENT_TIMEOUT)
      set_tests_properties(${test} PROPERTIES TIMEOUT ${ARGUMENT_TIMEOUT})
    endif()
  endforeach()
endfunction()
