# Builds one shader in all three forms and writes one header that defines it.  Run by pellucid_add_shader():
#   cmake -DSOURCE= -DNAME= -DLABEL= -DSTAGE= -DEXACT= -DOUTPUT= -DINCLUDES=a;b -DGLSLANG= -DSPIRV_VAL= -P compile.cmake
# Errors are glslang's own lines, "ERROR: file:line: ...".
set(flags)
foreach(directory IN LISTS INCLUDES)
  list(APPEND flags "-I${directory}")
endforeach()
if(EXACT)
  list(APPEND flags -DPELLUCID_EXACT=1)
endif()

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${LABEL} (${what}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run("Vulkan SPIR-V" ${GLSLANG} -V --target-env vulkan1.2 -DPELLUCID_VULKAN=1 ${flags} --depfile ${OUTPUT}.d
    -o ${OUTPUT}.spv ${SOURCE})
if(SPIRV_VAL)
  run("spirv-val" ${SPIRV_VAL} --target-env vulkan1.2 ${OUTPUT}.spv)
endif()
run("Vulkan SPIR-V words" ${GLSLANG} -V --target-env vulkan1.2 -DPELLUCID_VULKAN=1 ${flags} --vn words
    -o ${OUTPUT}.vk.inc ${SOURCE})
run("OpenGL SPIR-V" ${GLSLANG} -G -DPELLUCID_GL_SPIRV=1 ${flags} --vn words -o ${OUTPUT}.gl.inc ${SOURCE})
execute_process(COMMAND ${GLSLANG} -E -DPELLUCID_GL_TEXT=1 ${flags} ${SOURCE}
  RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE errors)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${LABEL} (OpenGL text):\n${errors}")
endif()
# A driver knows neither the include extension nor #line with a file name.
string(REGEX REPLACE "#extension GL_GOOGLE_include_directive[^\n]*" "" text "${text}")
string(REGEX REPLACE "#line [^\n]*" "" text "${text}")
# Mesa takes #extension only before the first statement; an include may bring it later.
string(REGEX MATCHALL "#extension [^\n]*\n" extensions "${text}")
list(REMOVE_DUPLICATES extensions)
string(JOIN "" extensions ${extensions})
string(REGEX REPLACE "#extension [^\n]*\n" "" text "${text}")
string(REGEX REPLACE "(#version [^\n]*\n)" "\\1${extensions}" text "${text}")
string(REGEX REPLACE "[ \t]+\n" "\n" text "${text}")
string(REGEX REPLACE "\n[ \t\n]*\n" "\n" text "${text}")
string(REGEX REPLACE "\n  +" "\n " text "${text}")
string(STRIP "${text}" text)  # it starts with "#version": a loader writes behind that line
string(APPEND text "\n")

# glslang's dependency file names its own output; the build waits for ours.
file(READ ${OUTPUT}.d dependencies)
string(REGEX REPLACE "^[^:]*:" "${OUTPUT}:" dependencies "${dependencies}")
file(WRITE ${OUTPUT}.d "${dependencies}")

function(words file variable)
  file(READ ${file} content)
  string(REGEX MATCH "{[^}]*}" content "${content}")
  set(${variable} "${content}" PARENT_SCOPE)
endfunction()
words(${OUTPUT}.vk.inc vulkan)
words(${OUTPUT}.gl.inc opengl)

# A string literal may be limited to 64 KiB by a compiler: cut the text into adjacent literals at line ends.
string(LENGTH "${text}" length)
set(literals)
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 8000 piece)
  string(APPEND literals "R\"GLSL(${piece})GLSL\"\n")
  math(EXPR at "${at} + 8000")
endwhile()

file(WRITE ${OUTPUT} "// Built from ${LABEL}; do not edit.
#pragma once
#include <pellucid/rhi/shader.hpp>
namespace pellucid::inline v0_1::shaders::data {
inline constexpr std::uint32_t ${NAME}_vk[] = ${vulkan};
inline constexpr std::uint32_t ${NAME}_gl[] = ${opengl};
inline constexpr char ${NAME}_text[] =
${literals};
}
namespace pellucid::inline v0_1::shaders {
PELLUCID_SHADER_DEFINE(${NAME}) = {::pellucid::rhi::ShaderStage::${STAGE}, data::${NAME}_vk, data::${NAME}_gl,
    ::std::string_view(data::${NAME}_text, sizeof data::${NAME}_text - 1), \"${LABEL}\"};
}
")
