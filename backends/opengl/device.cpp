// SPDX-License-Identifier: MIT
#include "pellucid/opengl/device.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <functional>
#include <optional>
#include <string_view>

#include "program_cache.hpp"
#include "text.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

std::string gl_string(GLenum what) {
    const auto* value = reinterpret_cast<const char*>(glGetString(what));
    return value ? value : "";
}
std::uint64_t gl_limit(GLenum what) {
    GLint64 value = 0;
    glGetInteger64v(what, &value);
    return value > 0 ? static_cast<std::uint64_t>(value) : 0;
}
bool has_extension(std::string_view name) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (const auto* found = glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)))
            if (name == reinterpret_cast<const char*>(found)) return true;
    return false;
}

/// The first thing that the current context lacks of what this library stands on; empty: nothing.
std::string missing_feature() {
    if (!has_extension("GL_ARB_shader_draw_parameters")) return "GL_ARB_shader_draw_parameters";
    struct Need {
        GLenum limit;
        std::uint64_t at_least;
        const char* what;
    };
    constexpr Need needs[] = {
        {GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 48, "48 storage buffer bindings"},
        {GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 8, "8 storage buffers in vertex shaders"},
        {GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, 8, "8 storage buffers in fragment shaders"},
        {GL_MAX_UNIFORM_BUFFER_BINDINGS, 48, "48 uniform buffer bindings"},
        {GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 48, "48 texture units"},
        {GL_MAX_FRAGMENT_IMAGE_UNIFORMS, 8, "8 images in fragment shaders"},
        {GL_MAX_IMAGE_UNITS, 8, "8 image units"},
    };
    for (const Need& need : needs)
        if (gl_limit(need.limit) < need.at_least) return need.what;
    return {};
}

rhi::DeviceInfo query_info() {
    rhi::DeviceInfo info;
    info.backend = "opengl";
    info.name = gl_string(GL_RENDERER);
    info.driver = gl_string(GL_VENDOR) + ", " + gl_string(GL_VERSION);
    info.api = text("OpenGL %u.%u core", static_cast<unsigned>(gl_limit(GL_MAJOR_VERSION)),
                    static_cast<unsigned>(gl_limit(GL_MINOR_VERSION)));
    for (const char* software : {"llvmpipe", "softpipe", "swrast"})
        info.software = info.software || info.name.find(software) != std::string::npos;
    if (info.name.find("llvmpipe") != std::string::npos) info.max_loop_turns = rhi::llvmpipe_loop_turns;
    info.missing = missing_feature();
    info.max_texture_size = static_cast<std::uint32_t>(gl_limit(GL_MAX_TEXTURE_SIZE));
    info.max_array_layers = static_cast<std::uint32_t>(gl_limit(GL_MAX_ARRAY_TEXTURE_LAYERS));
    info.max_storage_buffer_bytes = gl_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
    info.float32_blending = true;  // of every OpenGL 4.5
    info.int64_atomics = has_extension("GL_NV_shader_atomic_int64");
    info.pixel_ordering = has_extension("GL_ARB_fragment_shader_interlock");
    GLint bits = 0;
    glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    info.timestamp_ns = bits > 0 ? 1.0 : 0.0;
    return info;
}

struct Found {
    rhi::DeviceInfo info;
    std::unique_ptr<Context> context;
};
Found probe(const Adapter& adapter, bool validation) {
    Found found;
    auto context = Context::open(adapter, validation);
    if (!context) {
        found.info.backend = "opengl";
        found.info.name = adapter.name;
        found.info.missing = context.error().message;
        return found;
    }
    found.info = query_info();
    found.context = std::move(*context);
    return found;
}

