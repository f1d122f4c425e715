# Installs a build, looks at what is there, and moves it: whoever uses it finds it elsewhere than it was told to be.
#   cmake -DBUILD= -DWORK= -DLIBDIR=lib -DDOCUMENTS=ON|OFF -DCOMPONENTS=vulkan,opengl -P install.cmake
# leaves the tree in WORK/prefix.  It is staged by DESTDIR, as a packager does it.
cmake_minimum_required(VERSION 3.25)
string(REPLACE "," ";" COMPONENTS "${COMPONENTS}")
string(REPLACE "," ";" PROGRAMS "${PROGRAMS}")
file(REMOVE_RECURSE ${WORK}/staged ${WORK}/prefix)
set(ENV{DESTDIR} ${WORK}/staged)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix /where/it/was/told
  COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(RENAME ${WORK}/staged/where/it/was/told ${WORK}/prefix)

file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../../CMakeLists.txt version REGEX "^project\\(pellucid VERSION")
string(REGEX REPLACE ".*VERSION ([0-9.]+).*" "\\1" version "${version}")
set(wanted
  include/pellucid/pellucid.hpp include/pellucid/core/version.hpp include/pellucid/shaders/gbuffer.hpp
  ${LIBDIR}/cmake/pellucid/pellucidConfig.cmake ${LIBDIR}/cmake/pellucid/pellucidConfigVersion.cmake
  ${LIBDIR}/cmake/pellucid/pellucid-core.cmake ${LIBDIR}/cmake/pellucid/dependencies.cmake ${LIBDIR}/pkgconfig/pellucid.pc
  share/doc/pellucid/LICENSE share/doc/pellucid/README.md share/doc/pellucid/CHANGELOG.md
  share/pellucid/shaders/pellucid_shaders.cmake share/pellucid/shaders/compile.cmake
  share/pellucid/shaders/common/prelude.glsl)
foreach(component IN LISTS COMPONENTS)
  list(APPEND wanted ${LIBDIR}/cmake/pellucid/pellucid-${component}.cmake ${LIBDIR}/pkgconfig/pellucid-${component}.pc)
endforeach()
foreach(file IN LISTS wanted PROGRAMS)
  if(NOT EXISTS ${WORK}/prefix/${file})
    message(SEND_ERROR "${file} was not installed")
  endif()
endforeach()

file(GLOB_RECURSE files RELATIVE ${WORK}/prefix ${WORK}/prefix/*)
foreach(file IN LISTS files)
  if(file MATCHES "\\.cpp$|/tests/|^include/(GL|glm)" OR NOT file MATCHES "^(bin|include|${LIBDIR}|share)/")
    message(SEND_ERROR "${file} should not have been installed")
  endif()
  if(file MATCHES "\\.(cmake|pc|hpp|h|glsl)$")
    file(READ ${WORK}/prefix/${file} text)
    cmake_path(SET source NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../..)
    string(REGEX REPLACE "/$" "" source ${source})
    foreach(path ${source} ${BUILD} ${WORK} /where/it/was/told)
      string(FIND "${text}" "${path}/" at)
      if(NOT at EQUAL -1)
        message(SEND_ERROR "${file} names ${path}: the installed tree cannot be moved")
      endif()
    endforeach()
  endif()
endforeach()

# A debug build's libraries have other names, so that both may lie in one prefix.
file(GLOB libraries RELATIVE ${WORK}/prefix/${LIBDIR} ${WORK}/prefix/${LIBDIR}/*.a)
list(LENGTH COMPONENTS count)
list(LENGTH libraries found)
math(EXPR count "${count} + 1")
if(NOT found EQUAL count)
  message(SEND_ERROR "${count} libraries were to be installed, and these were: ${libraries}")
endif()
file(STRINGS ${BUILD}/CMakeCache.txt type REGEX "^CMAKE_BUILD_TYPE:")
set(postfix "")
if(type MATCHES "=Debug$")
  set(postfix d)
endif()
foreach(library IN LISTS libraries)
  if(NOT library MATCHES "^libpellucid(_vulkan|_opengl|_reference)?${postfix}\\.a$")
    message(SEND_ERROR "${library} has the name of another build type: ${type}")
  endif()
endforeach()
# pkg-config's files name the libraries that lie beside them.
foreach(file IN LISTS files)
  if(file MATCHES "\\.pc$")
    file(READ ${WORK}/prefix/${file} text)
    string(REGEX MATCH "-l(pellucid[a-z_]*)" linked "${text}")
    if(NOT EXISTS ${WORK}/prefix/${LIBDIR}/lib${CMAKE_MATCH_1}.a)
      message(SEND_ERROR "${file} links '${CMAKE_MATCH_1}', which was not installed")
    endif()
  endif()
endforeach()
list(LENGTH files count)
message(STATUS "pellucid ${version}: ${count} files in ${WORK}/prefix")
