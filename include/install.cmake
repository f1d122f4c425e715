# What `cmake --install` puts where: headers (the shaders' too), libraries, programs, the shader build, the package that
# find_package(pellucid COMPONENTS vulkan opengl reference) finds, and what pkg-config finds.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pellucid)
set(shader_folder ${CMAKE_INSTALL_DATADIR}/pellucid/shaders)

install(DIRECTORY include/pellucid DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
install(DIRECTORY ${PROJECT_BINARY_DIR}/shaders/generated/pellucid DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY shaders/common DESTINATION ${shader_folder} FILES_MATCHING PATTERN "*.glsl")
install(FILES shaders/pellucid_shaders.cmake shaders/compile.cmake DESTINATION ${shader_folder})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/pellucid)
foreach(program pellucid-render pellucid-viewer)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()

# One export set for each component: a program needs the packages of those it asks for, and no others.
set(components "")
install(TARGETS pellucid EXPORT pellucid ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT pellucid NAMESPACE pellucid:: FILE pellucid-core.cmake DESTINATION ${package_folder})
foreach(component vulkan opengl reference)
  if(TARGET pellucid_${component})
    list(APPEND components ${component})
    if(NOT component STREQUAL "reference")  # its headers are among the toolkit's
      install(DIRECTORY backends/${component}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    endif()
    install(TARGETS pellucid_${component} EXPORT pellucid_${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT pellucid_${component} NAMESPACE pellucid:: FILE pellucid-${component}.cmake
      DESTINATION ${package_folder})
  endif()
endforeach()
if(NOT DEFINED CMAKE_DEBUG_POSTFIX)  # a debug build may lie beside another one in one prefix
  list(TRANSFORM components PREPEND pellucid_ OUTPUT_VARIABLE libraries)
  set_target_properties(pellucid ${libraries} PROPERTIES DEBUG_POSTFIX d)
endif()

list(JOIN components ", " component_names)
configure_package_config_file(include/pellucidConfig.cmake.in ${PROJECT_BINARY_DIR}/pellucidConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS shader_folder)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pellucidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pellucidConfig.cmake ${PROJECT_BINARY_DIR}/pellucidConfigVersion.cmake
  include/dependencies.cmake DESTINATION ${package_folder})

include(include/pkg_config.cmake)
