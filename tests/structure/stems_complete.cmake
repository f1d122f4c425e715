# A pass is one stem: header, shared struct file, shaders, reference, test, benchmark.  cmake -DSOURCE=<root> -P …
# Whoever is let off one of them is named here, with the reason; a name that is needed no more fails too.
cmake_minimum_required(VERSION 3.25)

# Headers of passes/ that are no pass: parts that several passes are made of.  They draw no picture of their own, so no
# reference and no benchmark could be of them alone.
set(helpers
  draw_list       # a list of draws and the loop over it
  fragment_desc   # a descriptor
  full_screen     # a triangle over the picture, with the shader of whoever owns it
  strip_bands     # arithmetic on the CPU
  layer_areas     # the same
  fragment_lists  # memory that methods of transparency walk
  list_compositor) # and what composites it
# Of those, the ones that are only a descriptor or a loop, or the common part of passes: every pass's test is theirs.
set(helpers_without_test draw_list fragment_desc list_compositor)
# Methods of transparency: what they draw is a whole picture, so their reference is the reference renderer, and one
# program measures those beside each other that have no benchmark of their own.
set(methods sorted_forward abuffer peel peel_seed dual_peel interleaved interleaved_skyx)
# Parts of a method that cannot do without: the counts in pictures of the reference renderer are their reference, and
# whoever measures the method measures them.
set(parts_of_methods layer_count)
# Passes whose formulae are those of another stem, or that another stem's benchmark measures beside its own.
set(light_volumes_reference lighting)
set(light_volumes_benchmark light_lists)
set(dfg_benchmark brdf)
# Methods without a struct file of their own.
set(without_struct abuffer)  # it binds what gpu/list_compositor.h names
# Folders of shaders/ and files of gpu/ that belong to no pass.
set(shaders_of_all common scene)          # what entries include; the vertex stage of every scene
set(structs_of_all bindings scene types)  # the registry, the scene's groups, the macros

file(READ ${SOURCE}/include/pellucid/renderer/instances.hpp instances)
string(TOLOWER "${instances}" instances)
file(READ ${SOURCE}/include/pellucid/renderer/translucent.hpp translucent)
file(READ ${SOURCE}/benchmarks/transparency/cases.hpp measured)
if(NOT EXISTS ${SOURCE}/benchmarks/transparency.cpp)
  message(SEND_ERROR "benchmarks/transparency.cpp is gone")
endif()
file(STRINGS ${SOURCE}/tests/passes/archetype.cpp archetype REGEX "PELLUCID_RENDERER_INSTANCES\\(, Null\\)")
if(NOT archetype)
  message(SEND_ERROR "tests/passes/archetype.cpp does not instantiate the passes for the null backend")
endif()

function(require stem)
  foreach(part IN LISTS ARGN)
    if(NOT EXISTS ${SOURCE}/${part})
      message(SEND_ERROR "'${stem}' lacks ${part}")
    endif()
  endforeach()
endfunction()

file(GLOB headers RELATIVE ${SOURCE}/include/pellucid/passes ${SOURCE}/include/pellucid/passes/*.hpp)
list(FILTER headers EXCLUDE REGEX "-inl\\.hpp$")
list(TRANSFORM headers REPLACE "\\.hpp$" "" OUTPUT_VARIABLE stems)
foreach(name IN LISTS helpers helpers_without_test methods parts_of_methods without_struct)
  if(NOT name IN_LIST stems)
    message(SEND_ERROR "tests/structure/stems_complete.cmake names '${name}', which is no header of passes/")
  endif()
endforeach()

set(passes 0)
foreach(stem IN LISTS stems)
  if(NOT stem IN_LIST helpers_without_test)
    require(${stem} tests/passes/${stem}.cpp)
  endif()
  string(REPLACE "_" "" class ${stem})
  if(stem IN_LIST helpers)
    if(instances MATCHES "template class ${class}pass<b>")
      message(SEND_ERROR "'${stem}' is a pass: it has no place among the helpers of stems_complete.cmake")
    endif()
    continue()
  endif()
  math(EXPR passes "${passes} + 1")
  require(${stem} shaders/${stem})
  if(NOT stem IN_LIST without_struct)
    require(${stem} include/pellucid/gpu/${stem}.h)
  elseif(EXISTS ${SOURCE}/include/pellucid/gpu/${stem}.h)
    message(SEND_ERROR "'${stem}' has a struct file: it has no place in without_struct of stems_complete.cmake")
  endif()
  # Every pass is in the list of what backends, the null one too, instantiate.
  if(NOT instances MATCHES "how template class ${class}pass<b>")
    message(SEND_ERROR "the pass '${stem}' is not in include/pellucid/renderer/instances.hpp")
  endif()
  if(stem IN_LIST methods OR stem IN_LIST parts_of_methods)
    require(${stem} include/pellucid/reference/renderer.hpp)
    if(NOT translucent MATCHES "#include <pellucid/passes/${stem}\\.hpp>")
      message(SEND_ERROR "'${stem}' is no part of renderer/translucent.hpp: it needs a reference of its own")
    endif()
  elseif(DEFINED ${stem}_reference)
    require(${stem} include/pellucid/reference/${${stem}_reference}.hpp)
  else()
    require(${stem} include/pellucid/reference/${stem}.hpp)
  endif()
  set(measured_there OFF)
  if(stem IN_LIST parts_of_methods OR (stem IN_LIST methods AND measured MATCHES "{Transparency::${stem}[,}]"))
    set(measured_there ON)
  endif()
  if(DEFINED ${stem}_benchmark)
    require(${stem} benchmarks/${${stem}_benchmark}.cpp)
  elseif(NOT measured_there)
    require(${stem} benchmarks/${stem}.cpp)
  endif()
endforeach()
if(passes EQUAL 0)
  message(FATAL_ERROR "no pass was found under ${SOURCE}: the scan is broken")
endif()

# And no part without its pass.
file(GLOB folders RELATIVE ${SOURCE}/shaders LIST_DIRECTORIES true ${SOURCE}/shaders/*)
foreach(folder IN LISTS folders)
  if(NOT IS_DIRECTORY ${SOURCE}/shaders/${folder} OR folder MATCHES "^bench_" OR folder IN_LIST shaders_of_all)
    continue()
  endif()
  if(NOT folder IN_LIST stems)
    message(SEND_ERROR "shaders/${folder} belongs to no header of passes/")
  endif()
endforeach()
file(GLOB structs RELATIVE ${SOURCE}/include/pellucid/gpu ${SOURCE}/include/pellucid/gpu/*.h)
list(TRANSFORM structs REPLACE "\\.h$" "")
foreach(struct IN LISTS structs)
  if(NOT struct IN_LIST stems AND NOT struct IN_LIST structs_of_all)
    message(SEND_ERROR "include/pellucid/gpu/${struct}.h belongs to no header of passes/")
  endif()
endforeach()
message(STATUS "${passes} passes")