/// Where the device found on `adapter` goes in a list that has hardware first; none where it is in the list already.
template <class T, class Info>
std::optional<typename std::vector<T>::iterator> place_for(std::vector<T>& list, const Adapter& adapter,
                                                           const rhi::DeviceInfo& found, Info info) {
    // Two devices of the enumeration are two, however alike.
    for (const T& known : list)
        if (adapter.by_platform && info(known).name == found.name && info(known).driver == found.driver)
            return std::nullopt;
    if (found.software) return list.end();
    return std::find_if(list.begin(), list.end(), [&](const T& known) { return info(known).software; });
}

void debug_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* message,
                   const void* user) {
    const auto* sink = static_cast<const DebugSink*>(user);
    if (sink->quiet) return;
    const std::string_view said(message, length < 0 ? std::strlen(message) : static_cast<std::size_t>(length));
    const bool error =
        severity == GL_DEBUG_SEVERITY_HIGH || type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    // Advice on speed is not misuse: drivers tell of their own recompiles and buffer moves.
    const bool advice = type == GL_DEBUG_TYPE_PERFORMANCE;
    sink->log(error    ? Severity::error
              : advice ? Severity::info
                       : Severity::warning,
              ("OpenGL: " + std::string(said)).c_str());
}

void start_debug_output(DebugSink& sink) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    for (const GLenum type : {GL_DEBUG_TYPE_ERROR, GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, GL_DEBUG_TYPE_PORTABILITY,
                              GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR})
        for (const GLenum severity : {GL_DEBUG_SEVERITY_LOW, GL_DEBUG_SEVERITY_MEDIUM, GL_DEBUG_SEVERITY_HIGH})
            glDebugMessageControl(GL_DONT_CARE, type, severity, 0, nullptr, GL_TRUE);
    glDebugMessageCallback(debug_message, &sink);
}

/// Whether `wanted` (an index, a part of the name, or empty: any usable one) means the device `info` with `index`.
bool fits(const std::string& wanted, const rhi::DeviceInfo& info, std::size_t index) {
    if (wanted.empty()) return info.missing.empty();
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    if (error == std::errc{} && end == wanted.data() + wanted.size()) return number == index;
    return info.name.find(wanted) != std::string::npos;
}

}  // namespace

Device::Device() = default;

std::vector<rhi::DeviceInfo> Device::list() {
    const CurrentGuard guard;
    std::vector<rhi::DeviceInfo> out;
    for (const Adapter& adapter : find_adapters()) {
        rhi::DeviceInfo found = probe(adapter, false).info;
        if (const auto place = place_for(out, adapter, found, std::identity{}); place)
            out.insert(*place, std::move(found));
    }
    return out;
}

Result<std::unique_ptr<Device>> Device::create(const rhi::DeviceDesc& desc) {
    if (desc.frames_in_flight < 1 || desc.frames_in_flight > 4)
        return Error{Errc::invalid_argument, text("frames_in_flight is %u; it must be 1 to 4", desc.frames_in_flight)};
    // The same order as list(): hardware, then software.
    std::vector<Found> known;
    for (const Adapter& adapter : find_adapters(desc.display)) {
        Found found = probe(adapter, desc.validation);
        const bool best = !found.info.software && found.info.missing.empty();
        const auto place =
            place_for(known, adapter, found.info, [](const Found& f) -> const rhi::DeviceInfo& { return f.info; });
        if (place) known.insert(*place, std::move(found));
        if (best && desc.device.empty()) break;
    }
    std::string seen;
    for (std::size_t i = 0; i < known.size(); ++i) {
        Found& found = known[i];
        if (!fits(desc.device, found.info, i)) {
            seen += text("%s%zu: %s%s%s", seen.empty() ? "" : "; ", i, found.info.name.c_str(),
                         found.info.missing.empty() ? "" : " lacks ", found.info.missing.c_str());
            continue;
        }
        if (!found.info.missing.empty())
            return Error{Errc::unsupported,
                         text("The OpenGL device '%s' lacks %s", found.info.name.c_str(), found.info.missing.c_str())};
        std::unique_ptr<Device> device(new Device);
        device->info_ = std::move(found.info);
        device->context_ = std::move(found.context);
        known.clear();
        PELLUCID_CHECK(device->start(desc));
        return device;
    }
    const std::string asked = desc.device.empty() ? "is usable" : "fits '" + desc.device + "'";
    return Error{Errc::no_device, text("No OpenGL device %s; found: %s", asked.c_str(),
                                       seen.empty() ? "none (is EGL installed?)" : seen.c_str())};
}

