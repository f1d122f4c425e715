// SPDX-License-Identifier: MIT
#include "rhi_overhead/raw_opengl.hpp"
#include <epoxy/gl.h>
#include <pellucid/gpu/bindings.h>
#include <cstring>
#include <pellucid/shaders/bench_draws.hpp>
#include <string>
#include "support/time.hpp"

namespace pellucid::bench {
namespace {

constexpr GLbitfield map_flags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

/// A buffer mapped for its whole life, with one part for each frame in flight.
struct Ring {
    GLuint buffer = 0;
    std::byte* memory = nullptr;
    GLsizeiptr part = 0;  ///< [byte] of one frame's part

    /// Makes each part at least `bytes` long; grows only.  Waits for nothing: call it while the GPU is idle.
    void reserve(GLsizeiptr bytes) {
        if (bytes <= part) return;
        glDeleteBuffers(1, &buffer);
        part = (bytes + 4095) / 4096 * 4096;
        glCreateBuffers(1, &buffer);
        glNamedBufferStorage(buffer, part * frames_in_flight, nullptr, map_flags);
        memory = static_cast<std::byte*>(glMapNamedBufferRange(buffer, 0, part * frames_in_flight, map_flags));
    }
};

[[gnu::noinline]] void record_draws(std::byte* to, std::span<const DrawMatrix> matrices) {
    GLuint record = 0;
    for (const DrawMatrix& matrix : matrices) {
        std::memcpy(to, &matrix, sizeof matrix);
        to += record_stride;
        glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, 3, 1, record++);
    }
}
[[gnu::noinline]] void record_indexed(std::byte* to, std::span<const DrawMatrix> matrices) {
    GLuint record = 0;
    for (const DrawMatrix& matrix : matrices) {
        std::memcpy(to, &matrix, sizeof matrix);
        to += record_stride;
        glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, 3, GL_UNSIGNED_INT, nullptr, 1, 0, record++);
    }
}
[[gnu::noinline]] void record_pushes(const Ring& ring, GLsizeiptr at, GLsizeiptr step,
                                     std::span<const DrawMatrix> matrices) {
    for (const DrawMatrix& matrix : matrices) {
        std::memcpy(ring.memory + at, &matrix, sizeof matrix);
        glBindBufferRange(GL_UNIFORM_BUFFER, PELLUCID_BIND_PUSH, ring.buffer, at, sizeof matrix);
        at += step;
        glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, 3, 1, 0);
    }
}

Result<GLuint> make_program(const rhi::Shader& vertex, const rhi::Shader& fragment) {
    const GLuint program = glCreateProgram();
    for (const rhi::Shader* shader : {&vertex, &fragment}) {
        const GLuint object = glCreateShader(shader == &vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        const char* text = shader->gl_text.data();
        const auto length = static_cast<GLint>(shader->gl_text.size());
        glShaderSource(object, 1, &text, &length);
        glCompileShader(object);
        glAttachShader(program, object);
        glDeleteShader(object);
    }
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) return program;
    char log[1024] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    glDeleteProgram(program);
    return Error{Errc::internal,
                 std::string("the raw OpenGL loop's program of '") + vertex.name + "' does not link: " + log};
}

class RawOpenGL final : public Loop {
public:
    explicit RawOpenGL(opengl::Device& device) : device_(device) {}
    ~RawOpenGL() override {
        enter();
        for (GLsync fence : fences_)
            if (fence) glDeleteSync(fence);
        for (GLuint buffer : {uniforms_.buffer, records_.buffer, pushes_.buffer, readback_, indices_})
            glDeleteBuffers(1, &buffer);
        glDeleteTextures(1, &target_);
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteVertexArrays(1, &vertex_array_);
        glDeleteProgram(record_program_);
        glDeleteProgram(push_program_);
    }

