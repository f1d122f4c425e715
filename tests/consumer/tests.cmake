# The ctests that build and run the project in this folder in its three ways.  Each step is a test of its own.
set(work ${CMAKE_CURRENT_BINARY_DIR}/consumer)
set(common -S ${CMAKE_CURRENT_SOURCE_DIR}/consumer -G ${CMAKE_GENERATOR} -DPELLUCID_SOURCE=${PROJECT_SOURCE_DIR}
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS=-g0 -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
  "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}")

# pellucid_consumer(<way> <backend> <folder> <configure arguments>...)
function(pellucid_consumer way backend folder)
  add_test(NAME consumer/${way}/configure COMMAND ${CMAKE_COMMAND} ${common} -B ${work}/${folder} -DCONSUME=${way}
    -DBACKEND=${backend} ${ARGN})
  add_test(NAME consumer/${way}/build COMMAND ${CMAKE_COMMAND} --build ${work}/${folder})
  # With a file that is not there the program must say so, not crash.
  add_test(NAME consumer/${way}/run COMMAND ${work}/${folder}/minimal ${backend} missing.glb picture.png)
  add_test(NAME consumer/${way}/own_shader COMMAND ${work}/${folder}/own_shader)
  set_tests_properties(consumer/${way}/run PROPERTIES PASS_REGULAR_EXPRESSION "missing\\.glb")
  set_tests_properties(consumer/${way}/configure PROPERTIES FIXTURES_SETUP ${way}_configured)
  set_tests_properties(consumer/${way}/build PROPERTIES FIXTURES_REQUIRED ${way}_configured FIXTURES_SETUP ${way}_built)
  set_tests_properties(consumer/${way}/run consumer/${way}/own_shader PROPERTIES FIXTURES_REQUIRED ${way}_built)
  set_tests_properties(consumer/${way}/configure consumer/${way}/build consumer/${way}/run consumer/${way}/own_shader
    PROPERTIES LABELS consumer TIMEOUT 900)
endfunction()

set(backend vulkan)
if(NOT TARGET pellucid::vulkan)
  set(backend opengl)
endif()
set(last opengl)  # the package test uses the other backend where there are two
if(NOT TARGET pellucid::opengl)
  set(last vulkan)
endif()
pellucid_consumer(subdirectory ${backend} source)
pellucid_consumer(fetch ${backend} source)
set_tests_properties(consumer/fetch/configure PROPERTIES
  DEPENDS "consumer/subdirectory/run;consumer/subdirectory/own_shader")  # they share a build folder
if(PELLUCID_INSTALL)
  add_test(NAME consumer/install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${work}/prefix)
  set_tests_properties(consumer/install PROPERTIES FIXTURES_SETUP installed LABELS consumer TIMEOUT 120)
  pellucid_consumer(package ${last} package -DCMAKE_PREFIX_PATH=${work}/prefix)
  set_tests_properties(consumer/package/configure PROPERTIES FIXTURES_REQUIRED installed)
  if(TARGET pellucid::reference)
    add_test(NAME consumer/package/reference COMMAND ${work}/package/reference)
    set_tests_properties(consumer/package/reference PROPERTIES FIXTURES_REQUIRED package_built LABELS consumer TIMEOUT 60)
  endif()
endif()
