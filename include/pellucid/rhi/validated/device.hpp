// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// `Validated<B>::Device`: keeps what it knows of each object and forwards with the backend's own handles.
#include <memory>
#include <pellucid/rhi/surface.hpp>
#include <pellucid/rhi/validated/commands.hpp>

namespace pellucid::inline v0_1::validated {

/// Models `DeviceOf<Device, Commands>`.
template <rhi::Backend B>
class Device {
public:
    Device(std::unique_ptr<typename B::Device> inner, LogSink log)
        : inner_(std::move(inner)), objects_(next_tag()), create_(objects_), commands_(objects_) {
        objects_.report.log = log;
    }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    /// Names what was never destroyed.
    ~Device() {
        const std::string leaked = objects_.buffers.names() + objects_.textures.names() + objects_.samplers.names() +
                                   objects_.pipelines.names() + objects_.groups.names() + objects_.queries.names();
        if (!leaked.empty())
            objects_.report("the device is destroyed before ", live_objects(), " of its objects:", leaked);
    }

    Result<rhi::Buffer> make_buffer(const rhi::BufferDesc& desc) {
        PELLUCID_TRY(const rhi::Buffer made, inner_->make_buffer(desc));
        return objects_.buffers.insert({made, desc.debug_name, desc.size, desc.usage});
    }
    std::span<std::byte> mapped(rhi::Buffer buffer) {
        const BufferInfo* info = objects_.find(buffer, "mapped");
        return info ? inner_->mapped(info->inner) : std::span<std::byte>{};
    }
    Result<rhi::Texture> make_texture(const rhi::TextureDesc& desc) {
        PELLUCID_TRY(const rhi::Texture made, inner_->make_texture(desc));
        TextureInfo info{made, desc.debug_name, desc};
        info.desc.initial = {};
        info.desc.debug_name = "";
        return objects_.textures.insert(std::move(info));
    }
    Result<rhi::Sampler> make_sampler(const rhi::SamplerDesc& desc) {
        PELLUCID_TRY(const rhi::Sampler made, inner_->make_sampler(desc));
        return objects_.samplers.insert({made, desc.debug_name});
    }
    Result<rhi::Pipeline> make_pipeline(const rhi::GraphicsPipelineDesc& desc) { return make_checked_pipeline(desc); }
    Result<rhi::Pipeline> make_pipeline(const rhi::ComputePipelineDesc& desc) { return make_checked_pipeline(desc); }
    Result<rhi::Group> make_group(const rhi::GroupDesc& desc) {
        GroupInfo info{.name = desc.debug_name, .desc = desc};
        info.desc.debug_name = "";
        rhi::GroupDesc inner;
        if (!create_.group(desc, inner)) return misused("group", desc.debug_name);
        PELLUCID_TRY(info.inner, inner_->make_group(inner));
        return objects_.groups.insert(std::move(info));
    }
    Result<rhi::Queries> make_queries(const rhi::QueriesDesc& desc) {
        PELLUCID_TRY(const rhi::Queries made, inner_->make_queries(desc));
        return objects_.queries.insert({made, desc.debug_name, desc.kind, desc.count});
    }
    Result<void> results(rhi::Queries queries, std::uint32_t first, std::span<std::uint64_t> out) {
        if (!create_.results(queries, first, out.size()))
            return Error{Errc::invalid_argument, "results was misused: see the log"};
        return inner_->results(objects_.queries.find(queries)->inner, first, out);
    }

    void destroy(rhi::Buffer object) { destroy_checked(object); }
    void destroy(rhi::Texture object) { destroy_checked(object); }
    void destroy(rhi::Sampler object) { destroy_checked(object); }
    void destroy(rhi::Pipeline object) { destroy_checked(object); }
    void destroy(rhi::Group object) { destroy_checked(object); }
    void destroy(rhi::Queries object) { destroy_checked(object); }
    bool alive(rhi::Buffer object) const { return objects_.buffers.find(object); }
    bool alive(rhi::Texture object) const { return objects_.textures.find(object); }
    bool alive(rhi::Sampler object) const { return objects_.samplers.find(object); }
    bool alive(rhi::Pipeline object) const { return objects_.pipelines.find(object); }
    bool alive(rhi::Group object) const { return objects_.groups.find(object); }
    bool alive(rhi::Queries object) const { return objects_.queries.find(object); }

