# SPDX-License-Identifier: LGPL-2.1-or-later
# Flags that every library and program of Nacre shares.
function(nacre_target name)
  deal_ii_setup_target(${name})
  # Debug symbols cost a third of the compile time; Debian's flags have them in
  # Release, too.
  if(CMAKE_BUILD_TYPE STREQUAL "Release" OR NOT NACRE_DEBUG_SYMBOLS)
    target_compile_options(${name} PRIVATE -g0)
  endif()
  if(NACRE_WERROR)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
endfunction()
