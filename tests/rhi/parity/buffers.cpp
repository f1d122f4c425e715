// SPDX-License-Identifier: MIT
// Buffers: creation, mapped memory, copies, updates, fills, and their two kinds of binding.
#include <numeric>
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

namespace {
constexpr auto both_copies = BufferUsage::copy_source | BufferUsage::copy_destination;

std::vector<std::uint32_t> counting(std::size_t count, std::uint32_t from = 0) {
    std::vector<std::uint32_t> out(count);
    std::iota(out.begin(), out.end(), from);
    return out;
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("initial content of a device buffer, also of many megabytes", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, std::size_t{5} << 20}) {
        const auto words = counting(count, 3);
        const auto buffer = own(*device, device->make_buffer({.size = count * 4,
                                                              .usage = both_copies,
                                                              .initial = std::as_bytes(std::span(words)),
                                                              .debug_name = "initial"}));
        CHECK(device->mapped(buffer).empty());
        CHECK(test::read<std::uint32_t>(*device, buffer.get(), count) == words);
    }
}

TEMPLATE_LIST_TEST_CASE("upload memory is mapped for its whole life and seen by the next submission", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const auto first = counting(64, 1);
    const auto buffer = own(*device, device->make_buffer({.size = 256,
                                                          .usage = BufferUsage::copy_source,
                                                          .memory = Memory::upload,
                                                          .initial = std::as_bytes(std::span(first)),
                                                          .debug_name = "upload"}));
    CHECK(test::read<std::uint32_t>(*device, buffer.get(), 64) == first);
    const auto second = counting(64, 1000);
    REQUIRE(device->mapped(buffer).size() == 256);
    std::memcpy(device->mapped(buffer).data(), second.data(), 256);
    CHECK(test::read<std::uint32_t>(*device, buffer.get(), 64) == second);
}

TEMPLATE_LIST_TEST_CASE("copies, updates and fills touch exactly their bytes", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const auto words = counting(64);
    const auto source = own(
        *device,
        device->make_buffer(
            {.size = 256, .usage = both_copies, .initial = std::as_bytes(std::span(words)), .debug_name = "source"}));
    const auto target = own(*device, device->make_buffer({.size = 256, .usage = both_copies, .debug_name = "target"}));
    const std::uint32_t update[3] = {100, 200, 300};
    test::run(*device, [&](auto& commands) {
        commands.begin_copy({.uses = {use(target.get(), Access::copy_write)}, .name = "fill"});
        commands.fill(target, 0, 256, 0xABCD1234u);
        commands.end_copy();
        commands.begin_copy({.uses = {use(source.get(), Access::copy_read), use(target.get(), Access::copy_write)},
                             .name = "copy and update"});
        commands.copy(source.get(), target.get(),
                      BufferCopy{.source_offset = 40, .destination_offset = 16, .size = 32});
        commands.update(target, 128, bytes_of(update));
        commands.end_copy();
        commands.begin_copy({.uses = {use(target.get(), Access::copy_write)}, .name = "fill a part"});
        commands.fill(target, 200, 8, 7);
        commands.end_copy();
    });
    const auto found = test::read<std::uint32_t>(*device, target.get(), 64);
    for (std::uint32_t i = 0; i < 64; ++i) {
        INFO("word " << i);
        const std::uint32_t expected = i >= 4 && i < 12     ? i + 6
                                       : i >= 32 && i < 35  ? update[i - 32]
                                       : i == 50 || i == 51 ? 7
                                                            : 0xABCD1234u;
        CHECK(found[i] == expected);
    }
}

TEMPLATE_LIST_TEST_CASE("updates larger than 64 KiB are split, and many in a frame do not meet", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr std::size_t count = 50'000;  // 200,000 bytes
    const auto buffer = own(*device, device->make_buffer({.size = 8 * count * 4, .usage = both_copies}));
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        test::run(*device, [&](auto& commands) {
            commands.begin_copy({.uses = {use(buffer.get(), Access::copy_write)}, .name = "updates"});
            for (std::uint32_t i = 0; i < 8; ++i) {
                const auto words = counting(count, i * 1'000'000 + frame);
                commands.update(buffer, i * count * 4, std::as_bytes(std::span(words)));
            }
            commands.end_copy();
        });
        const auto found = test::read<std::uint32_t>(*device, buffer.get(), 8 * count);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < found.size(); ++i) wrong += found[i] != i / count * 1'000'000 + frame + i % count;
        CHECK(wrong == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("a dispatch reads uniforms and push data and writes storage", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const GroupLayout layout{.bindings = {{12, BindingKind::uniform_buffer}, {13, BindingKind::storage_buffer}}};
    const auto pipeline =
        own(*device,
            device->make_pipeline(ComputePipelineDesc{
                .compute = &shaders::test_scale_comp, .pass_group = layout, .push_bytes = 16, .debug_name = "scale"}));
    const std::uint32_t factor[4] = {3, 0, 0, 0};
    const auto uniforms = own(*device, device->make_buffer({.size = 16,
                                                            .usage = BufferUsage::uniform,
                                                            .initial = std::as_bytes(std::span(factor)),
                                                            .debug_name = "factor"}));
    const auto words = counting(100);
    const auto values = own(*device, device->make_buffer({.size = 400,
                                                          .usage = BufferUsage::storage | both_copies,
                                                          .initial = std::as_bytes(std::span(words)),
                                                          .debug_name = "values"}));
    // The bindings in another order than the layout's.
    const auto group = own(*device, device->make_group({.layout = layout,
                                                        .bindings = {{13, values.get()}, {12, uniforms.get()}},
                                                        .debug_name = "scale"}));
    const std::uint32_t push[4] = {1000, 90, 0, 0};
    test::run(*device, [&](auto& commands) {
        commands.begin_compute(
            {.uses = {use(uniforms.get(), Access::uniform_read), use(values.get(), Access::storage_read_write)},
             .name = "scale"});
        commands.bind_pipeline(pipeline);
        commands.bind_group(group);
        commands.push(bytes_of(push));
        commands.dispatch(2, 1, 1);
        commands.end_compute();
    });
    const auto found = test::read<std::uint32_t>(*device, values.get(), 100);
    for (std::uint32_t i = 0; i < 100; ++i) CHECK(found[i] == (i < 90 ? 3 * i + 1000 : i));
}
