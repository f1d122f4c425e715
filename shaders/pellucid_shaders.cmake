# pellucid_add_shader(<target> <stem> FILES <file>... [EXACT <file>...])
#
# Builds the files of one stem (a folder of .vert, .frag and .comp files) for Vulkan (SPIR-V), OpenGL (resolved GLSL
# text) and OpenGL (SPIR-V), embeds them, and adds their definitions to <target>.  C++ gets
#     #include <pellucid/shaders/<stem>.hpp>      // pellucid::shaders::<stem>_<file>_<stage>  (a rhi::Shader)
# e.g. shaders/gbuffer/gbuffer.frag -> pellucid::shaders::gbuffer_frag (the stem is not repeated).  Files listed after
# EXACT are built a second time with PELLUCID_EXACT, as ..._exact: the same bits on every API.
# The global property PELLUCID_SHADERS_OF_<target> lists them all as <stem>/<name>.
# Includes are found in the file's own folder, in Pellucid's shaders/ and include/, and in the target's include folders;
# changing any of them rebuilds what includes it.
find_program(PELLUCID_GLSLANG NAMES glslangValidator glslang)  # one program: renamed in 12.3
find_program(PELLUCID_SPIRV_VAL spirv-val)

function(pellucid_add_shader target stem)
  if(NOT PELLUCID_GLSLANG)
    message(FATAL_ERROR "glslangValidator was not found: install the package glslang-tools")
  endif()
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "FILES;EXACT")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated/pellucid/shaders)
  file(MAKE_DIRECTORY ${folder}/${stem})
  set(tools ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  if(EXISTS ${tools}/../include/pellucid/gpu)
    set(includes ${tools} ${tools}/../include)  # in the source tree
  else()
    get_target_property(includes pellucid::pellucid INTERFACE_INCLUDE_DIRECTORIES)  # installed
    list(PREPEND includes ${tools})
  endif()
  set(declarations)
  set(definitions)
  set(outputs)
  foreach(file IN LISTS arg_FILES arg_EXACT)
    get_filename_component(source ${file} ABSOLUTE)
    get_filename_component(base ${file} NAME_WE)
    get_filename_component(suffix ${file} LAST_EXT)
    string(SUBSTRING ${suffix} 1 -1 suffix)
    string(REPLACE "vert" "vertex" stage ${suffix})
    string(REPLACE "frag" "fragment" stage ${stage})
    string(REPLACE "comp" "compute" stage ${stage})
    if(base STREQUAL stem)
      set(name ${stem}_${suffix})
    else()
      set(name ${stem}_${base}_${suffix})
    endif()
    set(variants OFF)
    if(file IN_LIST arg_EXACT)
      set(variants OFF ON)
    endif()
    foreach(exact IN LISTS variants)
      set(variant ${name})
      set(note "")
      if(exact)
        set(variant ${name}_exact)
        set(note " (exact)")
      endif()
      set(output ${folder}/${stem}/${variant}-inl.hpp)
      add_custom_command(OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DSOURCE=${source} -DNAME=${variant} -DLABEL=${stem}/${base}.${suffix}
          -DSTAGE=${stage} -DEXACT=${exact} -DOUTPUT=${output} "-DINCLUDES=${includes}" -DGLSLANG=${PELLUCID_GLSLANG}
          -DSPIRV_VAL=$<$<BOOL:${PELLUCID_SPIRV_VAL}>:${PELLUCID_SPIRV_VAL}> -P ${tools}/compile.cmake
        DEPENDS ${source} ${tools}/compile.cmake DEPFILE ${output}.d
        COMMENT "Shader ${stem}/${base}.${suffix}${note}" VERBATIM)
      list(APPEND outputs ${output})
      set_property(GLOBAL APPEND PROPERTY PELLUCID_SHADERS_OF_${target} ${stem}/${variant})
      string(APPEND declarations "extern const ::pellucid::rhi::Shader ${variant};\n")
      string(APPEND definitions "#include <pellucid/shaders/${stem}/${variant}-inl.hpp>\n")
    endforeach()
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/${stem}.hpp @ONLY CONTENT "// Built by pellucid_add_shader; do not edit.
#pragma once
#include <pellucid/rhi/shader.hpp>
#if defined(PELLUCID_HEADER_ONLY)
#define PELLUCID_SHADER_DEFINE(name) inline const ::pellucid::rhi::Shader name
@definitions@#undef PELLUCID_SHADER_DEFINE
#else
namespace pellucid::inline v0_1::shaders {
@declarations@}
#endif
")
  file(CONFIGURE OUTPUT ${folder}/${stem}.cpp @ONLY CONTENT "// Built by pellucid_add_shader; do not edit.
#undef PELLUCID_HEADER_ONLY
#include <pellucid/shaders/${stem}.hpp>
#define PELLUCID_SHADER_DEFINE(name) const ::pellucid::rhi::Shader name
@definitions@")
  set_source_files_properties(${folder}/${stem}.cpp PROPERTIES OBJECT_DEPENDS "${outputs}")
  target_sources(${target} PRIVATE ${folder}/${stem}.cpp)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/generated>)
  # Whoever includes the headers waits for them.
  add_custom_target(${target}_shaders_${stem} DEPENDS ${outputs})
  add_dependencies(${target} ${target}_shaders_${stem})
endfunction()
