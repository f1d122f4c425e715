// SPDX-License-Identifier: MIT
// The frame graph on the null backend: what is culled and why, what shares memory, what is made, what is recorded.
#include <pellucid/graph/graph.hpp>
#include <pellucid/rhi/null.hpp>
#include <string>
#include "support/allocations.hpp"
#include "support/catch.hpp"

using namespace pellucid;

namespace {
/// A graph that writes down what is created and recorded.
struct Fixture {
    null::Device device;
    Graph<Null> graph;
    std::vector<std::string> created, recorded;

    GraphTexture texture(const char* name, Extent2D size = {64, 32}, rhi::Format format = rhi::Format::rgba16_float) {
        return graph.texture({.size = size, .format = format, .debug_name = name});
    }
    void pass(const char* name, SmallVector<GraphTexture, 8> reads, SmallVector<GraphTexture, 8> writes) {
        graph.add(
            {.name = name, .reads = reads, .writes = writes},
            [this, name](null::Device&) -> Result<void> {
                created.push_back(name);
                return {};
            },
            [this, name](null::Commands&) { recorded.push_back(name); });
    }
    void execute() {
        recorded.clear();
        Frame<Null> frame(device);
        REQUIRE(frame.open());
        REQUIRE(graph.execute(frame, [](const char*, auto&& record) { record(); }));
    }
    std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const TextureReport& t : graph.textures()) sum += t.bytes;
        return sum;
    }
    const PassReport& report(const std::string& name) const {
        for (const PassReport& p : graph.passes())
            if (p.name == name) return p;
        FAIL("no report of " << name);
        return graph.passes().front();
    }
};
using Names = std::vector<std::string>;
constexpr std::uint64_t one = 64 * 32 * 8;  // bytes of one texture
}  // namespace

TEST_CASE("passes run in the order they were added; only what is kept, or leads to it, runs", "[cpu]") {
    Fixture f;
    const GraphTexture a = f.texture("a"), b = f.texture("b"), c = f.texture("c"), unused = f.texture("unused");
    f.pass("make a", {}, {a});
    f.pass("nobody's", {a}, {c});
    f.pass("leads to nobody's", {}, {unused});
    f.pass("make b", {a}, {b});
    f.graph.leave_out("shadows", "no light casts any");
    f.graph.keep(b);
    REQUIRE(f.graph.compile(f.device));
    CHECK(f.created == Names{"make a", "make b"});
    f.execute();
    CHECK(f.recorded == Names{"make a", "make b"});
    f.execute();
    CHECK(f.recorded == Names{"make a", "make b"});
    CHECK(f.created.size() == 2);  // once
    CHECK(f.report("make a").ran);
    CHECK(f.report("make a").reason.empty());
    CHECK_FALSE(f.report("nobody's").ran);
    CHECK(f.report("nobody's").reason == "nothing reads what it writes");
    CHECK_FALSE(f.report("shadows").ran);
    CHECK(f.report("shadows").reason == "no light casts any");
    CHECK(f.device.live_objects() == 2);  // a and b
    CHECK(f.graph[a]);
    CHECK_FALSE(f.graph[c]);
}

TEST_CASE("a chain that leads nowhere is culled from its end to its beginning", "[cpu]") {
    Fixture f;
    const GraphTexture a = f.texture("a"), b = f.texture("b"), c = f.texture("c");
    f.pass("1", {}, {a});
    f.pass("2", {a}, {b});
    f.pass("3", {b}, {c});
    REQUIRE(f.graph.compile(f.device));
    CHECK(f.created.empty());
    CHECK(f.device.live_objects() == 0);
    for (const PassReport& p : f.graph.passes()) CHECK_FALSE(p.ran);
}

TEST_CASE("a pass whose result is overwritten unread does not run; one that is read before does", "[cpu]") {
    Fixture f;
    const GraphTexture a = f.texture("a"), b = f.texture("b");
    f.pass("overwritten", {}, {a});
    f.pass("overwrites", {}, {a});
    f.pass("blends over it", {a}, {a});
    f.pass("reads", {a}, {b});
    f.graph.keep(b);
    REQUIRE(f.graph.compile(f.device));
    CHECK(f.created == Names{"overwrites", "blends over it", "reads"});
}

TEST_CASE("textures whose lifetimes do not overlap share memory, others never", "[cpu]") {
    Fixture f;
    const GraphTexture a = f.texture("a"), b = f.texture("b"), c = f.texture("c"), d = f.texture("d");
    f.pass("1", {}, {a});
    f.pass("2", {a}, {b});
    f.pass("3", {b}, {c});  // a is free from here on
    f.pass("4", {c}, {d});  // and b
    f.graph.keep(d);
    REQUIRE(f.graph.compile(f.device));
    CHECK(f.graph[a] != f.graph[b]);
    CHECK(f.graph[b] != f.graph[c]);
    CHECK(f.graph[c] != f.graph[d]);
    CHECK(f.graph[a] == f.graph[c]);
    CHECK(f.graph[b] == f.graph[d]);
    CHECK(f.device.live_objects() == 2);
    CHECK(f.bytes() == 2 * one);
    std::size_t shared = 0;
    for (const TextureReport& t : f.graph.textures()) shared += t.shared;
    CHECK(shared == 2);
}

