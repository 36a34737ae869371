# SPDX-License-Identifier: LGPL-2.1-or-later
# Tests of whole parameter files, by run_study.py.
find_program(PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
get_filename_component(PRM_FOLDER ${CMAKE_CURRENT_LIST_DIR}/../prm ABSOLUTE)

# nacre_study(NAME prm-file [SET parameter=value...] [RANKS n]
#             [COMPARE_RANKS n...] [COMPARE_SET parameter=value...]
#             [EXPECT expectation...])
# The file is relative to prm/; see run_study.py for the expectations.
function(nacre_study name prm)
  cmake_parse_arguments(PARSE_ARGV 2 study "" "RANKS"
                        "SET;COMPARE_RANKS;COMPARE_SET;EXPECT")
  set(arguments)
  foreach(override IN LISTS study_SET)
    list(APPEND arguments --set ${override})
  endforeach()
  if(study_RANKS)
    list(APPEND arguments --ranks ${study_RANKS})
  endif()
  foreach(override IN LISTS study_COMPARE_SET)
    list(APPEND arguments --compare-set ${override})
  endforeach()
  foreach(expectation IN LISTS study_EXPECT)
    list(APPEND arguments --expect ${expectation})
  endforeach()
  set(command ${PYTHON3} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/run_study.py
              $<TARGET_FILE:nacre> ${PRM_FOLDER}/${prm} ${arguments})
  # For tests/mutations, which compare no ranks
  set_property(GLOBAL PROPERTY nacre_study/${name} "${command}")
  foreach(ranks IN LISTS study_COMPARE_RANKS)
    list(APPEND command --compare-ranks ${ranks})
  endforeach()
  add_test(NAME ${name} COMMAND ${command})
  if(study_RANKS OR study_COMPARE_RANKS)
    set_tests_properties(${name} PROPERTIES PROCESSORS 2)
  endif()
endfunction()
