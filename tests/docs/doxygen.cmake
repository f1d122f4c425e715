# The interface's pages come out without a warning, and every class, enumeration, alias and free function of a public
# header has a line of its own.  Members may do without: their names, types and trailing comments are looked at by people.
#   cmake -DDOXYGEN=<program> -DSOURCE=<root> -DWORK=<folder> -P doxygen.cmake
cmake_minimum_required(VERSION 3.25)
file(MAKE_DIRECTORY ${WORK})
file(READ ${SOURCE}/docs/Doxyfile settings)
file(WRITE ${WORK}/Doxyfile "${settings}\nOUTPUT_DIRECTORY = ${WORK}\nWARN_LOGFILE = ${WORK}/warnings\n")
execute_process(COMMAND ${DOXYGEN} ${WORK}/Doxyfile WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE status
  OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "doxygen failed: ${said}")
endif()
file(STRINGS ${WORK}/warnings lines)
set(members 0)
foreach(line IN LISTS lines)
  if(line MATCHES "warning: Member .* is not documented" AND
     NOT line MATCHES "\\((function|typedef|enumeration)\\) of (namespace|file) ")
    math(EXPR members "${members} + 1")
    continue()
  endif()
  message(SEND_ERROR "${line}")
endforeach()
if(NOT EXISTS ${WORK}/html/index.html OR NOT EXISTS ${WORK}/html/classpellucid_1_1Renderer.html)
  message(FATAL_ERROR "doxygen made no page of pellucid::Renderer: the input filter is broken")
endif()
message(STATUS "${members} members without a line of their own")
