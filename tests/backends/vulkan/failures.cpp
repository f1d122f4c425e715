// SPDX-License-Identifier: MIT
// Calls that fail: a lost device, memory that runs out, each call of a frame's making refused in turn.
#include <array>
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::own;

namespace {

/// The countdown of the failing functions below: 0 and less, all succeed.
thread_local int calls_until_failure = 0;
thread_local VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;
vulkan::DeviceTable real;

template <auto member>
struct Failing;
template <class... Arguments, VkResult (VKAPI_PTR* vulkan::DeviceTable::*member)(Arguments...)>
struct Failing<member> {
    static VkResult VKAPI_PTR call(Arguments... arguments) {
        if (calls_until_failure > 0 && --calls_until_failure == 0) return failure;
        return (real.*member)(arguments...);
    }
};

/// Lets every creating, submitting and waiting function of the device count down to its failure.
void inject(vulkan::Device& device) {
    using T = vulkan::DeviceTable;
    T& table = *device.native().table;
    real = table;
    table.AllocateMemory = Failing<&T::AllocateMemory>::call;
    table.MapMemory = Failing<&T::MapMemory>::call;
    table.CreateBuffer = Failing<&T::CreateBuffer>::call;
    table.BindBufferMemory = Failing<&T::BindBufferMemory>::call;
    table.CreateImage = Failing<&T::CreateImage>::call;
    table.BindImageMemory = Failing<&T::BindImageMemory>::call;
    table.CreateImageView = Failing<&T::CreateImageView>::call;
    table.CreateSampler = Failing<&T::CreateSampler>::call;
    table.CreateShaderModule = Failing<&T::CreateShaderModule>::call;
    table.CreateGraphicsPipelines = Failing<&T::CreateGraphicsPipelines>::call;
    table.CreateComputePipelines = Failing<&T::CreateComputePipelines>::call;
    table.CreatePipelineLayout = Failing<&T::CreatePipelineLayout>::call;
    table.CreateDescriptorSetLayout = Failing<&T::CreateDescriptorSetLayout>::call;
    table.CreateDescriptorPool = Failing<&T::CreateDescriptorPool>::call;
    table.AllocateDescriptorSets = Failing<&T::AllocateDescriptorSets>::call;
    table.CreateCommandPool = Failing<&T::CreateCommandPool>::call;
    table.AllocateCommandBuffers = Failing<&T::AllocateCommandBuffers>::call;
    table.BeginCommandBuffer = Failing<&T::BeginCommandBuffer>::call;
    table.EndCommandBuffer = Failing<&T::EndCommandBuffer>::call;
    table.CreateQueryPool = Failing<&T::CreateQueryPool>::call;
    table.QueueSubmit2 = Failing<&T::QueueSubmit2>::call;
    table.WaitForFences = Failing<&T::WaitForFences>::call;
    table.ResetFences = Failing<&T::ResetFences>::call;
    table.ResetCommandPool = Failing<&T::ResetCommandPool>::call;
}

/// Makes one of each, draws a frame with it and waits; the first error ends it.
Result<void> make_and_draw(vulkan::Device& device) {
    Unique<vulkan::Device, Buffer> buffer;
    Unique<vulkan::Device, Texture> texture, depth;
    Unique<vulkan::Device, Sampler> sampler;
    Unique<vulkan::Device, Pipeline> pipeline, compute;
    Unique<vulkan::Device, Group> group;
    Unique<vulkan::Device, Queries> queries;
    const std::array<std::uint32_t, 16> words{};
    PELLUCID_OWN(buffer, device, device.make_buffer({.size = 64, .initial = bytes_of(words), .debug_name = "faulty"}));
    PELLUCID_OWN(texture, device,
                 device.make_texture({.size = {4, 4},
                                      .usage = TextureUsage::sampled | TextureUsage::attachment,
                                      .initial = bytes_of(words),
                                      .debug_name = "faulty"}));
    PELLUCID_OWN(
        depth, device,
        device.make_texture(
            {.size = {4, 4}, .format = Format::d32_float, .usage = TextureUsage::attachment, .debug_name = "faulty"}));
    PELLUCID_OWN(sampler, device, device.make_sampler({.debug_name = "faulty"}));
    const GroupLayout layout{.bindings = {{12, BindingKind::sampled_texture}, {13, BindingKind::storage_buffer}}};
    PELLUCID_OWN(group, device,
                 device.make_group({.layout = layout,
                                    .bindings = {{.binding = 12, .texture = texture, .sampler = sampler},
                                                 {.binding = 13, .buffer = buffer}},
                                    .debug_name = "faulty"}));
    auto desc = test::quad_desc();
    desc.depth = {.format = Format::d32_float};
    desc.pass_group = layout;
    PELLUCID_OWN(pipeline, device, device.make_pipeline(desc));
    PELLUCID_OWN(compute, device,
                 device.make_pipeline(ComputePipelineDesc{
                     .compute = &shaders::test_scale_comp,
                     .pass_group = {.bindings = {{12, BindingKind::uniform_buffer}, {13, BindingKind::storage_buffer}}},
                     .push_bytes = 16}));
    PELLUCID_OWN(queries, device, device.make_queries({.kind = QueryKind::occlusion, .count = 1}));
    PELLUCID_TRY(vulkan::Commands* const commands, device.begin_frame());
    // More than the rings' first block, so that they grow.
    const auto records = commands->upload_records(40000, 64);
    const test::Quad quad;
    if (records) {
        std::memcpy(records->bytes.data(), &quad, sizeof quad);
        commands->begin_render({.colors = {{.texture = texture}}, .depth = {.texture = depth}, .size = {4, 4}});
        commands->bind_pipeline(pipeline);
        commands->bind_frame({}, *records);
        commands->draw({.vertex_count = 6, .first_instance = records->first});
        commands->end_render();
    }
    const auto ticket = device.submit();
    if (!ticket) return ticket.error();
    PELLUCID_CHECK(device.wait(*ticket));
    if (!records) return records.error();
    return {};
}

}  // namespace

