// SPDX-License-Identifier: MIT
// Each rule of Validated<B>: the sentence it says (names and numbers in it), and that the wrapped backend never saw the
// bad call.  Here are those of handles, order and lifetimes; validated_fit.cpp has those of what must fit together.
#include "support/validated_rig.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::rig::Rig;

static_assert(Backend<Validated<Null>>);
static_assert(Backend<Validated<Validated<Null>>>);

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
