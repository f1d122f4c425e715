// SPDX-License-Identifier: MIT
// Each rule of Validated<B>: the sentence it says (names and numbers in it), and that the wrapped backend never saw the
// bad call.  The wrapped backend is Null, which writes down every call.
#include <algorithm>
#include <memory>
#include <pellucid/rhi/null.hpp>
#include <pellucid/rhi/validated.hpp>
#include <pellucid/shaders/test.hpp>
#include <string>
#include <vector>
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::rhi;

static_assert(Backend<Validated<Null>>);
static_assert(Backend<Validated<Validated<Null>>>);

namespace {
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
}  // namespace

TEST_CASE("correct use is forwarded whole and says nothing", "[cpu]") {
    Rig rig;
    rig.begin();
    rig.commands->draw({.vertex_count = 6});
    rig.commands->bind_index_buffer(rig.indices);
    rig.commands->draw_indexed({.index_count = 6});
    rig.commands->begin_query(rig.counters, 1);
    rig.commands->end_query(rig.counters, 1);
    rig.commands->end_render();
    rig.commands->reset(rig.timers);
    rig.commands->write_timestamp(rig.timers, 1);
    rig.commands->begin_compute(
        {.uses = {use(rig.buffer, Access::uniform_read), use(rig.buffer, Access::storage_read_write)}});
    rig.commands->bind_pipeline(rig.scale);
    rig.commands->bind_group(rig.scale_group);
    rig.commands->push(std::vector<std::byte>(16));
    rig.commands->dispatch(1, 1, 1);
    rig.commands->end_compute();
    rig.commands->begin_copy({.uses = {use(rig.color, Access::copy_read), use(rig.buffer, Access::copy_write)}});
    rig.commands->copy(rig.color, rig.buffer, TextureCopy{});
    rig.commands->end_copy();
    CHECK(rig.device->wait(*rig.device->submit()));
    CHECK(rig.said.empty());
    CHECK(rig.device->violations() == 0);
    for (const char* call : {"draw", "draw_indexed", "begin_query", "end_query", "end_render", "reset",
                             "write_timestamp", "dispatch", "copy_texture_to_buffer", "submit", "wait"})
        CHECK(rig.calls(call) == 1);
}

TEST_CASE("null, stale and foreign handles", "[cpu]") {
    Rig rig;
    rig.begin();
    rig.commands->bind_index_buffer({});
    rig.expect({"bind_index_buffer in the pass 'main'", "buffer's handle is null"}, "bind_index_buffer");
    rig.device->destroy(rig.indices);
    rig.commands->bind_index_buffer(rig.indices);
    rig.expect({"the buffer 'indices' was destroyed"}, "bind_index_buffer");
    Rig other;
    rig.commands->bind_pipeline(other.quads);
    rig.expect({"bind_pipeline", "was not made by this device"}, "bind_pipeline");
    rig.device->destroy(rig.indices);
    rig.expect({"destroy: the buffer 'indices' was destroyed"}, "destroy_pipeline");
    CHECK(rig.device->mapped(rig.indices).empty());
    rig.expect({"mapped", "'indices'"}, "mapped");
    CHECK(rig.device->backend(rig.buffer));
    CHECK_FALSE(rig.device->alive(other.buffer));
}

TEST_CASE("frames and passes begin and end in order", "[cpu]") {
    Rig rig;
    CHECK_FALSE(rig.device->begin_frame());
    rig.expect({"begin_frame: the last frame was not submitted"}, "begin_frame");
    rig.commands->begin_render(rig.pass());
    rig.commands->begin_compute({.name = "inner"});
    rig.expect({"'inner' begins inside the pass 'main'"}, "begin_compute");
    rig.commands->end_copy();
    rig.expect({"end_copy in the pass 'main'"}, "end_copy");
    CHECK_FALSE(rig.device->submit());
    rig.expect({"submit: the pass 'main' has not ended"}, "submit");
    rig.commands->end_render();
    rig.commands->end_render();
    REQUIRE(rig.said.size() == 1);
    CHECK(rig.said[0] == "end_render: no pass was begun");
    rig.said.clear();
    CHECK(rig.calls("end_render") == 1);
    rig.commands->draw({.vertex_count = 3});
    rig.expect({"draw: it belongs inside a render pass"}, "draw");
    rig.commands->update(rig.buffer, 0, bytes_of(1));
    rig.expect({"update: it belongs inside a copy pass"}, "update");
    CHECK(rig.device->submit());
    CHECK_FALSE(rig.device->submit());
    CHECK(rig.said.size() == 1);
    CHECK(rig.calls("submit") == 1);
    rig.said.clear();
    rig.commands->begin_render(rig.pass());
    rig.expect({"'main' begins outside a frame"}, "begin_compute");
    CHECK_FALSE(rig.device->wait(Ticket{99}));
    rig.expect({"wait: ticket 99", "the last was 1"}, "wait");
}

