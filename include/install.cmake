# What `cmake --install` puts where: headers (the shaders' too), libraries, the shader build, and the package that
# find_package(pellucid COMPONENTS vulkan opengl) finds.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pellucid)
set(shader_folder ${CMAKE_INSTALL_DATADIR}/pellucid/shaders)

install(DIRECTORY include/pellucid DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
install(DIRECTORY ${PROJECT_BINARY_DIR}/shaders/generated/pellucid DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY shaders/common DESTINATION ${shader_folder} FILES_MATCHING PATTERN "*.glsl")
install(FILES shaders/pellucid_shaders.cmake shaders/compile.cmake DESTINATION ${shader_folder})

# One export set for each component: a program needs the packages of the backends it asks for, and no others.
install(TARGETS pellucid EXPORT pellucid ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT pellucid NAMESPACE pellucid:: FILE pellucid-core.cmake DESTINATION ${package_folder})
foreach(backend vulkan opengl)
  if(TARGET pellucid_${backend})
    install(DIRECTORY backends/${backend}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    install(TARGETS pellucid_${backend} EXPORT pellucid_${backend} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT pellucid_${backend} NAMESPACE pellucid:: FILE pellucid-${backend}.cmake DESTINATION ${package_folder})
  endif()
endforeach()

configure_package_config_file(include/pellucidConfig.cmake.in ${PROJECT_BINARY_DIR}/pellucidConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS shader_folder)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pellucidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pellucidConfig.cmake ${PROJECT_BINARY_DIR}/pellucidConfigVersion.cmake
  DESTINATION ${package_folder})
