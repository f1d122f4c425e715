# What the pages show is compiled, configured and drawn.  The rest of what is checked of them is in the .cpp files here.
set(out ${CMAKE_CURRENT_BINARY_DIR}/docs)
set(docs ${CMAKE_CURRENT_SOURCE_DIR}/docs)
file(MAKE_DIRECTORY ${out})
file(GLOB pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/README.md
  ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/techniques/*.md)
set(backends)
foreach(backend vulkan opengl)
  if(TARGET pellucid::${backend})
    list(APPEND backends pellucid::${backend})
  endif()
endforeach()

if(NOT backends)
  return()  # what the pages show draws
endif()

set(sources)
set(programs 0)
set(configured 0)
foreach(page IN LISTS pages)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${page})
  string(MAKE_C_IDENTIFIER ${page} id)
  execute_process(COMMAND awk -v out=${out} -v page=${page} -v id=${id} -f ${docs}/extract.awk
    ${PROJECT_SOURCE_DIR}/${page} OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" found "${found}")
  foreach(block IN LISTS found)
    string(REPLACE " " ";" block ${block})
    list(GET block 0 kind)
    list(GET block 1 setup)
    list(GET block 2 file)
    get_filename_component(name ${file} NAME_WE)
    if(kind STREQUAL "body")
      set(PAGE ${page})
      set(SETUP ${setup})
      set(BLOCK ${file})
      configure_file(${docs}/body.cpp.in ${out}/${name}.cpp @ONLY)
      list(APPEND sources ${out}/${name}.cpp)
    elseif(kind STREQUAL "file")
      list(APPEND sources ${file})
    elseif(kind STREQUAL "program")
      add_executable(${name} ${file})
      target_compile_options(${name} PRIVATE -O0)
      target_link_libraries(${name} PRIVATE pellucid::pellucid ${backends} pellucid_warnings)
      math(EXPR programs "${programs} + 1")
    elseif(kind STREQUAL "configure")
      if(DEFINED prefix)  # of consumer/tests.cmake, where it runs and the package is installed
        add_test(NAME docs/configure/${name} COMMAND ${CMAKE_COMMAND} -S ${docs}/cmake_block
          -B ${out}/${name} -G ${CMAKE_GENERATOR} -DBLOCK=${file} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
          -DCMAKE_PREFIX_PATH=${prefix})
        set_tests_properties(docs/configure/${name} PROPERTIES LABELS consumer TIMEOUT 120 FIXTURES_REQUIRED installed)
      endif()
      math(EXPR configured "${configured} + 1")
    else()
      message(FATAL_ERROR "${page} has a block of the kind '${kind}', which tests/docs/extract.awk does not know")
    endif()
  endforeach()
endforeach()
list(LENGTH sources count)
if(count LESS 3 OR programs EQUAL 0 OR configured EQUAL 0)
  message(FATAL_ERROR "${count} blocks, ${programs} programs, ${configured} configured: the scan of the pages is broken")
endif()
# A block that does not compile fails the build, with the page and its line.
add_library(docs_blocks OBJECT ${sources})
target_compile_options(docs_blocks PRIVATE -O0 -Wno-unused)
target_include_directories(docs_blocks PRIVATE ${docs}/setups)
target_link_libraries(docs_blocks PRIVATE pellucid::pellucid ${backends} pellucid_warnings)

# The pictures are what the commands beside them draw: they are drawn again, elsewhere, and docs/pictures compares.
if(TARGET pellucid-render AND TARGET pellucid-viewer AND TARGET pellucid::reference AND backends)
  add_test(NAME docs/draw COMMAND ${PROJECT_SOURCE_DIR}/scripts/docs --into ${PELLUCID_DRAWN_PICTURES}
    ${PROJECT_BINARY_DIR})
  # Status 4 is that there is no device; docs/pictures then says so, or fails where one must be there.
  set_tests_properties(docs/draw PROPERTIES LABELS gpu TIMEOUT 900 SKIP_RETURN_CODE 4 FIXTURES_SETUP pictures_drawn)
  if(PELLUCID_SANITIZE)
    set_tests_properties(docs/draw PROPERTIES ENVIRONMENT ASAN_OPTIONS=detect_leaks=0 TIMEOUT 1800)
  endif()
  set_tests_properties(docs/pictures PROPERTIES FIXTURES_REQUIRED pictures_drawn)
elseif(TEST docs/pictures)
  set_tests_properties(docs/pictures PROPERTIES DISABLED ON)
endif()

# The interface's pages: no warning, and every class and free function of a public header has a line.
find_program(PELLUCID_DOXYGEN doxygen)
if(PELLUCID_DOXYGEN)
  add_test(NAME docs/doxygen COMMAND ${CMAKE_COMMAND} -DDOXYGEN=${PELLUCID_DOXYGEN} -DSOURCE=${PROJECT_SOURCE_DIR}
    -DWORK=${out}/doxygen -P ${docs}/doxygen.cmake)
  set_tests_properties(docs/doxygen PROPERTIES LABELS cpu TIMEOUT 120)
endif()