TEST_CASE("work needs a pipeline, frame data, groups and push data", "[cpu]") {
    Rig rig;
    rig.commands->begin_render(rig.pass());
    rig.commands->draw({.vertex_count = 3});
    rig.expect({"draw in the pass 'main': no pipeline is bound"}, "draw");
    rig.commands->bind_pipeline(rig.scale);
    rig.expect({"belongs inside a compute pass"}, "bind_pipeline");
    rig.commands->bind_pipeline(rig.quads);
    rig.commands->draw({.vertex_count = 3});
    rig.expect({"'quads' reads the frame's records, and none are bound"}, "draw");
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->draw({.vertex_count = 3});
    rig.expect({"'fetch' needs a group of 1 bindings in slot 1"}, "draw");
    rig.commands->bind_pipeline(rig.push);
    rig.commands->draw({.vertex_count = 3});
    rig.expect({"'push' reads 128 bytes of push data, and 0 were pushed"}, "draw");
    rig.commands->push(std::vector<std::byte>(64));
    rig.expect({"push", "64 bytes", "'push' takes 128"}, "push");
    rig.commands->push(std::vector<std::byte>(128));
    rig.commands->draw({.vertex_count = 3});
    CHECK(rig.said.empty());
    CHECK(rig.calls("draw") == 1);
}

TEST_CASE("zero sizes and missing index buffers", "[cpu]") {
    Rig rig;
    rig.begin();
    rig.commands->draw({.vertex_count = 0});
    rig.expect({"draw", "0 vertices of 1 instances"}, "draw");
    rig.commands->draw_indexed({.index_count = 6});
    rig.expect({"draw_indexed", "no index buffer is bound"}, "draw_indexed");
    rig.commands->bind_index_buffer(rig.buffer);
    rig.expect({"'values' lacks the usage index"}, "bind_index_buffer");
    rig.commands->bind_index_buffer(rig.indices);
    rig.commands->draw_indexed({.index_count = 6, .first_index = 3});
    rig.expect({"indices 3 to 9 of the buffer 'indices', which has 6"}, "draw_indexed");
    rig.commands->draw_indexed({.index_count = 6, .instance_count = 0});
    rig.expect({"6 indices of 0 instances"}, "draw_indexed");
    rig.commands->draw_indexed_indirect(rig.indices, 0, 1);
    rig.expect({"'indices' lacks the usage indirect"}, "draw_indexed_indirect");
    rig.commands->draw_indexed_indirect(rig.buffer, 200, 3);
    rig.expect({"60 bytes at 200 of the buffer 'values', which has 256"}, "draw_indexed_indirect");
    rig.commands->set_scissor({4, 4, 8, 1});
    rig.expect({"the rectangle ends at 12, 5", "8, 8"}, "set_scissor");
    rig.commands->end_render();
    rig.commands->begin_compute(
        {.uses = {use(rig.buffer, Access::uniform_read), use(rig.buffer, Access::storage_read)}});
    rig.commands->bind_pipeline(rig.scale);
    rig.commands->bind_group(rig.scale_group);
    rig.commands->push(std::vector<std::byte>(16));
    rig.commands->dispatch(1, 0, 1);
    rig.expect({"dispatch", "1x0x1 groups"}, "dispatch");
    rig.commands->dispatch_indirect(rig.buffer, 2);
    rig.expect({"dispatch_indirect", "the offset 2 is no multiple of 4"}, "dispatch_indirect");
}

