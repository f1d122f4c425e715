# pellucid.pc, pellucid-vulkan.pc, pellucid-opengl.pc and pellucid-reference.pc, for those who build without CMake:
#   g++ -std=c++20 program.cpp $(pkg-config --cflags --libs pellucid-vulkan pellucid-opengl)
# The libraries are static, so what they need stands under Requires and Libs: every program links it.  Definitions and
# names of libraries are the targets' own; the prefix is found from where the files lie.
set(pc_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
foreach(folder LIBDIR INCLUDEDIR)
  set(pc_${folder} "${CMAKE_INSTALL_${folder}}")
  if(NOT IS_ABSOLUTE "${pc_${folder}}")
    set(pc_${folder} "\${prefix}/${pc_${folder}}")
  endif()
endforeach()
set(pc_prefix ${CMAKE_INSTALL_PREFIX})
if(NOT IS_ABSOLUTE "${pc_folder}")
  file(RELATIVE_PATH up /prefix/${pc_folder} /prefix)
  string(REGEX REPLACE "/$" "" up "${up}")
  set(pc_prefix "\${pcfiledir}/${up}")
endif()

# pellucid_pc(<target> <name> <description> <what it requires> <what else it links> <further fields>)
function(pellucid_pc target name description requires links fields)
  set(definitions $<TARGET_PROPERTY:${target},INTERFACE_COMPILE_DEFINITIONS>)
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/pkgconfig/$<CONFIG>/${name}.pc CONTENT "prefix=${pc_prefix}
libdir=${pc_LIBDIR}
includedir=${pc_INCLUDEDIR}

Name: ${name}
Description: ${description}
Version: ${PROJECT_VERSION}
Requires: ${requires}
${fields}Cflags: -I\${includedir} -D$<JOIN:${definitions}, -D>
Libs: -L\${libdir} -l$<TARGET_FILE_BASE_NAME:${target}>${links}
")
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/$<CONFIG>/${name}.pc DESTINATION ${pc_folder})
endfunction()

# A package without a file of pkg-config's own is linked by its name; GLM without one is headers in the usual place.
find_package(PkgConfig QUIET)
set(requires "")
set(links "")
foreach(row "glm;" "libpng;png" "libjpeg;jpeg" "tinyexr;tinyexr" "tinygltf;tinygltf")
  list(GET row 0 module)
  list(GET row 1 library)
  if(PkgConfig_FOUND)
    pkg_check_modules(PELLUCID_PC_${module} QUIET ${module})
  endif()
  if(PELLUCID_PC_${module}_FOUND)
    string(APPEND requires " ${module}")
  elseif(library)
    string(APPEND links " -l${library}")
  endif()
endforeach()
string(STRIP "${requires}" requires)
pellucid_pc(pellucid pellucid "${PROJECT_DESCRIPTION}" "${requires}" "${links}" "")

set(core "pellucid = ${PROJECT_VERSION}")
if(TARGET pellucid_vulkan)  # the headers are needed, the loader is opened at run time
  list(TRANSFORM CMAKE_DL_LIBS PREPEND " -l" OUTPUT_VARIABLE dl)
  pellucid_pc(pellucid_vulkan pellucid-vulkan "Pellucid's Vulkan backend" "${core}" "${dl}"
    "Requires.private: vulkan\n")
endif()
if(TARGET pellucid_opengl)
  pellucid_pc(pellucid_opengl pellucid-opengl "Pellucid's OpenGL backend" "${core}, epoxy" "" "")
endif()
if(TARGET pellucid_reference)
  pellucid_pc(pellucid_reference pellucid-reference "Pellucid's reference renderer" "${core}, tbb" "" "")
endif()
