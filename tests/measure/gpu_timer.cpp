// SPDX-License-Identifier: MIT
#include <cstring>
#include <map>
#include <pellucid/measure/gpu_timer.hpp>
#include <string>
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;

namespace {

/// A device that only knows time: its clock is `now`, and a frame is done once `finished` has reached its ticket.
struct ClockCommands;
struct ClockDevice {
    rhi::DeviceInfo device_info{.timestamp_ns = 500};
    std::map<std::uint32_t, std::vector<std::uint64_t>> pools;  ///< by handle
    std::uint32_t made = 0, destroyed = 0, resets = 0, fail_after = ~0u;
    std::uint64_t now = 0, submitted = 0, finished = 0;
    bool lost = false;

    Result<rhi::Queries> make_queries(const rhi::QueriesDesc& desc) {
        if (made == fail_after) return Error{Errc::out_of_memory, desc.debug_name};
        pools[++made].resize(desc.count);
        return rhi::Queries{made};
    }
    Result<void> results(rhi::Queries queries, std::uint32_t first, std::span<std::uint64_t> out) {
        if (lost) return Error{Errc::device_lost, "lost"};
        std::copy_n(pools.at(queries.bits).begin() + first, out.size(), out.begin());
        return {};
    }
    void destroy(rhi::Queries) { ++destroyed; }
    bool alive(rhi::Queries queries) const { return pools.count(queries.bits) != 0; }
    bool done(rhi::Ticket ticket) { return static_cast<std::uint64_t>(ticket) <= finished; }
    Result<rhi::Ticket> submit() { return rhi::Ticket{++submitted}; }
    const rhi::DeviceInfo& info() const { return device_info; }

    // The rest of what a device is; a timer uses none of it.
    Result<rhi::Buffer> make_buffer(const rhi::BufferDesc&) { return rhi::Buffer{}; }
    std::span<std::byte> mapped(rhi::Buffer) { return {}; }
    Result<rhi::Texture> make_texture(const rhi::TextureDesc&) { return rhi::Texture{}; }
    Result<rhi::Sampler> make_sampler(const rhi::SamplerDesc&) { return rhi::Sampler{}; }
    Result<rhi::Pipeline> make_pipeline(const rhi::GraphicsPipelineDesc&) { return rhi::Pipeline{}; }
    Result<rhi::Pipeline> make_pipeline(const rhi::ComputePipelineDesc&) { return rhi::Pipeline{}; }
    Result<rhi::Group> make_group(const rhi::GroupDesc&) { return rhi::Group{}; }
    template <class Tag>
    void destroy(Handle<Tag>) {}
    template <class Tag>
    bool alive(Handle<Tag>) const {
        return false;
    }
    Result<ClockCommands*> begin_frame();
    Result<void> wait(rhi::Ticket) { return {}; }
    std::uint64_t api_calls() const { return 0; }
    std::uint32_t live_objects() const { return made - destroyed; }
};

/// A timestamp is the device's clock when it is recorded.
struct ClockCommands {
    ClockDevice& device;
    void reset(rhi::Queries queries) {
        ++device.resets;
        std::fill(device.pools.at(queries.bits).begin(), device.pools.at(queries.bits).end(), 0);
    }
    void write_timestamp(rhi::Queries queries, std::uint32_t index) {
        device.pools.at(queries.bits).at(index) = device.now;
    }
    void begin_query(rhi::Queries, std::uint32_t) {}
    void end_query(rhi::Queries, std::uint32_t) {}
    void begin_render(const rhi::RenderPassDesc&) {}
    void end_render() {}
    void begin_compute(const rhi::ComputePassDesc&) {}
    void end_compute() {}
    void begin_copy(const rhi::CopyPassDesc&) {}
    void end_copy() {}
    void bind_pipeline(rhi::Pipeline) {}
    void bind_group(rhi::Group) {}
    void bind_frame(rhi::UniformSlice, const rhi::RecordSlice&) {}
    void bind_index_buffer(rhi::Buffer) {}
    void push(std::span<const std::byte>) {}
    void set_scissor(rhi::Rect) {}
    void set_stencil_reference(std::uint8_t) {}
    void draw(const rhi::Draw&) {}
    void draw_indexed(const rhi::DrawIndexed&) {}
    void draw_indexed_indirect(rhi::Buffer, std::uint64_t, std::uint32_t) {}
    void dispatch(std::uint32_t, std::uint32_t, std::uint32_t) {}
    void dispatch_indirect(rhi::Buffer, std::uint64_t) {}
    void copy(rhi::Buffer, rhi::Buffer, rhi::BufferCopy) {}
    void copy(rhi::Texture, rhi::Buffer, rhi::TextureCopy) {}
    void copy(rhi::Buffer, rhi::Texture, rhi::TextureCopy) {}
    void update(rhi::Buffer, std::uint64_t, std::span<const std::byte>) {}
    void fill(rhi::Buffer, std::uint64_t, std::uint64_t, std::uint32_t) {}
    void generate_mips(rhi::Texture) {}
    Result<rhi::UniformSlice> upload_uniforms(std::span<const std::byte>) { return rhi::UniformSlice{}; }
    Result<rhi::RecordSlice> upload_records(std::uint32_t, std::uint32_t) { return rhi::RecordSlice{}; }
};
Result<ClockCommands*> ClockDevice::begin_frame() {
    return Error{Errc::unsupported, "the clock has no frames"};
}

struct Clock {
    static constexpr const char* name = "clock";
    using Device = ClockDevice;
    using Commands = ClockCommands;
    static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc&) { return std::make_unique<Device>(); }
    static std::vector<rhi::DeviceInfo> list() { return {}; }
};
static_assert(rhi::Backend<Clock>);

