// SPDX-License-Identifier: MIT
// Surfaces of the wrappers and of the null backend; real windows are in tests/samples/window.cpp.
#include <pellucid/rhi/counted.hpp>
#include <pellucid/rhi/null.hpp>
#include <pellucid/rhi/surface.hpp>
#include <pellucid/rhi/validated.hpp>
#include <string>
#include <vector>
#include "support/catch.hpp"
#include "support/devices.hpp"

using namespace pellucid;

namespace {

struct Sentences {
    std::vector<std::string> said;
    LogSink sink() {
        return {[](void* user, Severity, const char* text) { static_cast<Sentences*>(user)->said.push_back(text); },
                this};
    }
};

template <class D>
rhi::Texture make_picture(D& device, rhi::TextureUsage usage, rhi::Format format = rhi::Format::rgba8_unorm) {
    return test::must(device.make_texture({.size = {4, 4}, .format = format, .usage = usage, .debug_name = "picture"}));
}

}  // namespace

TEST_CASE("every wrapper of a backend that presents presents", "[cpu]") {
    STATIC_REQUIRE(rhi::PresentingBackend<Null>);
    STATIC_REQUIRE(rhi::PresentingBackend<Counted<Null>>);
    STATIC_REQUIRE(rhi::PresentingBackend<Validated<Null>>);
    STATIC_REQUIRE(rhi::PresentingBackend<Validated<Counted<Null>>>);
}

TEST_CASE("a window without pixels shows nothing, a lost device says so", "[cpu]") {
    const auto device = test::must(Null::create({}));
    const auto surface = test::must(Null::Surface::create(*device, {.window = 1}));
    const rhi::Texture picture = make_picture(*device, rhi::TextureUsage::copy_source);
    CHECK_FALSE(test::must(surface->present(picture, {0, 4})));
    CHECK(test::must(surface->present(picture, {4, 4})));
    device->lose();
    const auto lost = surface->present(picture, {4, 4});
    REQUIRE(!lost);
    CHECK(lost.error().code == Errc::device_lost);
    CHECK(!Null::Surface::create(*device, {.window = 1}));
}

TEST_CASE("the null backend fails to make a surface when it is told to", "[cpu]") {
    const auto device = test::must(Null::create({}));
    device->fail_after(1);
    const auto none = Null::Surface::create(*device, {.window = 1, .debug_name = "main window"});
    REQUIRE(!none);
    CHECK(none.error().code == Errc::out_of_memory);
    CHECK(none.error().message.find("main window") != std::string::npos);
}

TEST_CASE("counted surfaces forward", "[cpu]") {
    using B = Counted<Null>;
    const auto device = test::must(B::create({}));
    const auto surface = test::must(B::Surface::create(*device, {.window = 1}));
    CHECK(test::must(surface->present(make_picture(*device, rhi::TextureUsage::copy_source), {4, 4})));
    CHECK(std::string(device->backend().calls().back().name) == "present");
}

TEST_CASE("what cannot be presented is a sentence", "[cpu]") {
    using B = Validated<Null>;
    Sentences log;
    const auto device = test::must(B::create({.log = log.sink()}));
    const auto surface = test::must(B::Surface::create(*device, {.window = 1}));
    const rhi::Texture good = make_picture(*device, rhi::TextureUsage::copy_source);
    CHECK(test::must(surface->present(good, {4, 4})));
    CHECK(device->violations() == 0);

    const auto refused = [&](rhi::Texture texture, const char* why) {
        log.said.clear();
        const auto shown = surface->present(texture, {4, 4});
        REQUIRE(!shown);
        REQUIRE(log.said.size() == 1);
        CHECK(log.said.front().find(why) != std::string::npos);
    };
    refused(make_picture(*device, rhi::TextureUsage::sampled), "copy_source");
    refused(make_picture(*device, rhi::TextureUsage::copy_source, rhi::Format::rgba8_srgb), "rgba8_unorm");
    refused(make_picture(*device, rhi::TextureUsage::copy_source, rhi::Format::r32_uint), "rgba8_unorm");
    refused({}, "null");
    (void)test::must(device->begin_frame());
    refused(good, "submit");
    test::must(device->wait(test::must(device->submit())));
    device->destroy(good);
    refused(good, "destroyed");
}
