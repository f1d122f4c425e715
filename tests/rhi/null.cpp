// SPDX-License-Identifier: MIT
#include <cstring>
#include <pellucid/rhi/null.hpp>
#include <pellucid/rhi/unique.hpp>
#include <string>
#include "support/catch.hpp"
#include "support/devices.hpp"

using namespace pellucid;
using test::must;

TEST_CASE("the null backend writes down what it is asked, in order", "[cpu]") {
    auto device = must(Null::create({}));
    auto* commands = must(device->begin_frame());
    commands->begin_copy({});
    const std::uint32_t value = 7;
    commands->update({}, 0, rhi::bytes_of(value));
    commands->end_copy();
    must(device->submit());
    const char* expected[] = {"begin_frame", "begin_copy", "update", "end_copy", "submit"};
    REQUIRE(device->calls().size() == 5);
    for (std::size_t i = 0; i < 5; ++i) CHECK(std::string(device->calls()[i].name) == expected[i]);
    CHECK(device->calls()[2].argument == 4);
}

TEST_CASE("the null backend counts live objects and knows stale handles", "[cpu]") {
    auto device = must(Null::create({}));
    const rhi::Texture texture = must(device->make_texture({.size = {1, 1}}));
    {
        const rhi::Unique owned(*device, must(device->make_buffer({.size = 4})));
        CHECK(device->live_objects() == 2);
        CHECK(device->alive(owned.get()));
    }
    CHECK(device->live_objects() == 1);
    device->destroy(texture);
    CHECK_FALSE(device->alive(texture));
    CHECK(device->live_objects() == 0);
}

TEST_CASE("mapped memory of the null backend holds what is written", "[cpu]") {
    auto device = must(Null::create({}));
    const std::uint32_t words[2] = {1, 2};
    const auto bytes = std::as_bytes(std::span(words));
    const auto upload = must(device->make_buffer({.size = 16, .memory = rhi::Memory::upload, .initial = bytes}));
    REQUIRE(device->mapped(upload).size() == 16);
    CHECK(std::memcmp(device->mapped(upload).data(), words, sizeof words) == 0);
    CHECK(device->mapped(must(device->make_buffer({.size = 16}))).empty());
    auto* commands = must(device->begin_frame());
    const auto first = must(commands->upload_records(3, 64));
    const auto second = must(commands->upload_records(100, 128));
    CHECK(first.bytes.size() == 192);
    std::memset(first.bytes.data(), 1, first.bytes.size());
    std::memset(second.bytes.data(), 2, second.bytes.size());
    CHECK(first.bytes[191] == std::byte{1});
}

TEST_CASE("a creation that must fail fails once, and queries return zeros", "[cpu]") {
    auto device = must(Null::create({}));
    device->fail_after(2);
    CHECK(device->make_buffer({.size = 4}));
    const auto failed = device->make_texture({.size = {4, 4}, .debug_name = "shadow map"});
    REQUIRE_FALSE(failed);
    CHECK(failed.error().code == Errc::out_of_memory);
    CHECK(failed.error().message.find("shadow map") != std::string::npos);
    CHECK(device->make_texture({.size = {4, 4}}));
    CHECK(device->live_objects() == 2);
    std::uint64_t ticks[2] = {5, 5};
    must(device->results(must(device->make_queries({.count = 2})), 0, ticks));
    CHECK(ticks[0] + ticks[1] == 0);
}

TEST_CASE("a lost null device says so and still destroys", "[cpu]") {
    auto device = must(Null::create({}));
    const auto buffer = must(device->make_buffer({.size = 4}));
    device->lose();
    CHECK(device->begin_frame().error().code == Errc::device_lost);
    CHECK(device->submit().error().code == Errc::device_lost);
    CHECK(device->wait(rhi::Ticket::none).error().code == Errc::device_lost);
    CHECK(device->make_buffer({.size = 4}).error().code == Errc::device_lost);
    device->destroy(buffer);
    CHECK(device->live_objects() == 0);
}
