// SPDX-License-Identifier: MIT
// The user interface drawn through the RHI: what its lists say, and nothing else.
#include <pellucid/rhi/null.hpp>
#include "support/imgui_pass.hpp"
#include "support/catch.hpp"
#include "support/gpu.hpp"
#include "support/imgui_frames.hpp"

namespace pellucid::test {
namespace {

using samples::ImGuiPass;

constexpr std::uint32_t side = 128;
constexpr std::uint32_t grey = 0x404040FF;

/// A pass, and a target that every frame clears to grey first.
template <rhi::Backend B>
struct Canvas {
    TestDevice<B> device = make_device<B>();
    UiContext ui{side, side};
    rhi::Unique<typename B::Device, rhi::Texture> target;
    std::optional<ImGuiPass<B>> pass;

    explicit operator bool() const { return static_cast<bool>(device); }
    Canvas() {
        if (!device) return;
        target = make_target(*device, {side, side});
        pass = must(ImGuiPass<B>::create(*device, ui.fonts()));
    }
    /// What `fill(list)` draws over grey.
    template <class F>
    Image8 draw(F&& fill) {
        return draw_data(ui.frame(fill));
    }
    Image8 draw_data(const ImDrawData& data) {
        run(*device, [&](auto& commands) {
            constexpr float level = 0x40 / 255.0f;
            commands.begin_render({.colors = {{.texture = target, .clear = {level, level, level, 1}}},
                                   .size = {side, side},
                                   .name = "clear"});
            commands.end_render();
            must(pass->record(commands, data, target, {side, side}));
        });
        return read<std::uint8_t>(*device, target, {side, side}, 4);
    }
};

struct Box {
    int left, top, right, bottom;
    [[nodiscard]] bool holds(std::uint32_t x, std::uint32_t y) const {
        return static_cast<int>(x) >= left && static_cast<int>(x) < right && static_cast<int>(y) >= top &&
               static_cast<int>(y) < bottom;
    }
};

/// Pixels that are not `inside` in the box or `outside` out of it.
unsigned wrong_pixels(const Image8& picture, const Box& box, std::uint32_t inside, std::uint32_t outside = grey) {
    unsigned wrong = 0;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) wrong += rgba(picture, x, y) != (box.holds(x, y) ? inside : outside);
    return wrong;
}
void fill_box(ImDrawList& list, const Box& b, ImU32 color) {
    list.AddRectFilled({static_cast<float>(b.left), static_cast<float>(b.top)},
                       {static_cast<float>(b.right), static_cast<float>(b.bottom)}, color);
}
/// Largest difference of two pictures, in codes.
int difference(const Image8& a, const Image8& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) largest = std::max(largest, std::abs(a.data[i] - b.data[i]));
    return largest;
}
Image8 grey_picture() {
    Image8 out(side, side, 4);
    for (std::size_t i = 0; i < out.data.size(); ++i) out.data[i] = i % 4 == 3 ? 0xFF : 0x40;
    return out;
}

