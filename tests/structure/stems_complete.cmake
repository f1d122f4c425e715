# A pass is one stem: header, shared struct file, shaders, reference, test, benchmark.  cmake -DSOURCE=<root> -P …
# Headers of passes/ that are no pass.
cmake_minimum_required(VERSION 3.25)
set(shared draw_list)
# Passes that compute nothing of their own (another stem's reference covers them).
set(without_reference sorted_forward)
# Parts that are still to be written.  An entry whose file exists is an error too, so the list only shrinks.
set(known_gaps
  tests/passes/gbuffer.cpp tests/passes/lighting.cpp tests/passes/sorted_forward.cpp tests/passes/tonemap.cpp
  benchmarks/gbuffer.cpp benchmarks/lighting.cpp benchmarks/sorted_forward.cpp benchmarks/tonemap.cpp)

set(stems 0)
file(GLOB headers RELATIVE ${SOURCE}/include/pellucid/passes ${SOURCE}/include/pellucid/passes/*.hpp)
foreach(header IN LISTS headers)
  string(REGEX REPLACE "\\.hpp$" "" stem ${header})
  if(stem IN_LIST shared OR stem MATCHES "-inl$")
    continue()
  endif()
  math(EXPR stems "${stems} + 1")
  set(parts include/pellucid/gpu/${stem}.h shaders/${stem} tests/passes/${stem}.cpp benchmarks/${stem}.cpp)
  if(NOT stem IN_LIST without_reference)
    list(APPEND parts include/pellucid/reference/${stem}.hpp)
  endif()
  foreach(part IN LISTS parts)
    if(NOT EXISTS ${SOURCE}/${part} AND NOT part IN_LIST known_gaps)
      message(SEND_ERROR "the pass '${stem}' lacks ${part}")
    endif()
  endforeach()
  # Every pass is instantiated for the null backend.
  file(STRINGS ${SOURCE}/tests/passes/archetype.cpp found REGEX "pellucid/passes/${stem}\\.hpp")
  if(NOT found)
    message(SEND_ERROR "the pass '${stem}' is not in tests/passes/archetype.cpp")
  endif()
endforeach()
foreach(gap IN LISTS known_gaps)
  if(EXISTS ${SOURCE}/${gap})
    message(SEND_ERROR "${gap} exists now: take it out of known_gaps")
  endif()
endforeach()
if(stems EQUAL 0)
  message(FATAL_ERROR "no pass was found under ${SOURCE}: the scan is broken")
endif()
message(STATUS "${stems} passes")
