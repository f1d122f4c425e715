# A package that is not there is named, with the Debian package to install, by the project's own configuration and by
# find_package(pellucid).
#   cmake -DSOURCE= -DWORK= -DPREFIX= -DGENERATOR= -DCOMPILER= -P missing.cmake
cmake_minimum_required(VERSION 3.25)

# refuses(<what is missing> <package> <folder> <arguments>...): configuring fails, and says so.
function(refuses what package folder)
  list(TRANSFORM what REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON" OUTPUT_VARIABLE disabled)
  execute_process(COMMAND ${CMAKE_COMMAND} -B ${WORK}/${folder} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} ${ARGN}
    -UCMAKE_DISABLE_FIND_PACKAGE_* ${disabled} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if(status EQUAL 0)
    message(SEND_ERROR "${folder} was configured without ${what}")
  elseif(NOT said MATCHES "was not found: install the packages? [a-z0-9 -]*${package}")
    message(SEND_ERROR "without ${what}, ${folder} does not name the package ${package}: ${said}")
  endif()
endfunction()

set(tree tree -S ${SOURCE} -DCMAKE_CXX_COMPILER_LAUNCHER= -DCMAKE_IGNORE_PATH=)
refuses(glm libglm-dev ${tree})
refuses(PNG libpng-dev ${tree})
refuses(JPEG libjpeg-dev ${tree})
refuses(tinyexr libtinyexr-dev ${tree})
refuses(TinyGLTF libtinygltf-dev ${tree} -DPELLUCID_TINYGLTF_INCLUDE=PELLUCID_TINYGLTF_INCLUDE-NOTFOUND
  -DCMAKE_IGNORE_PATH=/usr/include)
refuses(nlohmann_json nlohmann-json3-dev ${tree})
refuses(TBB libtbb-dev ${tree})
refuses("Vulkan;VulkanHeaders" libvulkan-dev ${tree})
refuses(PkgConfig libepoxy-dev ${tree})
refuses(PkgConfig pkg-config ${tree})
refuses(CLI11 libcli11-dev ${tree})
refuses(Catch2 catch2 ${tree})

set(consumer consumer -S ${SOURCE}/tests/consumer -DPELLUCID_SOURCE=${SOURCE} -DCONSUME=package
  -DCMAKE_PREFIX_PATH=${PREFIX})
refuses(glm libglm-dev ${consumer} -DCOMPONENTS=vulkan)
refuses(PNG libpng-dev ${consumer} -DCOMPONENTS=vulkan)
refuses("Vulkan;VulkanHeaders" libvulkan-dev ${consumer} -DCOMPONENTS=vulkan)
refuses(PkgConfig libepoxy-dev ${consumer} "-DCOMPONENTS=vulkan\\;opengl")