TEST_CASE("a lost device says so, and its objects can still be destroyed", "[gpu]") {
    const auto device = test::make_device<Vulkan>();
    if (!device) return;
    const auto buffer = own(*device, device->make_buffer({.size = 64, .debug_name = "survivor"}));
    const auto target = test::make_target(*device, {4, 4});
    device->native().table->QueueSubmit2 = [](VkQueue, std::uint32_t, const VkSubmitInfo2*, VkFence) -> VkResult {
        return VK_ERROR_DEVICE_LOST;
    };
    (void)test::must(device->begin_frame());
    const auto submitted = device->submit();
    REQUIRE_FALSE(submitted);
    CHECK(submitted.error().code == Errc::device_lost);
    const auto begun = device->begin_frame();
    REQUIRE_FALSE(begun);
    CHECK(begun.error().code == Errc::device_lost);
    CHECK(device->submit().error().code == Errc::device_lost);
    CHECK(device->wait(Ticket{1}).error().code == Errc::device_lost);
    CHECK(device->done(Ticket{1}));  // nobody waits for ever
    device->destroy(buffer.get());
    CHECK_FALSE(device->alive(buffer.get()));
    CHECK(device->live_objects() == 1);
}

TEST_CASE("each call that may fail fails once: a typed error, nothing leaks, the next try works", "[gpu]") {
    for (const VkResult code : {VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_DEVICE_LOST}) {
        int failed = 0;
        for (int call = 1;; ++call) {
            // With validation: objects that leak are reported when the device is destroyed.
            auto device = test::make_device<Vulkan>();
            if (!device) return;
            inject(*device);
            failure = code;
            calls_until_failure = call;
            const Result<void> result = make_and_draw(*device);
            const bool reached = calls_until_failure == 0;
            calls_until_failure = 0;
            INFO("call " << call << ": " << (result ? std::string("succeeded") : result.error().message));
            CHECK(device->live_objects() == 0);
            if (!result) {
                ++failed;
                const Errc expected = code == VK_ERROR_DEVICE_LOST ? Errc::device_lost : Errc::out_of_memory;
                CHECK(name(result.error().code) == std::string(name(expected)));
            }
            // After a failed submission nothing is known about the device's state: it counts as lost.
            const auto begun = device->begin_frame();
            if (begun) {
                test::must(device->wait(test::must(device->submit())));
                test::must(make_and_draw(*device));
            } else {
                CHECK(begun.error().code == Errc::device_lost);
            }
            if (!reached) break;
        }
        CHECK(failed > 20);
    }
}