    Result<void> make_objects() {
        enter();
        GLint alignment = 0;
        glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
        push_step_ = (static_cast<GLsizeiptr>(sizeof(DrawMatrix)) + alignment - 1) / alignment * alignment;
        glCreateTextures(GL_TEXTURE_2D, 1, &target_);
        glTextureStorage2D(target_, 1, GL_RGBA8, target_size, target_size);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, target_, 0);
        constexpr GLbitfield read_flags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        constexpr GLsizeiptr bytes = target_size * target_size * 4;
        glCreateBuffers(1, &readback_);
        glNamedBufferStorage(readback_, bytes, nullptr, read_flags);
        picture_ = {static_cast<std::byte*>(glMapNamedBufferRange(readback_, 0, bytes, read_flags)), bytes};
        constexpr GLuint triangle[3] = {0, 1, 2};
        glCreateBuffers(1, &indices_);
        glNamedBufferStorage(indices_, sizeof triangle, triangle, 0);
        glCreateVertexArrays(1, &vertex_array_);
        glVertexArrayElementBuffer(vertex_array_, indices_);
        uniforms_.reserve(sizeof(FrameUniforms));
        PELLUCID_TRY(record_program_, make_program(shaders::bench_draws_record_vert, shaders::bench_draws_flat_frag));
        PELLUCID_TRY(push_program_, make_program(shaders::bench_draws_push_vert, shaders::bench_draws_flat_frag));
        // State of the whole program's life.
        glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_CULL_FACE);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_DITHER);
        glDisable(GL_SCISSOR_TEST);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glBindVertexArray(vertex_array_);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, readback_);
        return {};
    }

    void enter() override { device_.make_current(); }
    Result<FrameTime> frame(const Workload& workload, std::uint64_t number, Variant variant) override {
        const auto matrices = workload.matrices(number);
        const auto draws = static_cast<GLsizeiptr>(matrices.size());
        if (variant == Variant::push)
            pushes_.reserve(draws * push_step_);
        else
            records_.reserve(draws * record_stride);

        const double start = now_ns();
        const auto slot = static_cast<GLintptr>(number % frames_in_flight);
        if (!wait(fences_[slot])) return lost();
        const FrameUniforms uniforms;
        std::memcpy(uniforms_.memory + slot * uniforms_.part, &uniforms, sizeof uniforms);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, target_size, target_size);
        constexpr GLfloat clear[4] = {0, 0, 0, 0};
        glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, clear);
        glUseProgram(variant == Variant::push ? push_program_ : record_program_);
        glBindBufferRange(GL_UNIFORM_BUFFER, PELLUCID_BIND_FRAME, uniforms_.buffer, slot * uniforms_.part,
                          sizeof uniforms);
        if (variant == Variant::push) {
            record_pushes(pushes_, slot * pushes_.part, push_step_, matrices);
        } else {
            glBindBufferRange(GL_SHADER_STORAGE_BUFFER, PELLUCID_BIND_RECORDS, records_.buffer, slot * records_.part,
                              draws * record_stride);
            std::byte* to = records_.memory + slot * records_.part;
            if (variant == Variant::records_indexed)
                record_indexed(to, matrices);
            else
                record_draws(to, matrices);
        }
        const double recorded = now_ns();

        glGetTextureSubImage(target_, 0, 0, 0, 0, target_size, target_size, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                             static_cast<GLsizei>(picture_.size()), nullptr);
        glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
        fences_[slot] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        if (!wait(fences_[slot])) return lost();
        const double done = now_ns();
        return FrameTime{recorded - start, done - start};
    }
    std::span<const std::byte> picture() override { return picture_; }
    std::uint64_t api_calls() const override { return device_.api_calls(); }

private:
    /// Waits for a fence and deletes it; a null fence is done.
    static bool wait(GLsync& fence) {
        if (!fence) return true;
        const GLenum status = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, GL_TIMEOUT_IGNORED);
        glDeleteSync(fence);
        fence = nullptr;
        return status != GL_WAIT_FAILED;
    }
    static Error lost() { return {Errc::device_lost, "the raw OpenGL loop waited for a frame and the wait failed"}; }

    opengl::Device& device_;
    GLuint target_ = 0, framebuffer_ = 0, readback_ = 0, indices_ = 0, vertex_array_ = 0;
    GLuint record_program_ = 0, push_program_ = 0;
    Ring uniforms_, records_, pushes_;
    GLsizeiptr push_step_ = 0;  ///< [byte] between the matrices of two draws
    GLsync fences_[frames_in_flight] = {};
    std::span<const std::byte> picture_;
};

}  // namespace

Result<std::unique_ptr<Loop>> make_raw_opengl(opengl::Device& device) {
    auto loop = std::make_unique<RawOpenGL>(device);
    if (auto made = loop->make_objects(); !made) return made.error();
    return std::unique_ptr<Loop>(std::move(loop));
}

}  // namespace pellucid::bench