TEST_CASE("attachments must fit the pass and the pipeline", "[cpu]") {
    Rig rig;
    auto begin = [&](const RenderPassDesc& desc) {
        rig.commands->begin_render(desc);
        rig.commands->draw({.vertex_count = 3});  // silent: the pass itself was refused
        rig.commands->end_render();
    };
    begin({.colors = {{.texture = rig.color}}, .size = {9, 8}, .name = "large"});
    rig.expect({"the render area is 9x8, the attachment 'hdr' only 8x8"}, "begin_render");
    begin({.colors = {{.texture = rig.color}}, .size = {0, 8}, .name = "empty"});
    rig.expect({"'empty'", "the render area is 0x8"}, "begin_render");
    begin({.colors = {{.texture = rig.picture}}, .size = {4, 4}});
    rig.expect({"'picture' lacks the usage attachment"}, "begin_render");
    begin({.colors = {{.texture = rig.depth}}, .size = {4, 4}});
    rig.expect({"'depth' of format d32_float cannot be a colour attachment"}, "begin_render");
    begin({.depth = {.texture = rig.color}, .size = {4, 4}});
    rig.expect({"'hdr' of format rgba8_unorm cannot be the depth attachment"}, "begin_render");
    begin({.colors = {{.texture = rig.color, .mip = 1}}, .size = {4, 4}});
    rig.expect({"level 1 and layer 0 of the texture 'hdr', which has 1 and 1"}, "begin_render");
    begin({.colors = {{.texture = rig.color}, {.texture = rig.color}}, .size = {4, 4}});
    rig.expect({"'hdr' is attached as colours 0 and 1"}, "begin_render");
    begin({.colors = {{.texture = rig.color}}, .uses = {use(rig.color, Access::sampled)}, .size = {4, 4}});
    rig.expect({"'hdr' is attached and declared as used"}, "begin_render");
    begin({.colors = {{.texture = rig.color}}, .uses = {use(rig.picture, Access::storage_read)}, .size = {4, 4}});
    rig.expect({"'picture' was not made for storage_read"}, "begin_render");
    begin({.colors = {{.texture = rig.color}}, .uses = {use(rig.plain, Access::indirect_read)}, .size = {4, 4}});
    rig.expect({"'plain' was not made for indirect_read"}, "begin_render");
    CHECK(rig.calls("draw") + rig.calls("end_render") == 0);

    rig.commands->begin_render(rig.pass());
    rig.commands->bind_pipeline(rig.depth_quads);
    rig.expect({"the depth format of the pipeline 'depth quads' is d32_float, the attachment's is undefined"},
               "bind_pipeline");
    rig.commands->end_render();
    rig.commands->begin_render({.depth = {.texture = rig.depth}, .size = {8, 8}});
    rig.commands->bind_pipeline(rig.quads);
    rig.expect({"'quads' writes 1 colours, the pass attaches 0"}, "bind_pipeline");
    rig.commands->end_render();
    rig.commands->begin_render({.colors = {{.texture = rig.color}},
                                .depth = {.texture = rig.depth, .load = Load::load, .read_only = true},
                                .size = {8, 8}});
    rig.commands->bind_pipeline(rig.depth_quads);
    rig.expect({"'depth quads' writes depth, but 'depth' is read-only"}, "bind_pipeline");
    rig.commands->end_render();
    const Texture hdr16 = *rig.device->make_texture(
        {.size = {8, 8}, .format = Format::rgba16_float, .usage = TextureUsage::attachment, .debug_name = "hdr16"});
    rig.commands->begin_render({.colors = {{.texture = hdr16}}, .size = {8, 8}});
    rig.commands->bind_pipeline(rig.quads);
    rig.expect({"colour 0 of the pipeline 'quads' is rgba8_unorm, the attachment is rgba16_float"}, "bind_pipeline");
    rig.commands->end_render();
    rig.device->destroy(hdr16);
}

TEST_CASE("groups must fit the pipeline and be declared by the pass", "[cpu]") {
    Rig rig;
    rig.commands->begin_render(rig.pass());
    rig.commands->bind_group(rig.texture_group);
    rig.expect({"no pipeline is bound; bind it before the group 'inputs'"}, "bind_group");
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->bind_group(rig.texture_group);
    rig.expect({"'inputs', binding 12", "does not declare its use of the texture 'picture'"}, "bind_group");
    rig.commands->bind_group(rig.scale_group);
    rig.expect({"'scaled' has 2 bindings of another layout than the 1 that the pipeline 'fetch' has in slot 1"},
               "bind_group");
    rig.commands->end_render();
    // A group over a texture that the same pass attaches.
    const GroupLayout layout{.bindings = {{12, BindingKind::sampled_texture}}};
    const Group loop =
        *rig.device->make_group({.layout = layout,
                                 .bindings = {{.binding = 12, .texture = rig.color, .sampler = rig.sampler}},
                                 .debug_name = "loop"});
    rig.commands->begin_render(rig.pass());
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->bind_group(loop);
    rig.expect({"'loop', binding 12: the texture 'hdr' is attached to the pass"}, "bind_group");
    rig.commands->end_render();
    rig.device->destroy(loop);
    // A storage buffer, undeclared.
    rig.commands->begin_compute({.uses = {use(rig.buffer, Access::uniform_read)}, .name = "scale it"});
    rig.commands->bind_pipeline(rig.scale);
    rig.commands->bind_group(rig.scale_group);
    rig.expect({"'scale it'", "'scaled', binding 13", "does not declare its use of the buffer 'values'"}, "bind_group");
    rig.commands->end_compute();
    // A group outlived by what it binds.
    rig.commands->begin_render(
        {.colors = {{.texture = rig.color}}, .uses = {use(rig.picture, Access::sampled)}, .size = {8, 8}});
    rig.device->destroy(rig.picture);
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->bind_group(rig.texture_group);
    rig.expect({"the texture 'picture' was destroyed"}, "bind_group");
    rig.commands->end_render();
}