TEST_CASE("a kept texture keeps its memory to the end of the frame", "[cpu]") {
    Fixture f;
    const GraphTexture a = f.texture("a"), b = f.texture("b"), c = f.texture("c");
    f.pass("1", {}, {a});
    f.pass("2", {a}, {b});
    f.pass("3", {b}, {c});
    f.graph.keep(a);
    f.graph.keep(c);
    REQUIRE(f.graph.compile(f.device));
    CHECK(f.graph[a] != f.graph[c]);
    CHECK(f.device.live_objects() == 3);
}

TEST_CASE("only textures that are alike in everything share", "[cpu]") {
    const rhi::TextureDesc like{.size = {64, 32}, .format = rhi::Format::rgba16_float, .debug_name = "like"};
    rhi::TextureDesc others[6] = {like, like, like, like, like, like};
    others[0].size = {32, 64};
    others[1].format = rhi::Format::rgba8_unorm;
    others[2].usage = rhi::TextureUsage::attachment;
    others[3].mips = 2;
    others[4].layers = 2;
    others[5].kind = rhi::TextureKind::array;
    for (const rhi::TextureDesc& other : others) {
        Fixture f;
        const GraphTexture a = f.graph.texture(like), b = f.texture("b", {8, 8}), c = f.graph.texture(other);
        f.pass("1", {}, {a});
        f.pass("2", {a}, {b});
        f.pass("3", {b}, {c});
        f.graph.keep(c);
        REQUIRE(f.graph.compile(f.device));
        CHECK(f.graph[a] != f.graph[c]);
    }
}

TEST_CASE("the error of a pass's creation comes out, and nothing after it is created", "[cpu]") {
    Fixture f;
    const GraphTexture a = f.texture("a"), b = f.texture("b");
    f.pass("first", {}, {a});
    f.graph.add(
        {.name = "fails", .reads = {a}, .writes = {b}},
        [](null::Device&) -> Result<void> {
            return Error{Errc::unsupported, "fails: this device has no triangles"};
        },
        [](null::Commands&) {});
    f.pass("later", {b}, {b});
    f.graph.keep(b);
    const auto compiled = f.graph.compile(f.device);
    REQUIRE_FALSE(compiled);
    CHECK(compiled.error().code == Errc::unsupported);
    CHECK(compiled.error().message == "fails: this device has no triangles");
    CHECK(f.created == Names{"first"});
}

TEST_CASE("wherever a texture cannot be made, the graph leaves nothing behind", "[cpu]") {
    for (std::uint64_t n = 1; n <= 3; ++n) {
        null::Device device;
        {
            Graph<Null> graph;
            const auto a = graph.texture({.size = {4, 4}, .debug_name = "a"}), b = graph.texture({.size = {5, 4}}),
                       c = graph.texture({.size = {6, 4}});
            graph.add(
                {.writes = {a, b, c}}, [](null::Device&) -> Result<void> { return {}; }, [](null::Commands&) {});
            graph.keep(b);
            device.fail_after(n);
            const auto compiled = graph.compile(device);
            REQUIRE_FALSE(compiled);
            CHECK(compiled.error().code == Errc::out_of_memory);
        }
        CHECK(device.live_objects() == 0);
    }
}

TEST_CASE("executing a compiled graph allocates nothing", "[cpu]") {
    null::Device device;
    Graph<Null> graph;
    const GraphTexture a = graph.texture({.size = {4, 4}}), b = graph.texture({.size = {4, 4}});
    int recorded = 0;
    for (int i = 0; i < 8; ++i)
        graph.add(
            {.name = "pass", .reads = {a}, .writes = {i % 2 ? a : b, a}},
            [](null::Device&) -> Result<void> { return {}; }, [&](null::Commands&) { ++recorded; });
    graph.keep(a);
    REQUIRE(graph.compile(device));
    Frame<Null> frame(device);
    REQUIRE(frame.open());
    const std::uint64_t before = test::allocations();
    bool done = true;
    for (int i = 0; i < 10; ++i) done = graph.execute(frame, [](const char*, auto&& record) { record(); }) && done;
    CHECK(test::allocations() == before);
    CHECK(done);
    CHECK(recorded == 80);
}

TEST_CASE("texture_bytes counts every level and layer", "[cpu]") {
    CHECK(texture_bytes({.size = {5, 3}}) == 60);
    CHECK(texture_bytes({.size = {4, 4}, .mips = 3}) == 4 * (16 + 4 + 1));
    CHECK(texture_bytes({.size = {8, 1}, .layers = 6, .mips = 4, .format = rhi::Format::rgba16_float}) == 8 * 6 * 15);
    CHECK(texture_bytes({.size = {65536, 65536}, .format = rhi::Format::rgba32_float}) == 1ull << 36u);
}