/// One frame with a scope "a" of `ticks`.
void frame(GpuTimer<Clock>& timer, ClockDevice& device, std::uint64_t ticks) {
    ClockCommands commands{device};
    timer.begin_frame(commands);
    {
        const auto scope = timer.scope(commands, "a");
        device.now += ticks;
    }
    timer.end_frame(*device.submit());
}

}  // namespace

TEST_CASE("scopes come back in order with their times in milliseconds", "[cpu]") {
    ClockDevice device;
    ClockCommands commands{device};
    Result<GpuTimer<Clock>> made = GpuTimer<Clock>::create(device);
    REQUIRE(made);
    GpuTimer<Clock>& timer = *made;
    CHECK(timer.available());
    timer.begin_frame(commands);
    {
        const auto outer = timer.scope(commands, "outer");
        device.now += 100;
        {
            const auto inner = timer.scope(commands, "inner");
            device.now += 2000;
        }
    }
    timer.end_frame(*device.submit());
    CHECK((*timer.collect()).empty());  // not finished yet
    device.finished = 1;
    const std::span<const GpuSpan> spans = *timer.collect();
    REQUIRE(spans.size() == 2);
    CHECK(std::strcmp(spans[0].name, "outer") == 0);
    CHECK(spans[0].ms == Approx(2100 * 500e-6).epsilon(1e-12));
    CHECK(std::strcmp(spans[1].name, "inner") == 0);
    CHECK(spans[1].ms == Approx(1.0).epsilon(1e-12));
    CHECK((*timer.collect()).empty());  // only once
}

TEST_CASE("frames come back oldest first, and one that nobody collects is counted", "[cpu]") {
    ClockDevice device;
    GpuTimer<Clock> timer = *GpuTimer<Clock>::create(device, {.frames_in_flight = 2, .max_scopes = 4});
    frame(timer, device, 1000);
    frame(timer, device, 2000);
    frame(timer, device, 3000);
    device.finished = 2;
    CHECK((*timer.collect())[0].ms == Approx(0.5));
    CHECK((*timer.collect())[0].ms == Approx(1.0));
    CHECK((*timer.collect()).empty());
    CHECK(timer.dropped_frames() == 0);
    device.finished = 9;
    frame(timer, device, 4000);
    frame(timer, device, 5000);
    frame(timer, device, 6000);  // the ring holds three: the frame of 3000 ticks is gone
    CHECK(timer.dropped_frames() == 1);
    CHECK((*timer.collect())[0].ms == Approx(2.0));
    CHECK(device.resets == 6);
}

TEST_CASE("scopes beyond the limit and times that run backward are counted, not reported", "[cpu]") {
    ClockDevice device{.now = 1000};
    ClockCommands commands{device};
    GpuTimer<Clock> timer = *GpuTimer<Clock>::create(device, {.max_scopes = 2});
    timer.begin_frame(commands);
    const std::uint32_t a = timer.begin(commands, "a");
    device.now -= 10;
    timer.end(commands, a);
    timer.end(commands, timer.begin(commands, "b"));
    timer.end(commands, timer.begin(commands, "c"));
    timer.end_frame(*device.submit());
    CHECK(timer.dropped_scopes() == 1);
    device.finished = 1;
    const std::span<const GpuSpan> spans = *timer.collect();
    REQUIRE(spans.size() == 1);
    CHECK(std::string(spans[0].name) == "b");
    CHECK(timer.dropped_scopes() == 2);
}

TEST_CASE("without timestamps nothing is made and nothing comes back", "[cpu]") {
    ClockDevice device{.device_info = {.timestamp_ns = 0}};
    GpuTimer<Clock> timer = *GpuTimer<Clock>::create(device);
    CHECK_FALSE(timer.available());
    frame(timer, device, 1000);
    device.finished = 1;
    CHECK((*timer.collect()).empty());
    CHECK(device.made == 0);
    CHECK(device.resets == 0);
}

TEST_CASE("errors pass through, and the pools are destroyed", "[cpu]") {
    ClockDevice device;
    CHECK(GpuTimer<Clock>::create(device, {.max_scopes = 0}).error().code == Errc::invalid_argument);
    device.fail_after = 2;
    CHECK(GpuTimer<Clock>::create(device).error().code == Errc::out_of_memory);
    CHECK(device.live_objects() == 0);
    device.fail_after = ~0u;
    {
        GpuTimer<Clock> timer = *GpuTimer<Clock>::create(device);
        CHECK(device.live_objects() == 3);
        GpuTimer<Clock> moved = std::move(timer);
        frame(moved, device, 7);
        device.finished = device.submitted;
        device.lost = true;
        CHECK(moved.collect().error().code == Errc::device_lost);
    }
    CHECK(device.live_objects() == 0);
}

TEST_CASE("the spans live in the same storage in every frame", "[cpu]") {
    ClockDevice device;
    GpuTimer<Clock> timer = *GpuTimer<Clock>::create(device);
    const GpuSpan* first = nullptr;
    for (int i = 0; i < 20; ++i) {
        frame(timer, device, 10);
        device.finished = device.submitted;
        const std::span<const GpuSpan> spans = *timer.collect();
        REQUIRE(spans.size() == 1);
        if (!first) first = spans.data();
        REQUIRE(spans.data() == first);  // the same storage every frame
    }
}
