// SPDX-License-Identifier: MIT
// A draw costs one call into the API, as in a loop written by hand; everything else of a frame is a small constant.
#include <pellucid/rhi/counted.hpp>
#include "support/gpu.hpp"

using namespace pellucid;

TEMPLATE_LIST_TEST_CASE("draw_calls: one API call a draw, with data of its own each", "[gpu]", test::Backends) {
    using B = Counted<TestType>;
    const auto device = test::make_device<B>([](rhi::DeviceDesc& desc) {
        desc.validation = false;
        desc.count_api_calls = true;
    });
    if (!device) return;
    constexpr Extent2D size{16, 16};
    const auto target = test::make_target(*device, size);
    const auto pipeline = test::own(*device, device->make_pipeline(test::quad_desc()));
    // API calls from begin_frame to submit, both included; waiting is apart.
    auto calls_of = [&](std::size_t draws) {
        const std::vector<test::Quad> quads(draws);
        const std::uint64_t before = device->api_calls();
        auto* commands = test::must(device->begin_frame());
        const auto records = test::upload(*commands, std::span<const test::Quad>(quads));
        commands->begin_render({.colors = {{.texture = target}}, .size = size, .name = "draws"});
        test::draw(*commands, pipeline, std::span<const test::Quad>(quads), records);
        commands->end_render();
        const rhi::Ticket ticket = test::must(device->submit());
        const std::uint64_t calls = device->api_calls() - before;
        test::must(device->wait(ticket));
        return calls;
    };
    for (int warm = 0; warm < 4; ++warm) (void)calls_of(2000);
    const std::uint64_t thousand = calls_of(1000), two_thousand = calls_of(2000);
    CHECK(two_thousand - thousand == 1000);
    INFO(TestType::name << ": " << thousand - 1000 << " calls besides the draws");
    CHECK(thousand - 1000 <= 24);  // by hand: 11 (OpenGL) and 14 (Vulkan), without labels
}