TEMPLATE_LIST_TEST_CASE("a rectangle of the user interface covers its pixels and no others", "[gpu]",
                        ValidatedBackends) {
    Canvas<TestType> canvas;
    if (!canvas) return;
    const Box box{10, 20, 97, 53};
    const Image8 picture = canvas.draw([&](ImDrawList& list) { fill_box(list, box, IM_COL32(250, 130, 7, 255)); });
    CHECK(wrong_pixels(picture, box, 0xFA8207FF) == 0);
    SECTION("one that goes beyond the display ends at its edge") {
        const Image8 whole = canvas.draw([&](ImDrawList& list) {
            fill_box(list, {-500, -3, 900, 9}, IM_COL32(1, 2, 3, 255));
        });
        CHECK(wrong_pixels(whole, {0, 0, side, 9}, 0x010203FF) == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("clip rectangles end what is drawn, also those beyond the target", "[gpu]", ValidatedBackends) {
    Canvas<TestType> canvas;
    if (!canvas) return;
    const auto clipped = [&](ImVec2 low, ImVec2 high) {
        return canvas.draw([&](ImDrawList& list) {
            list.PushClipRect(low, high);
            fill_box(list, {0, 0, side, side}, IM_COL32(255, 0, 0, 255));
            list.PopClipRect();
        });
    };
    CHECK(wrong_pixels(clipped({30, 40}, {70, 41}), {30, 40, 70, 41}, 0xFF0000FF) == 0);
    CHECK(wrong_pixels(clipped({-50, 100}, {20, 5000}), {0, 100, 20, side}, 0xFF0000FF) == 0);
    CHECK(wrong_pixels(clipped({300, 300}, {400, 400}), {}, 0) == 0);
    CHECK(wrong_pixels(clipped({-90, -90}, {-10, -10}), {}, 0) == 0);
    CHECK(wrong_pixels(clipped({50, 50}, {50, 90}), {}, 0) == 0);
}

TEMPLATE_LIST_TEST_CASE("the user interface is blended as codes", "[gpu]", ValidatedBackends) {
    Canvas<TestType> canvas;
    if (!canvas) return;
    for (const int alpha : {0, 1, 64, 128, 254}) {
        const Image8 picture = canvas.draw([&](ImDrawList& list) {
            fill_box(list, {0, 0, side, side}, IM_COL32(255, 100, 0, alpha));
        });
        const double a = alpha / 255.0;
        const double expected[] = {255 * a + 0x40 * (1 - a), 100 * a + 0x40 * (1 - a), 0x40 * (1 - a), 255};
        INFO("alpha " << alpha);
        for (std::size_t c = 0; c < 4; ++c) CHECK(std::abs(picture.texel(64, 64)[c] - expected[c]) <= 1);
    }
}

TEMPLATE_LIST_TEST_CASE("text, triangles and translucent shapes are what a rasteriser makes of the same lists", "[gpu]",
                        Backends) {
    Canvas<TestType> canvas;
    if (!canvas) return;
    Image8 expected = grey_picture();
    const auto fill = [](ImDrawList& list) {
        fill_box(list, {4, 4, 120, 60}, IM_COL32(20, 30, 60, 200));
        list.AddText({8, 8}, IM_COL32_WHITE, "Pellucid 0.1");
        list.AddText({11, 30}, IM_COL32(255, 200, 0, 180), "12.5 ms\n(a, b) = 7%");
        // No pixel's centre is on an edge: the fill rule has a test of its own among those of the RHI.
        list.AddTriangleFilled({20.2f, 70.3f}, {110.7f, 80.1f}, {60.4f, 120.6f}, IM_COL32(0, 255, 0, 128));
        list.AddRectFilledMultiColor({90, 90}, {120, 120}, IM_COL32(255, 0, 0, 255), IM_COL32(0, 255, 0, 255),
                                     IM_COL32(0, 0, 255, 255), IM_COL32(255, 255, 255, 0));
    };
    const ImDrawData& data = canvas.ui.frame(fill);
    rasterise(canvas.ui, data, expected);
    const Image8 picture = canvas.draw_data(data);
    CHECK(difference(picture, expected) <= 2);  // up to three layers, each rounded to a code
    // The rasteriser itself saw letters.
    unsigned white = 0;
    for (std::uint32_t y = 8; y < 24; ++y)
        for (std::uint32_t x = 8; x < 100; ++x) white += rgba(expected, x, y) == 0xFFFFFFFF;
    CHECK(white > 100);
}

TEMPLATE_LIST_TEST_CASE("lists with more vertices than an index of 16 bits can name are drawn to their end", "[gpu]",
                        ValidatedBackends) {
    Canvas<TestType> canvas;
    if (!canvas) return;
    const auto many = [&](int count) {
        return canvas.draw([&](ImDrawList& list) {
            for (int i = 0; i + 1 < count; ++i) fill_box(list, {0, 0, 2, 2}, IM_COL32(9, 9, 9, 255));
            fill_box(list, {0, 0, 50, 50}, IM_COL32(7, 6, 5, 255));
        });
    };
    // Buffers grow between frames, and a small frame follows a large one.
    for (const int count : {1, 3000, 20000, 70000, 2}) {
        INFO(count << " rectangles");
        CHECK(wrong_pixels(many(count), {0, 0, 50, 50}, 0x070605FF) == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("nothing to draw records nothing", "[gpu]", ValidatedBackends) {
    Canvas<TestType> canvas;
    if (!canvas) return;
    const std::uint32_t objects = canvas.device->live_objects();
    CHECK(wrong_pixels(canvas.draw([](ImDrawList&) {}), {}, 0) == 0);
    const ImDrawData none;
    CHECK(wrong_pixels(canvas.draw_data(none), {}, 0) == 0);
    ImDrawData flat = canvas.ui.frame([](ImDrawList& list) { fill_box(list, {0, 0, 9, 9}, IM_COL32_WHITE); });
    flat.DisplaySize = {0, 0};
    CHECK(wrong_pixels(canvas.draw_data(flat), {}, 0) == 0);
    CHECK(canvas.device->live_objects() == objects);
}

TEMPLATE_LIST_TEST_CASE("textures of the caller are drawn while they are known", "[gpu]", ValidatedBackends) {
    Canvas<TestType> canvas;
    if (!canvas) return;
    const std::uint32_t texels[] = {0xFF0000FF, 0xFF00FF00, 0xFFFF0000, 0xFFFFFFFF};  // red, green / blue, white
    const auto texture = own(
        *canvas.device, canvas.device->make_texture({.size = {2, 2},
                                                     .initial = rhi::bytes_of(std::span<const std::uint32_t>(texels)),
                                                     .debug_name = "four texels"}));
    const ImTextureID id = must(canvas.pass->add(texture.get(), rhi::Filter::nearest));
    const auto show = [&](ImDrawList& list) { list.AddImage(id, {32, 32}, {96, 96}); };
    const Image8 picture = canvas.draw(show);
    CHECK(rgba(picture, 32, 32) == 0xFF0000FF);
    CHECK(rgba(picture, 63, 63) == 0xFF0000FF);
    CHECK(rgba(picture, 64, 63) == 0x00FF00FF);
    CHECK(rgba(picture, 63, 64) == 0x0000FFFF);
    CHECK(rgba(picture, 95, 95) == 0xFFFFFFFF);
    CHECK(rgba(picture, 96, 95) == grey);
    canvas.pass->remove(id);
    const ImDrawData& data = canvas.ui.frame(show);
    run(*canvas.device, [&](auto& commands) {
        const Result<void> refused = canvas.pass->record(commands, data, canvas.target, {side, side});
        REQUIRE(!refused);
        CHECK(refused.error().code == Errc::invalid_argument);
        CHECK(refused.error().message.find("never added or is removed") != std::string::npos);
    });
    for (std::size_t i = 1; i < ImGuiPass<TestType>::max_textures; ++i) (void)must(canvas.pass->add(texture.get()));
    CHECK(!canvas.pass->add(texture.get()));
}

TEST_CASE("a frame that cannot have its buffers says so and leaves the next one well", "[cpu]") {
    UiContext ui(side, side);
    const std::unique_ptr<Null::Device> device = must(Null::create({}));
    ImGuiPass<Null> pass = must(ImGuiPass<Null>::create(*device, ui.fonts()));
    const rhi::Texture target = must(device->make_texture({.size = {side, side}}));
    const ImDrawData& data = ui.frame([](ImDrawList& list) { fill_box(list, {0, 0, 9, 9}, IM_COL32_WHITE); });
    null::Commands& commands = *must(device->begin_frame());
    for (const std::uint64_t n : {1u, 2u, 3u}) {  // vertices, indices, group
        device->fail_after(n);
        const Result<void> failed = pass.record(commands, data, target, {side, side});
        INFO("creation " << n);
        CHECK(!failed);
        device->fail_after(0);
        CHECK(pass.record(commands, data, target, {side, side}));
        pass = must(ImGuiPass<Null>::create(*device, ui.fonts()));
    }
}

}  // namespace
}  // namespace pellucid::test
