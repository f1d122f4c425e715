# The ctests that build and run the project in this folder in its three ways, that look at an installed tree, and that
# use it by pkg-config, vcpkg's port and Conan's recipe.  Each step is a test of its own.
set(work ${CMAKE_CURRENT_BINARY_DIR}/consumer)
set(here ${CMAKE_CURRENT_SOURCE_DIR}/consumer)
set(common -S ${here} -G ${CMAKE_GENERATOR} -DPELLUCID_SOURCE=${PROJECT_SOURCE_DIR}
  -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -g0" -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
  "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}")

# Nothing is downloaded: where the system can take the network away from a process, there is none while CMake runs.
set(offline "")
execute_process(COMMAND unshare --map-root-user --net true RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(status STREQUAL "0")
  set(offline unshare --map-root-user --net)
else()
  message(STATUS "The consumer tests configure with the network there is: unshare --net is not possible here")
endif()

# pellucid_consumer(<way> <backend> <folder> <configure arguments>...)
function(pellucid_consumer way backend folder)
  add_test(NAME consumer/${way}/configure COMMAND ${offline} ${CMAKE_COMMAND} ${common} -B ${work}/${folder}
    -DCONSUME=${way} -DBACKEND=${backend} ${ARGN})
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

# pellucid_consumer_script(<name> <script> <fixtures it needs> <fixture it makes> <seconds> <definitions>...)
function(pellucid_consumer_script name script needs makes seconds)
  list(TRANSFORM ARGN PREPEND -D)
  add_test(NAME consumer/${name} COMMAND ${CMAKE_COMMAND} ${ARGN} -P ${here}/${script}.cmake)
  set_tests_properties(consumer/${name} PROPERTIES LABELS consumer TIMEOUT ${seconds} FIXTURES_REQUIRED "${needs}"
    FIXTURES_SETUP "${makes}")
endfunction()

set(backend vulkan)
if(NOT TARGET pellucid::vulkan)
  set(backend opengl)
endif()
set(last opengl)  # the package test uses the other backend where there are two
if(NOT TARGET pellucid::opengl)
  set(last vulkan)
endif()
# Debug libraries in a folder of another name than lib, to be installed with the project that brought them.
pellucid_consumer(subdirectory ${backend} source -DPELLUCID_INSTALL=ON -DCMAKE_INSTALL_LIBDIR=lib/elsewhere)
pellucid_consumer_script(subdirectory/install install subdirectory_built "" 120 BUILD=${work}/source
  WORK=${work}/debug LIBDIR=lib/elsewhere COMPONENTS=${backend})
pellucid_consumer(fetch ${backend} source -UPELLUCID_INSTALL -UCMAKE_INSTALL_LIBDIR)
set_tests_properties(consumer/fetch/configure PROPERTIES  # they share a build folder
  DEPENDS "consumer/subdirectory/run;consumer/subdirectory/own_shader;consumer/subdirectory/install")

if(PELLUCID_INSTALL)
  set(components "")
  set(backends "")
  foreach(component vulkan opengl reference)
    if(TARGET pellucid::${component})
      list(APPEND components ${component})
    endif()
  endforeach()
  list(JOIN components "," components)
  string(REGEX REPLACE ",?reference" "" backends "${components}")
  set(programs "")
  foreach(program pellucid-render pellucid-viewer)
    if(TARGET ${program})
      list(APPEND programs bin/${program})
    endif()
  endforeach()
  list(JOIN programs "," programs)
  set(prefix ${work}/release/prefix)
  pellucid_consumer_script(install install "" installed 120 BUILD=${PROJECT_BINARY_DIR} WORK=${work}/release
    LIBDIR=${CMAKE_INSTALL_LIBDIR} COMPONENTS=${components} PROGRAMS=${programs})
  pellucid_consumer(package ${last} package -DCMAKE_PREFIX_PATH=${prefix} -Upellucid_DIR)  # not where it was once
  set_tests_properties(consumer/package/configure PROPERTIES FIXTURES_REQUIRED installed)
  if(TARGET pellucid::reference)
    add_test(NAME consumer/package/reference COMMAND ${work}/package/reference)
    set_tests_properties(consumer/package/reference PROPERTIES FIXTURES_REQUIRED package_built LABELS consumer TIMEOUT 60)
  endif()
  pellucid_consumer_script(pkg_config pkg_config installed "" 300 SOURCE=${PROJECT_SOURCE_DIR} WORK=${work}/pkg_config
    PREFIX=${prefix} LIBDIR=${CMAKE_INSTALL_LIBDIR} VERSION=${PROJECT_VERSION} COMPILER=${CMAKE_CXX_COMPILER}
    BACKENDS=${backends} REFERENCE=$<TARGET_EXISTS:pellucid::reference>)
  pellucid_consumer_script(missing missing installed "" 120 SOURCE=${PROJECT_SOURCE_DIR} WORK=${work}/missing
    PREFIX=${prefix} GENERATOR=${CMAKE_GENERATOR} COMPILER=${CMAKE_CXX_COMPILER})
  # A new user's first minute, to a picture of the demo scene.
  if(TARGET generate_scene AND TARGET pellucid::vulkan AND TARGET pellucid::opengl)
    add_test(NAME consumer/scene COMMAND generate_scene demo ${work}/demo.glb)
    add_test(NAME consumer/first_picture COMMAND ${PROJECT_SOURCE_DIR}/scripts/consumer --prefix ${prefix}
      --scene ${work}/demo.glb --folder ${work}/first_picture)
    set_tests_properties(consumer/scene PROPERTIES FIXTURES_SETUP demo_scene LABELS consumer TIMEOUT 60)
    # A fresh Debian has no make: no step may leave the choice of a generator to CMake.
    set_tests_properties(consumer/first_picture PROPERTIES FIXTURES_REQUIRED "installed;demo_scene" LABELS consumer
      TIMEOUT 200 ENVIRONMENT CMAKE_GENERATOR=none-was-named)
  endif()
endif()

# Packages for others' package managers, which need not be here.
pellucid_consumer_script(vcpkg vcpkg "" "" 1800 SOURCE=${PROJECT_SOURCE_DIR} WORK=${work}/vcpkg
  GENERATOR=${CMAKE_GENERATOR} COMPILER=${CMAKE_CXX_COMPILER} LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
  VERSION=${PROJECT_VERSION})
find_program(PELLUCID_PYTHON python3)
if(PELLUCID_PYTHON)
  add_test(NAME consumer/conan COMMAND ${PELLUCID_PYTHON} -B ${here}/conan.py ${PROJECT_SOURCE_DIR})
  set_tests_properties(consumer/conan PROPERTIES LABELS consumer TIMEOUT 60)
else()
  message(STATUS "consumer/conan is left out: python3 was not found (package python3)")
endif()
