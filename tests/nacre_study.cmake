# SPDX-License-Identifier: LGPL-2.1-or-later
# Tests of whole parameter files, by run_study.py.
find_program(PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)

# nacre_study(NAME prm-file [SET parameter=value...] [RANKS n]
#             [COMPARE_RANKS n...] [EXPECT expectation...])
# The file is relative to prm/; see run_study.py for the expectations.
function(nacre_study name prm)
  cmake_parse_arguments(PARSE_ARGV 2 study "" "RANKS"
                        "SET;COMPARE_RANKS;EXPECT")
  set(arguments)
  foreach(override IN LISTS study_SET)
    list(APPEND arguments --set ${override})
  endforeach()
  if(study_RANKS)
    list(APPEND arguments --ranks ${study_RANKS})
  endif()
  foreach(ranks IN LISTS study_COMPARE_RANKS)
    list(APPEND arguments --compare-ranks ${ranks})
  endforeach()
  foreach(expectation IN LISTS study_EXPECT)
    list(APPEND arguments --expect ${expectation})
  endforeach()
  add_test(NAME ${name} COMMAND ${PYTHON3}
           ${CMAKE_SOURCE_DIR}/tests/run_study.py $<TARGET_FILE:nacre>
           ${CMAKE_SOURCE_DIR}/prm/${prm} ${arguments})
  if(study_RANKS OR study_COMPARE_RANKS)
    set_tests_properties(${name} PROPERTIES PROCESSORS 2)
  endif()
endfunction()