TEST_CASE("a pipeline of another layout drops the bound groups", "[cpu]") {
    Rig rig;
    rig.commands->begin_render(
        {.colors = {{.texture = rig.color}}, .uses = {use(rig.picture, Access::sampled)}, .size = {8, 8}});
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->bind_group(rig.texture_group);
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->draw({.vertex_count = 3});  // the same layout: still bound
    CHECK(rig.said.empty());
    rig.commands->bind_pipeline(rig.push);
    rig.commands->bind_pipeline(rig.fetch);
    rig.device->backend().clear_calls();
    rig.commands->draw({.vertex_count = 3});
    rig.expect({"'fetch' needs a group"}, "draw");
}

TEST_CASE("what is made must fit: groups and pipelines", "[cpu]") {
    Rig rig;
    const GroupLayout uniform{.bindings = {{12, BindingKind::uniform_buffer}}};
    const GroupLayout storage{.bindings = {{0, BindingKind::storage_texture}}};
    CHECK_FALSE(rig.device->make_group({.slot = GroupSlot::frame, .debug_name = "frame"}));
    rig.expect({"group 'frame'", "group 0 is the device's"}, "make_group");
    CHECK_FALSE(rig.device->make_group({.layout = uniform, .bindings = {{12, rig.plain}}, .debug_name = "g"}));
    rig.expect({"group 'g', binding 12", "'plain' lacks the usage uniform"}, "make_group");
    CHECK_FALSE(rig.device->make_group({.layout = uniform, .bindings = {{13, rig.buffer}}, .debug_name = "g"}));
    rig.expect({"binding 13 is not in its layout"}, "make_group");
    CHECK_FALSE(rig.device->make_group({.layout = storage, .bindings = {{.binding = 0, .texture = rig.picture}}}));
    rig.expect({"'picture' lacks the usage storage"}, "make_group");
    GraphicsPipelineDesc desc;
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_fetch_frag;
    desc.debug_name = "forgetful";
    CHECK_FALSE(rig.device->make_pipeline(desc));
    rig.expect({"'forgetful'", "'test/fetch.frag' reads binding 12 of group 1"}, "make_graphics_pipeline");
}

TEST_CASE("copies stay in bounds, are declared and have their usages", "[cpu]") {
    Rig rig;
    rig.commands->begin_copy({.uses = {use(rig.buffer, Access::copy_read), use(rig.buffer, Access::copy_write),
                                       use(rig.readback, Access::copy_write), use(rig.color, Access::copy_read)},
                              .name = "copies"});
    rig.commands->copy(rig.buffer, rig.readback, BufferCopy{.source_offset = 224, .size = 64});
    rig.expect({"copy in the pass 'copies'", "64 bytes at 224 of the buffer 'values', which has 256"}, "copy");
    rig.commands->copy(rig.buffer, rig.readback, BufferCopy{.size = 65});
    rig.expect({"65 bytes at 0 of the buffer 'result', which has 64"}, "copy");
    rig.commands->copy(rig.buffer, rig.readback, BufferCopy{.size = 0});
    rig.expect({"0 bytes of the buffer 'values'"}, "copy");
    rig.commands->copy(rig.buffer, rig.buffer, BufferCopy{.destination_offset = 8, .size = 16});
    rig.expect({"overlap"}, "copy");
    rig.commands->copy(rig.readback, rig.buffer, BufferCopy{.size = 4});
    rig.expect({"'result' lacks the usage copy_source"}, "copy");
    rig.commands->update(rig.buffer, 250, std::vector<std::byte>(8));
    rig.expect({"update", "8 bytes at 250 of the buffer 'values'"}, "update");
    rig.commands->fill(rig.buffer, 2, 8, 0);
    rig.expect({"fill", "8 bytes at 2"}, "fill");
    rig.commands->copy(rig.color, rig.readback, TextureCopy{});
    rig.expect({"256 bytes at 0 of the buffer 'result', which has 64"}, "copy_texture_to_buffer");
    rig.commands->copy(rig.color, rig.buffer, TextureCopy{.mip = 3});
    rig.expect({"level 3 and layer 0 of the texture 'hdr'"}, "copy_texture_to_buffer");
    rig.commands->copy(rig.color, rig.buffer, TextureCopy{.buffer_offset = 8});
    rig.expect({"the offset 8 is no multiple of 16"}, "copy_texture_to_buffer");
    rig.commands->copy(rig.buffer, rig.picture, TextureCopy{});
    rig.expect({"'picture' lacks the usage copy_destination"}, "copy_buffer_to_texture");
    rig.commands->generate_mips(rig.picture);
    rig.expect({"generate_mips", "'picture' lacks the usage"}, "generate_mips");
    rig.commands->end_copy();
    rig.commands->begin_copy({.name = "undeclared"});
    rig.commands->update(rig.buffer, 0, bytes_of(1));
    rig.expect({"'undeclared': the pass does not declare copy_write of the buffer 'values'"}, "update");
}

