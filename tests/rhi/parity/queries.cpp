// SPDX-License-Identifier: MIT
// Occlusion counts and timestamps.
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

TEMPLATE_LIST_TEST_CASE("occlusion queries count the samples that passed, and a pool can be used again", "[gpu]",
                        test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    constexpr Extent2D size{16, 8};
    const auto target = test::make_target(*device, size);
    const auto depth = test::make_depth(*device, size);
    auto desc = test::quad_desc();
    desc.depth = {.format = Format::d32_float, .test = true, .write = true};
    const auto pipeline = own(*device, device->make_pipeline(desc));
    const auto queries = own(*device, device->make_queries({.kind = QueryKind::occlusion, .count = 3}));
    // Everything; the half that a later, farther quad may not pass; nothing.
    const test::Quad quads[] = {{.rect = {-1, -1, 0, 1}, .depth = {0.75f}}, {.depth = {0.5f}}, {.depth = {0.25f}}};
    for (int round = 0; round < 2; ++round) {
        test::run(*device, [&](auto& commands) {
            const auto records = test::upload(commands, quads);
            commands.reset(queries);
            commands.begin_render({.colors = {{.texture = target}}, .depth = {.texture = depth}, .size = size});
            commands.bind_pipeline(pipeline);
            commands.bind_frame({}, records);
            for (std::uint32_t i = 0; i < 3; ++i) {
                commands.begin_query(queries, i);
                commands.draw({.vertex_count = 6, .first_instance = records.first + i});
                commands.end_query(queries, i);
            }
            commands.end_render();
        });
        std::uint64_t found[3] = {1, 1, 1};
        test::must(device->results(queries, 0, found));
        CHECK(found[0] == 64);
        CHECK(found[1] == 64);
        CHECK(found[2] == 0);
        std::uint64_t one = 7;
        test::must(device->results(queries, 1, std::span(&one, 1)));
        CHECK(one == 64);
    }
}

TEMPLATE_LIST_TEST_CASE("timestamps never run backwards", "[gpu]", test::ValidatedBackends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    if (device->info().timestamp_ns == 0) return test::skip("no timestamps on this device", "PELLUCID_REQUIRE_DEVICES");
    constexpr std::uint32_t count = 8;
    constexpr Extent2D size{64, 64};
    const auto target = test::make_target(*device, size);
    const auto pipeline = own(*device, device->make_pipeline(test::quad_desc()));
    const auto queries = own(*device, device->make_queries({.kind = QueryKind::timestamp, .count = count}));
    const test::Quad quad[] = {{}};
    std::uint64_t last = 0;
    for (int frame = 0; frame < 2; ++frame) {
        test::run(*device, [&](auto& commands) {
            const auto records = test::upload(commands, quad);
            commands.reset(queries);
            for (std::uint32_t i = 0; i < count; ++i) {
                commands.write_timestamp(queries, i);
                commands.begin_render({.colors = {{.texture = target}}, .size = size});
                test::draw(commands, pipeline, quad, records);
                commands.end_render();
            }
        });
        std::uint64_t ticks[count];
        test::must(device->results(queries, 0, ticks));
        for (const std::uint64_t tick : ticks) {
            CHECK(tick >= last);
            last = tick;
        }
        CHECK(last > 0);
    }
}
