# What Pellucid is built with and linked to, found the same way by its own build and by whoever uses an installed one.
#   pellucid_find(<name> <missing> [<target>])   <missing>: "" or a sentence that names the package to install
#   pellucid_require(<name> <target> [<or>])     stops with that sentence, and with what else could be done
# Columns: the name; find_package's arguments; the imported target; Debian's packages.  Where others than Debian give a
# package or its target another name, it follows a slash.
function(pellucid_find name missing)
  set(rows
    "GLM           | glm CONFIG                          | glm::glm                                      | libglm-dev"
    "PNG           | PNG                                 | PNG::PNG                                      | libpng-dev"
    "JPEG          | JPEG                                | JPEG::JPEG                                    | libjpeg-dev"
    "tinyexr       | tinyexr CONFIG                      | tinyexr::tinyexr/unofficial::tinyexr::tinyexr | libtinyexr-dev"
    "TinyGLTF      | TinyGLTF CONFIG                     | TinyGLTF::TinyGLTF                            | libtinygltf-dev"
    "nlohmann_json | nlohmann_json CONFIG                | nlohmann_json::nlohmann_json                  | nlohmann-json3-dev"
    "TBB           | TBB                                 | TBB::tbb                                      | libtbb-dev"
    "Vulkan        | Vulkan 1.3/VulkanHeaders 1.3 CONFIG | Vulkan::Headers                               | libvulkan-dev"
    "libepoxy      | PkgConfig                           | PkgConfig::epoxy                              | libepoxy-dev, pkg-config"
    "CLI11         | CLI11 CONFIG                        | CLI11::CLI11                                  | libcli11-dev"
    "GLFW          | glfw3 3.3 CONFIG                    | glfw                                          | libglfw3-dev"
    "X11           | X11                                 | X11::X11                                      | libx11-dev"
    "Catch2        | Catch2 CONFIG                       | Catch2::Catch2WithMain                        | catch2")
  list(FILTER rows INCLUDE REGEX "^${name} ")
  string(REGEX REPLACE " *\\| *" ";" row "${rows}")
  list(LENGTH row columns)
  if(NOT columns EQUAL 4)
    message(FATAL_ERROR "include/dependencies.cmake has no row '${name}'")
  endif()
  list(POP_FRONT row name ways targets packages)
  string(REPLACE "/" ";" ways "${ways}")
  string(REPLACE "/" ";" targets "${targets}")
  set(found "")
  foreach(way IN LISTS ways)
    string(REPLACE " " ";" arguments "${way}")
    find_package(${arguments} QUIET)
    if(name STREQUAL "libepoxy" AND PkgConfig_FOUND)
      pkg_check_modules(epoxy QUIET IMPORTED_TARGET epoxy)
    elseif(name STREQUAL "TinyGLTF" AND NOT TARGET TinyGLTF::TinyGLTF)
      find_path(PELLUCID_TINYGLTF_INCLUDE tiny_gltf.h)  # elsewhere it is this header and nothing else
      if(PELLUCID_TINYGLTF_INCLUDE)
        add_library(TinyGLTF::TinyGLTF INTERFACE IMPORTED)
        target_include_directories(TinyGLTF::TinyGLTF INTERFACE ${PELLUCID_TINYGLTF_INCLUDE})
      endif()
    endif()
    foreach(target IN LISTS targets)
      if(TARGET ${target} AND NOT found)
        set(found ${target})
      endif()
    endforeach()
  endforeach()
  set(${missing} "" PARENT_SCOPE)
  if(NOT found)
    string(REGEX REPLACE "^([^,]+)$" "package \\1" packages "${packages}")
    string(REGEX REPLACE "^([^ ]+), " "packages \\1 and " packages "${packages}")
    set(${missing} "${name} was not found: install the ${packages}" PARENT_SCOPE)
  endif()
  if(ARGC GREATER 2)
    set(${ARGV2} "${found}" PARENT_SCOPE)
  endif()
endfunction()

function(pellucid_require name target)
  pellucid_find(${name} missing found)
  if(missing)
    list(JOIN ARGN "" other)
    message(FATAL_ERROR "${missing}${other}")
  endif()
  set(${target} ${found} PARENT_SCOPE)
endfunction()