    Result<Commands<B>*> begin_frame() {
        if (!commands_.checks_.begin_frame())
            return Error{Errc::invalid_argument, "begin_frame was misused: see the log"};
        auto inner = inner_->begin_frame();
        if (!inner) {
            commands_.checks_.abandon_frame();
            return inner.error();
        }
        commands_.inner_ = *inner;
        return &commands_;
    }
    Result<rhi::Ticket> submit() {
        if (!commands_.checks_.submit()) return Error{Errc::invalid_argument, "submit was misused: see the log"};
        commands_.inner_ = nullptr;
        auto ticket = inner_->submit();
        if (ticket) last_ = *ticket;
        return ticket;
    }
    Result<void> wait(rhi::Ticket ticket) {
        if (ticket > last_) {
            objects_.report("wait: ticket ", static_cast<std::uint64_t>(ticket), " was not given out; the last was ",
                            static_cast<std::uint64_t>(last_));
            return Error{Errc::invalid_argument, "wait was misused: see the log"};
        }
        return inner_->wait(ticket);
    }
    bool done(rhi::Ticket ticket) { return inner_->done(ticket); }
    const rhi::DeviceInfo& info() const { return inner_->info(); }
    std::uint64_t api_calls() const { return inner_->api_calls(); }
    std::uint32_t live_objects() const { return inner_->live_objects(); }

    /// Whether `Surface::present` may show a texture now; says why not.
    [[nodiscard]] bool may_present(rhi::Texture texture) {
        if (commands_.checks_.recording())
            return objects_.report("present: a frame is being recorded; submit it first");
        const TextureInfo* info = objects_.find(texture, "present");
        if (!info) return false;
        if (!has(info->desc.usage, rhi::TextureUsage::copy_source))
            return objects_.report("present: the texture '", info->name, "' lacks the usage copy_source");
        const Result<void> shown = rhi::check_presentable(info->desc.format, info->name.c_str());
        return shown ? true : objects_.report(shown.error().message);
    }

    /// Rules broken so far; each one was said to the log.
    [[nodiscard]] std::uint64_t violations() const { return objects_.report.violations; }
    /// The wrapped device, and its handle of one of this device's live objects.
    [[nodiscard]] typename B::Device& backend() { return *inner_; }
    template <class H>
    [[nodiscard]] H backend(H handle) {
        const auto* info = objects_.of(handle).find(handle);
        return info ? info->inner : H{};
    }

private:
    static std::uint32_t next_tag() {
        static std::uint32_t tag = 0;
        tag = tag % 15u + 1u;
        return tag;
    }
    static Error misused(const char* kind, const char* name) {
        return {Errc::invalid_argument, text("the ", kind, " '", name, "' breaks a rule: see the log")};
    }
    template <class Desc>
    Result<rhi::Pipeline> make_checked_pipeline(const Desc& desc) {
        PipelineInfo info;
        if (!create_.pipeline(desc, info)) return misused("pipeline", desc.debug_name);
        PELLUCID_TRY(info.inner, inner_->make_pipeline(desc));
        return objects_.pipelines.insert(std::move(info));
    }
    template <class H>
    void destroy_checked(H object) {
        if (!object) return;  // destroying nothing is allowed
        auto& table = objects_.of(object);
        if (!objects_.find(object, "destroy")) return;
        inner_->destroy(table.erase(object).inner);
    }

    std::unique_ptr<typename B::Device> inner_;
    Objects objects_;
    CreationChecks create_;
    Commands<B> commands_;
    rhi::Ticket last_ = rhi::Ticket::none;
};

}  // namespace pellucid::inline v0_1::validated
