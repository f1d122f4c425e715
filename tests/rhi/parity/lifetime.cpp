// SPDX-License-Identifier: MIT
// Objects destroyed while the GPU uses them, live-object counts, and a steady frame that allocates nothing.
#include "support/allocations.hpp"
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

TEMPLATE_LIST_TEST_CASE("objects may be destroyed while their frame is in flight", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{64, 64};
    const auto result = own(*device, device->make_buffer({.size = 64 * 64 * 4,
                                                          .usage = BufferUsage::copy_destination,
                                                          .memory = Memory::readback,
                                                          .debug_name = "result"}));
    const GroupLayout layout{.bindings = {{12, BindingKind::sampled_texture}}};
    Ticket last{};
    for (std::uint32_t frame = 0; frame < 10; ++frame) {
        const std::vector<std::uint32_t> texels(64 * 64, 0xFF000000u | frame);
        const auto texture = own(*device, device->make_texture({.size = size,
                                                                .initial = std::as_bytes(std::span(texels)),
                                                                .debug_name = "short-lived texture"}));
        const auto target = test::make_target(*device, size);
        const auto sampler = own(*device, device->make_sampler({.min = Filter::nearest, .mag = Filter::nearest}));
        auto desc = test::quad_desc();
        desc.vertex = &shaders::test_fullscreen_vert;
        desc.fragment = &shaders::test_fetch_frag;
        desc.pass_group = layout;
        const auto pipeline = own(*device, device->make_pipeline(desc));
        const auto group =
            own(*device, device->make_group({.layout = layout,
                                             .bindings = {{.binding = 12, .texture = texture, .sampler = sampler}}}));
        auto* commands = test::must(device->begin_frame());
        commands->begin_render(
            {.colors = {{.texture = target}}, .uses = {use(texture.get(), Access::sampled)}, .size = size});
        commands->bind_pipeline(pipeline);
        commands->bind_group(group);
        commands->draw({.vertex_count = 3});
        commands->end_render();
        commands->begin_copy({.uses = {use(target.get(), Access::copy_read), use(result.get(), Access::copy_write)}});
        commands->copy(target.get(), result.get(), TextureCopy{});
        commands->end_copy();
        last = test::must(device->submit());
    }  // everything but `result` is destroyed here, unwaited
    CHECK(device->live_objects() == 1);
    test::must(device->wait(last));
    std::vector<std::uint32_t> found(64 * 64);
    std::memcpy(found.data(), device->mapped(result).data(), 64 * 64 * 4);
    for (const std::uint32_t texel : found) REQUIRE(texel == (0xFF000000u | 9));
}

TEMPLATE_LIST_TEST_CASE("live objects are counted, and stale handles are known", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    CHECK(device->live_objects() == 0);
    const auto buffer = test::must(device->make_buffer({.size = 16}));
    const auto texture = test::must(device->make_texture({.size = {4, 4}}));
    const auto sampler = test::must(device->make_sampler({}));
    const auto queries = test::must(device->make_queries({.count = 2}));
    const auto pipeline = test::must(device->make_pipeline(test::quad_desc()));
    const GroupLayout layout{.bindings = {{12, BindingKind::storage_buffer}}};
    const auto group = test::must(device->make_group({.layout = layout, .bindings = {{12, buffer}}}));
    CHECK(device->live_objects() == 6);
    CHECK(device->alive(group));
    device->destroy(group);
    device->destroy(pipeline);
    device->destroy(queries);
    device->destroy(sampler);
    device->destroy(texture);
    device->destroy(buffer);
    CHECK(device->live_objects() == 0);
    CHECK_FALSE(device->alive(buffer));
    CHECK_FALSE(device->alive(texture));
    CHECK_FALSE(device->alive(sampler));
    CHECK_FALSE(device->alive(queries));
    CHECK_FALSE(device->alive(pipeline));
    CHECK_FALSE(device->alive(group));
    CHECK(device->mapped(buffer).empty());
}

TEMPLATE_LIST_TEST_CASE("a steady frame makes no heap allocation", "[gpu]", test::Backends) {
    // Without validation: layers and debug outputs allocate as they like.
    const auto device = test::make_device<TestType>([](DeviceDesc& desc) { desc.validation = false; });
    if (!device) return;
    constexpr Extent2D size{16, 16};
    const auto target = test::make_target(*device, size);
    const auto buffer = own(
        *device,
        device->make_buffer({.size = 1024,
                             .usage = BufferUsage::storage | BufferUsage::copy_destination | BufferUsage::copy_source,
                             .debug_name = "values"}));
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const auto queries = own(*device, device->make_queries({.count = 2}));
    const GroupLayout layout{.bindings = {{12, BindingKind::uniform_buffer}, {13, BindingKind::storage_buffer}}};
    const auto scale = own(*device, device->make_pipeline(ComputePipelineDesc{
                                        .compute = &shaders::test_scale_comp, .pass_group = layout, .push_bytes = 16}));
    const auto uniforms = own(*device, device->make_buffer({.size = 16, .usage = BufferUsage::uniform}));
    const auto group =
        own(*device, device->make_group({.layout = layout, .bindings = {{12, uniforms.get()}, {13, buffer.get()}}}));
    const std::vector<test::Quad> quads(100);
    const std::uint32_t push[4] = {1, 64, 0, 0};
    auto frame = [&] {
        auto* commands = *device->begin_frame();
        commands->reset(queries);
        const auto records = *commands->upload_records(100, sizeof(test::Quad));
        std::memcpy(records.bytes.data(), quads.data(), records.bytes.size());
        const auto slice = *commands->upload_uniforms(bytes_of(push));
        commands->write_timestamp(queries, 0);
        commands->begin_copy({.uses = {use(buffer.get(), Access::copy_write)}});
        commands->update(buffer, 0, bytes_of(push));
        commands->fill(buffer, 64, 64, 0);
        commands->end_copy();
        commands->begin_compute(
            {.uses = {use(uniforms.get(), Access::uniform_read), use(buffer.get(), Access::storage_read_write)}});
        commands->bind_pipeline(scale);
        commands->bind_group(group);
        commands->push(bytes_of(push));
        commands->dispatch(1, 1, 1);
        commands->end_compute();
        commands->begin_render({.colors = {{.texture = target}}, .size = size});
        commands->bind_pipeline(pipeline);
        commands->bind_frame(slice, records);
        for (std::uint32_t i = 0; i < 100; ++i)
            commands->draw({.vertex_count = 6, .first_instance = records.first + i});
        commands->end_render();
        commands->write_timestamp(queries, 1);
        return *device->submit();
    };
    for (int i = 0; i < 20; ++i) (void)frame();
    const std::uint64_t before = test::allocations();
    Ticket last{};
    for (int i = 0; i < 20; ++i) last = frame();
    const std::uint64_t made = test::allocations() - before;
    test::must(device->wait(last));
    CHECK(made == 0);
}