TEST_CASE("frame data belongs to its frame", "[cpu]") {
    Rig rig;
    const UniformSlice padding = *rig.commands->upload_uniforms(bytes_of(1));
    const UniformSlice old = *rig.commands->upload_uniforms(bytes_of(1));
    CHECK(padding.offset != old.offset);
    CHECK_FALSE(rig.commands->upload_uniforms({}));
    rig.expect({"upload_uniforms", "0 bytes"}, "none");
    CHECK_FALSE(rig.commands->upload_records(4, 48));
    rig.expect({"upload_records", "4 records of 48 bytes"}, "upload_records");
    CHECK(rig.device->submit());
    CHECK_FALSE(rig.commands->upload_uniforms(bytes_of(1)));
    rig.expect({"upload_uniforms: no frame was begun"}, "none");
    rig.commands = *rig.device->begin_frame();
    rig.commands->begin_render(rig.pass());
    rig.commands->bind_pipeline(rig.quads);
    rig.commands->bind_frame(old, {});
    rig.expect({"bind_frame", "were not uploaded in this frame"}, "bind_frame");
}

TEST_CASE("queries are reset outside passes, ranged, of their kind and closed", "[cpu]") {
    Rig rig;
    rig.commands->write_timestamp(rig.counters, 0);
    rig.expect({"write_timestamp", "'counters' is of the other kind"}, "write_timestamp");
    rig.commands->write_timestamp(rig.timers, 2);
    rig.expect({"query 2 of the pool 'timers', which has 2"}, "write_timestamp");
    rig.begin();
    rig.commands->reset(rig.counters);
    rig.expect({"reset in the pass 'main': it belongs outside passes"}, "reset");
    rig.commands->end_query(rig.counters, 0);
    rig.expect({"end_query", "query 0 was not begun"}, "end_query");
    rig.commands->begin_query(rig.counters, 0);
    rig.device->backend().clear_calls();
    rig.commands->begin_query(rig.counters, 1);
    rig.expect({"begin_query", "query 0 is still open"}, "begin_query");
    rig.commands->end_render();
    CHECK(rig.calls("end_query") == 1);  // closed for the backend's sake
    CHECK(rig.calls("end_render") == 1);
    rig.expect({"end_render in the pass 'main': query 0 has not ended"}, "begin_query");
    std::uint64_t out[3];
    CHECK_FALSE(rig.device->results(rig.timers, 0, out));
    rig.expect({"results: queries 0 to 3 of the pool 'timers', which has 2"}, "results");
}

TEST_CASE("objects that outlive their device are named", "[cpu]") {
    std::string said;
    {
        DeviceDesc desc;
        desc.log = {[](void* user, Severity, const char* text) { *static_cast<std::string*>(user) += text; }, &said};
        auto device = std::move(*Validated<Null>::create(desc));
        (void)device->make_buffer({.size = 4, .debug_name = "forgotten"});
        (void)device->make_texture({.size = {1, 1}, .debug_name = "lost"});
        device->destroy(*device->make_sampler({}));
        CHECK(said.empty());
    }
    CHECK(said == "the device is destroyed before 2 of its objects: buffer 'forgotten' texture 'lost'");
}

TEST_CASE("an error of the backend passes through", "[cpu]") {
    Rig rig;
    rig.device->backend().fail_after(1);
    const auto made = rig.device->make_texture({.size = {4, 4}, .debug_name = "unlucky"});
    REQUIRE_FALSE(made);
    CHECK(made.error().code == Errc::out_of_memory);
    rig.device->backend().lose();
    CHECK(rig.device->submit().error().code == Errc::device_lost);
    CHECK(rig.device->begin_frame().error().code == Errc::device_lost);
    CHECK(rig.device->begin_frame().error().code == Errc::device_lost);  // still, and no "not submitted"
    CHECK(rig.said.empty());
}
