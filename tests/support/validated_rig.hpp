// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A device that checks how it is used, over one that only writes down what reaches it.
#include <algorithm>
#include <memory>
#include <pellucid/rhi/null.hpp>
#include <pellucid/rhi/validated.hpp>
#include <pellucid/shaders/test.hpp>
#include <string>
#include <vector>
#include "support/catch.hpp"

namespace pellucid::test::rig {
using namespace pellucid::rhi;

/// A validated null device with one object of each kind, and what it said.
struct Rig {
    using Device = validated::Device<Null>;
    std::vector<std::string> said;
    std::unique_ptr<Device> device;
    validated::Commands<Null>* commands = nullptr;
    Buffer buffer, indices, readback, plain;
    Texture color, depth, picture;
    Sampler sampler;
    Pipeline quads, depth_quads, push, fetch, scale;
    Group texture_group, scale_group;
    Queries timers, counters;

    Rig() {
        DeviceDesc desc;
        desc.log = {[](void* user, Severity severity, const char* text) {
                        if (severity == Severity::error) static_cast<Rig*>(user)->said.push_back(text);
                    },
                    this};
        device = std::move(*Validated<Null>::create(desc));
        const auto all = BufferUsage::uniform | BufferUsage::storage | BufferUsage::indirect |
                         BufferUsage::copy_source | BufferUsage::copy_destination;
        buffer = *device->make_buffer({.size = 256, .usage = all, .debug_name = "values"});
        indices = *device->make_buffer({.size = 24, .usage = BufferUsage::index, .debug_name = "indices"});
        readback = *device->make_buffer(
            {.size = 64, .usage = BufferUsage::copy_destination, .memory = Memory::readback, .debug_name = "result"});
        plain = *device->make_buffer({.size = 64, .usage = BufferUsage::none, .debug_name = "plain"});
        const auto used = TextureUsage::attachment | TextureUsage::sampled | TextureUsage::copy_source;
        color = *device->make_texture({.size = {8, 8}, .usage = used, .debug_name = "hdr"});
        depth =
            *device->make_texture({.size = {8, 8}, .format = Format::d32_float, .usage = used, .debug_name = "depth"});
        picture = *device->make_texture({.size = {4, 4}, .mips = 2, .debug_name = "picture"});
        sampler = *device->make_sampler({});
        GraphicsPipelineDesc g;
        g.vertex = &shaders::test_quad_vert;
        g.fragment = &shaders::test_color_frag;
        g.colors.push_back({});
        g.debug_name = "quads";
        quads = *device->make_pipeline(g);
        g.depth = {.format = Format::d32_float, .test = true, .write = true};
        g.debug_name = "depth quads";
        depth_quads = *device->make_pipeline(g);
        g.depth = {};
        g.vertex = &shaders::test_fullscreen_vert;
        g.fragment = &shaders::test_push_frag;
        g.push_bytes = 128;
        g.debug_name = "push";
        push = *device->make_pipeline(g);
        const GroupLayout sampled{.bindings = {{12, BindingKind::sampled_texture}}};
        g.fragment = &shaders::test_fetch_frag;
        g.push_bytes = 0;
        g.pass_group = sampled;
        g.debug_name = "fetch";
        fetch = *device->make_pipeline(g);
        const GroupLayout two{.bindings = {{12, BindingKind::uniform_buffer}, {13, BindingKind::storage_buffer}}};
        scale = *device->make_pipeline(ComputePipelineDesc{
            .compute = &shaders::test_scale_comp, .pass_group = two, .push_bytes = 16, .debug_name = "scale"});
        texture_group = *device->make_group({.layout = sampled,
                                             .bindings = {{.binding = 12, .texture = picture, .sampler = sampler}},
                                             .debug_name = "inputs"});
        scale_group =
            *device->make_group({.layout = two, .bindings = {{12, buffer}, {13, buffer}}, .debug_name = "scaled"});
        timers = *device->make_queries({.kind = QueryKind::timestamp, .count = 2, .debug_name = "timers"});
        counters = *device->make_queries({.kind = QueryKind::occlusion, .count = 2, .debug_name = "counters"});
        commands = *device->begin_frame();
        REQUIRE(said.empty());
        device->backend().clear_calls();
    }
    ~Rig() {
        device->destroy(texture_group);
        device->destroy(scale_group);
        for (const auto p : {quads, depth_quads, push, fetch, scale}) device->destroy(p);
        for (const auto b : {buffer, indices, readback, plain})
            if (device->alive(b)) device->destroy(b);
        for (const auto t : {color, depth, picture})
            if (device->alive(t)) device->destroy(t);
        device->destroy(sampler);
        device->destroy(timers);
        device->destroy(counters);
    }

    /// Exactly one sentence was said since the last question; it has all the words; the backend did not see `call`.
    void expect(const std::vector<std::string>& words, const std::string& call) {
        REQUIRE(said.size() == 1);
        for (const auto& word : words) {
            INFO("the sentence: " << said[0]);
            CHECK(said[0].find(word) != std::string::npos);
        }
        CHECK(device->violations() > 0);
        CHECK(calls(call) == 0);
        said.clear();
    }
    long calls(const std::string& name) const {
        const auto& all = device->backend().calls();
        return std::count_if(all.begin(), all.end(), [&](const null::Call& call) { return call.name == name; });
    }
    RenderPassDesc pass() const { return {.colors = {{.texture = color}}, .size = {8, 8}, .name = "main"}; }
    /// A render pass with the pipeline, its records and its frame bound.
    void begin() {
        const auto records = *commands->upload_records(1, 64);
        commands->begin_render(pass());
        commands->bind_pipeline(quads);
        commands->bind_frame({}, records);
        device->backend().clear_calls();
    }
};

}  // namespace pellucid::test::rig