Result<void> Device::start(const rhi::DeviceDesc& desc) {
    log_ = desc.log;
    display_ = desc.display;
    validation_ = desc.validation;
    frames_in_flight_ = desc.frames_in_flight;
    gl_spirv_ = desc.gl_spirv;
    debug_ = std::make_unique<DebugSink>(DebugSink{.log = desc.log});
    PELLUCID_CHECK(enter());
    if (gl_spirv_ && !has_extension("GL_ARB_gl_spirv"))
        return Error{Errc::unsupported, text("%s lacks GL_ARB_gl_spirv, which gl_spirv asks for", info_.name.c_str())};
    if (desc.count_api_calls) {
        install_call_counting();
        counting_ = true;
    }
    if (validation_) start_debug_output(*debug_);
    if (!desc.pipeline_cache.empty() && gl_limit(GL_NUM_PROGRAM_BINARY_FORMATS) > 0)
        programs_ = std::make_unique<ProgramCache>(desc.pipeline_cache, info_.name + "\n" + info_.driver, log_);

    commands_.context_ = context_.get();
    commands_.objects_ = &objects_;
    commands_.labels_ = validation_;
    commands_.uniform_alignment_ =
        std::max<std::uint32_t>(static_cast<std::uint32_t>(gl_limit(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT)), 16);
    glCreateVertexArrays(1, &commands_.vertex_array_);
    commands_.set_fixed_state();
    if (!commands_.uniforms_.start("uniform ring", validation_) ||
        !commands_.records_.start("record ring", validation_) || !commands_.staging_.start("staging ring", validation_))
        return Error{Errc::out_of_memory, text("%s has no memory for the device's rings (3 MiB)", info_.name.c_str())};
    return {};
}

Device::~Device() {
    if (context_ && context_->enter()) {
        glFinish();  // the rings' maps are in use until then
        if (programs_) programs_->save();
        for (Fence& fence : fences_)
            if (fence.sync) glDeleteSync(fence.sync);
        for (Ring* ring : {&commands_.uniforms_, &commands_.records_, &commands_.staging_}) ring->stop();
        commands_.framebuffers_.clear();
        glDeleteVertexArrays(1, &commands_.vertex_array_);
        if (validation_) glDebugMessageCallback(nullptr, nullptr);
        // What the user did not destroy dies with the context.
    }
    context_.reset();
    if (counting_) remove_call_counting();
}

void Device::reset_state() {
    if (context_->enter()) commands_.set_fixed_state();
}

std::uint32_t Device::live_objects() const noexcept {
    return objects_.buffers.size() + objects_.textures.size() + objects_.samplers.size() + objects_.pipelines.size() +
           objects_.groups.size() + objects_.queries.size();
}

void Device::label(GLenum kind, GLuint name, const char* debug_name) const {
    if (!validation_ || !debug_name) return;
    constexpr std::size_t longest = 200;  // GL_MAX_LABEL_LENGTH is at least 256
    glObjectLabel(kind, name, static_cast<GLsizei>(std::min(std::strlen(debug_name), longest)), debug_name);
}

Result<void> Device::enter() {
    if (lost_) return lost_error();
    if (context_->enter()) return {};
    return Error{Errc::invalid_argument,
                 text("The OpenGL device '%s' is in use on another thread: it belongs to the one "
                      "that made it",
                      info_.name.c_str())};
}

}  // namespace pellucid::inline v0_1::opengl
