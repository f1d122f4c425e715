// SPDX-License-Identifier: MIT
// Shaders to a linked program: from GLSL text, from SPIR-V, or from the cache.
#include <algorithm>

#include "pellucid/opengl/device.hpp"
#include "program_cache.hpp"
#include "spirv.hpp"
#include "text.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

constexpr GLenum stages[] = {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER, GL_COMPUTE_SHADER};

/// Deletes GL shaders when it ends; a linked program does not need them.
struct ShaderNames {
    SmallVector<GLuint, 2> names = {};
    ShaderNames() = default;
    ShaderNames(const ShaderNames&) = delete;
    ShaderNames& operator=(const ShaderNames&) = delete;
    ~ShaderNames() {
        for (const GLuint name : names) glDeleteShader(name);
    }
};

/// Failures are told by a Result; the driver's debug message about the same would tell them twice.
struct Quiet {
    DebugSink& sink;
    explicit Quiet(DebugSink& s) : sink(s) { sink.quiet = true; }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;
    ~Quiet() { sink.quiet = false; }
};

/// The text with `#define PELLUCID_SPEC_<id> <value>u` behind its #version line, for every constant.
std::string specialised(const rhi::Shader& shader, std::span<const rhi::SpecConstant> given) {
    // The built SPIR-V of the same source knows the defaults of what is not given.
    const std::vector<rhi::SpecConstant> constants = shader.gl_spirv.empty()
                                                         ? std::vector<rhi::SpecConstant>(given.begin(), given.end())
                                                         : merged_constants(declared_constants(shader.gl_spirv), given);
    std::string out(shader.gl_text);
    if (constants.empty()) return out;
    std::string defines;
    for (const rhi::SpecConstant& c : constants) defines += text("#define PELLUCID_SPEC_%u %uu\n", c.id, c.value);
    defines += "#line 2\n";
    const std::size_t version = out.find("#version");
    const std::size_t line_end = out.find('\n', version == std::string::npos ? 0 : version);
    out.insert(line_end == std::string::npos ? out.size() : line_end + 1, defines);
    return out;
}

std::string shader_log(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    return log.c_str();
}

std::string program_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, length, nullptr, log.data());
    return log.c_str();
}

void load_spirv(GLuint shader, const rhi::Shader& source, std::span<const rhi::SpecConstant> given) {
    // Unknown ids are an error in OpenGL, so only what the module declares is passed.
    std::vector<GLuint> ids, values;
    for (const rhi::SpecConstant& c : merged_constants(declared_constants(source.gl_spirv), given)) {
        ids.push_back(c.id);
        values.push_back(c.value);
    }
    glShaderBinary(1, &shader, GL_SHADER_BINARY_FORMAT_SPIR_V_ARB, source.gl_spirv.data(),
                   static_cast<GLsizei>(source.gl_spirv.size_bytes()));
    glSpecializeShaderARB(shader, "main", static_cast<GLuint>(ids.size()), ids.data(), values.data());
}

void load_text(GLuint shader, const std::string& source) {
    const char* start = source.c_str();
    const auto length = static_cast<GLint>(source.size());
    glShaderSource(shader, 1, &start, &length);
    glCompileShader(shader);
}

}  // namespace

Result<GLuint> Device::make_program(std::span<const rhi::Shader* const> shaders,
                                    std::span<const rhi::SpecConstant> constants, const char* debug_name) {
    const Quiet quiet(*debug_);
    ProgramKey key;
    SmallVector<std::string, 2> texts;
    for (const rhi::Shader* shader : shaders) {
        if (gl_spirv_ ? shader->gl_spirv.empty() : shader->gl_text.empty())
            return Error{Errc::invalid_argument,
                         text("The pipeline '%s' has the shader '%s' without %s: build it with "
                              "pellucid_add_shader",
                              debug_name, shader->name, gl_spirv_ ? "OpenGL SPIR-V" : "OpenGL text")};
        if (gl_spirv_) continue;
        texts.push_back(specialised(*shader, constants));
        key.add(texts[texts.size() - 1]);
    }
    const bool cached = programs_ && !gl_spirv_;
    if (cached)
        if (const GLuint program = programs_->load(key)) {
            label(GL_PROGRAM, program, debug_name);
            return program;
        }

    ShaderNames made;
    const GLuint program = glCreateProgram();
    for (std::size_t i = 0; i < shaders.size(); ++i) {
        const GLuint shader = glCreateShader(stages[static_cast<std::size_t>(shaders[i]->stage)]);
        made.names.push_back(shader);
        if (gl_spirv_)
            load_spirv(shader, *shaders[i], constants);
        else
            load_text(shader, texts[i]);
        GLint compiled = GL_FALSE;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
        if (!compiled) {
            const std::string log = shader_log(shader);
            glDeleteProgram(program);
            return Error{Errc::unsupported, text("The pipeline '%s': %s refuses the shader '%s': %s", debug_name,
                                                 info_.driver.c_str(), shaders[i]->name, log.c_str())};
        }
        glAttachShader(program, shader);
    }
    if (cached) glProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        const std::string log = program_log(program);
        glDeleteProgram(program);
        return Error{Errc::unsupported, text("The pipeline '%s': %s does not link '%s'%s%s: %s", debug_name,
                                             info_.driver.c_str(), shaders[0]->name, shaders.size() > 1 ? " with " : "",
                                             shaders.size() > 1 ? shaders[1]->name : "", log.c_str())};
    }
    if (cached) programs_->store(key, program);
    label(GL_PROGRAM, program, debug_name);
    return program;
}

}  // namespace pellucid::inline v0_1::opengl
