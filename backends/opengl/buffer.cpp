// SPDX-License-Identifier: MIT
#include <cstring>

#include "pellucid/opengl/device.hpp"
#include "text.hpp"

namespace pellucid::inline v0_1::opengl {

namespace {

/// [byte] what the GPU has, where the driver tells; else as much as can be asked for.  NVIDIA's driver gives any size a
/// name and fails later.
std::uint64_t gpu_memory() {
    if (!epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) return ~std::uint64_t{0};
    constexpr GLenum total_available_kib = 0x9048;  // GL_GPU_MEMORY_INFO_TOTAL_AVAILABLE_MEMORY_NVX
    GLint kib = 0;
    glGetIntegerv(total_available_kib, &kib);
    return kib > 0 ? std::uint64_t{1024} * static_cast<std::uint64_t>(kib) : ~std::uint64_t{0};
}

}  // namespace

Result<rhi::Buffer> Device::make_buffer(const rhi::BufferDesc& desc) {
    PELLUCID_CHECK(enter());
    if (desc.size == 0)
        return Error{Errc::invalid_argument,
                     text("The buffer '%s' has size 0; it needs at least 1 byte", desc.debug_name)};
    if (desc.initial.size() > desc.size)
        return Error{Errc::invalid_argument,
                     text("The buffer '%s' of %llu bytes gets %zu initial bytes", desc.debug_name,
                          static_cast<unsigned long long>(desc.size), desc.initial.size())};
    constexpr std::uint64_t surely_there = std::uint64_t{1} << 30;
    if (desc.size > surely_there && desc.size > gpu_memory())
        return Error{Errc::out_of_memory,
                     text("The buffer '%s' of %llu bytes does not fit the %llu bytes of %s: make it smaller",
                          desc.debug_name, static_cast<unsigned long long>(desc.size),
                          static_cast<unsigned long long>(gpu_memory()), info().name.c_str())};
    GLbitfield map = 0, storage = 0;
    if (desc.memory != rhi::Memory::device) {
        map = GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        map |= desc.memory == rhi::Memory::upload ? GL_MAP_WRITE_BIT : GL_MAP_READ_BIT;
        storage = map | (desc.memory == rhi::Memory::readback ? GL_CLIENT_STORAGE_BIT : 0u);
    }
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i) continue;  // old errors are not ours
    BufferObject made{.size = desc.size, .usage = desc.usage};
    const bool whole = desc.initial.size() == desc.size;
    const bool later = !desc.initial.empty() && !whole;
    glCreateBuffers(1, &made.name);
    // Less than the whole goes through a buffer of its size, because device memory is not writable afterwards.
    glNamedBufferStorage(made.name, static_cast<GLsizeiptr>(desc.size), whole ? desc.initial.data() : nullptr, storage);
    bool ok = glGetError() == GL_NO_ERROR;
    if (ok && later) {
        GLuint part = 0;
        glCreateBuffers(1, &part);
        glNamedBufferStorage(part, static_cast<GLsizeiptr>(desc.initial.size()), desc.initial.data(), 0);
        glCopyNamedBufferSubData(part, made.name, 0, 0, static_cast<GLsizeiptr>(desc.initial.size()));
        glDeleteBuffers(1, &part);
        // The CPU may write the map at once: the copy must not come behind it.
        if (map) glFinish();
        ok = glGetError() == GL_NO_ERROR;
    }
    if (ok && map) {
        made.map =
            static_cast<std::byte*>(glMapNamedBufferRange(made.name, 0, static_cast<GLsizeiptr>(desc.size), map));
        ok = made.map != nullptr;
    }
    if (!ok) {
        glDeleteBuffers(1, &made.name);
        return Error{Errc::out_of_memory,
                     text("No memory for the buffer '%s' of %llu bytes: free buffers or make it smaller",
                          desc.debug_name, static_cast<unsigned long long>(desc.size))};
    }
    label(GL_BUFFER, made.name, desc.debug_name);
    return objects_.buffers.insert(made);
}

std::span<std::byte> Device::mapped(rhi::Buffer buffer) {
    const BufferObject* object = objects_.buffers.find(buffer);
    if (!object || !object->map) return {};
    return {object->map, static_cast<std::size_t>(object->size)};
}

void Device::destroy(rhi::Buffer buffer) {
    if (!alive(buffer)) return;
    context_->enter();
    commands_.forget(buffer);
    const BufferObject object = objects_.buffers.erase(buffer);
    if (object.map) glUnmapNamedBuffer(object.name);
    glDeleteBuffers(1, &object.name);
}

}  // namespace pellucid::inline v0_1::opengl
