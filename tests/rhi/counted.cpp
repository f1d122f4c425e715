// SPDX-License-Identifier: MIT
#include <pellucid/rhi/counted.hpp>
#include <pellucid/rhi/null.hpp>
#include <pellucid/rhi/validated.hpp>
#include "support/catch.hpp"
#include "support/devices.hpp"

using namespace pellucid;
using namespace pellucid::rhi;

static_assert(Backend<Counted<Null>>);
static_assert(Backend<Counted<Validated<Null>>>);

TEST_CASE("calls of a frame are counted by kind, with the bytes sent, and all reach the backend", "[cpu]") {
    auto device = test::must(Counted<Null>::create({}));
    const auto buffer = test::must(device->make_buffer({.size = 64}));
    auto frame = [&](int draws) {
        auto* commands = test::must(device->begin_frame());
        (void)test::must(commands->upload_records(10, 64));
        (void)test::must(commands->upload_uniforms(bytes_of(1.0)));
        commands->begin_copy({});
        commands->update(buffer, 0, bytes_of(1));
        commands->end_copy();
        commands->begin_render({});
        commands->bind_pipeline({});
        commands->bind_frame({}, {});
        commands->bind_group({});
        commands->push(std::vector<std::byte>(32));
        for (int i = 0; i < draws; ++i) commands->draw({.vertex_count = 3});
        commands->draw_indexed_indirect(buffer, 0, 5);
        commands->end_render();
        test::must(device->wait(test::must(device->submit())));
    };
    frame(7);
    counted::Counts expected{
        .passes = 2, .pipelines = 1, .groups = 2, .pushes = 1, .draws = 12, .copies = 1, .uploads = 2};
    expected.bytes = 640 + 8 + 4 + 32;
    CHECK(device->last_frame() == expected);
    CHECK(device->last_frame().calls() == 21);
    const std::size_t seen = device->backend().calls().size();
    frame(0);  // counts start again
    CHECK(device->last_frame().draws == 5);
    CHECK(device->backend().calls().size() == seen + seen - 1 - 7);  // one less: the buffer was made once
    CHECK(device->last_frame().creations == 0);
}

TEST_CASE("creations inside a frame are counted", "[cpu]") {
    auto device = test::must(Counted<Null>::create({}));
    (void)test::must(device->begin_frame());
    const auto sampler = test::must(device->make_sampler({}));
    CHECK(device->alive(sampler));
    test::must(device->wait(test::must(device->submit())));
    CHECK(device->last_frame().creations == 1);
    CHECK(device->live_objects() == 1);
    CHECK(device->api_calls() == 0);
}
