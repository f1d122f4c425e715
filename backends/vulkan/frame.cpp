// SPDX-License-Identifier: MIT
// Frames in flight, submission, waiting, and the destruction of what the GPU may still use.
#include <algorithm>
#include <limits>
#include <pellucid/vulkan/device.hpp>

namespace pellucid::inline v0_1::vulkan {

Result<void> Context::init_frames(std::uint32_t count) {
    const VkFenceCreateInfo info = {VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    for (VkFence& fence : fences) {
        if (const VkResult r = vk.CreateFence(device, &info, nullptr, &fence))
            return fail(r, "vkCreateFence", "ticket");
        set_name(VK_OBJECT_TYPE_FENCE, fence, "ticket");
    }
    frame_count = count;
    for (std::uint32_t i = 0; i < count; ++i) {
        Frame& f = frames[i];
        VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
        pool.queueFamilyIndex = family;
        if (const VkResult r = vk.CreateCommandPool(device, &pool, nullptr, &f.pool))
            return fail(r, "vkCreateCommandPool", "frame");
        VkCommandBufferAllocateInfo buffer = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        buffer.commandPool = f.pool;
        buffer.commandBufferCount = 1;
        if (const VkResult r = vk.AllocateCommandBuffers(device, &buffer, &f.commands))
            return fail(r, "vkAllocateCommandBuffers", "frame");
        set_name(VK_OBJECT_TYPE_COMMAND_BUFFER, f.commands, "frame commands");
        // The padding keeps the fixed range of the dynamic uniform buffer inside the block at every offset.
        PELLUCID_CHECK(f.uniforms.init(*this, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, uniform_slice_bytes,
                                       std::numeric_limits<std::uint32_t>::max(), "uniform ring"));
        PELLUCID_CHECK(
            f.records.init(*this, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, 0, limits.maxStorageBufferRange, "record ring"));
        PELLUCID_CHECK(f.staging.init(*this, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, 0,
                                      std::numeric_limits<std::uint64_t>::max(), "staging ring"));
        PELLUCID_TRY([[maybe_unused]] const VkDescriptorSet set, frame_set_of(f, 0, 0));
    }
    return {};
}

void Context::destroy_frames() {
    for (Frame& f : frames) {
        f.uniforms.destroy(*this);
        f.records.destroy(*this);
        f.staging.destroy(*this);
        if (f.pool) vk.DestroyCommandPool(device, f.pool, nullptr);
    }
    for (VkFence fence : fences)
        if (fence) vk.DestroyFence(device, fence, nullptr);
}

Result<void> Context::wait(std::uint64_t ticket) {
    if (lost) return lost_error();
    if (ticket <= completed) return {};
    if (ticket > submitted)
        return Error{Errc::invalid_argument, "wait: ticket " + std::to_string(ticket) +
                                                 " was never given out; the last is " + std::to_string(submitted)};
    const VkFence fence = fences[ticket % fence_count];
    if (const VkResult r = vk.WaitForFences(device, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max()))
        return fail(r, "vkWaitForFences", "ticket");
    // A fence covers everything submitted before it.
    completed = std::max(completed, ticket);
    return {};
}

void Context::poll() {
    while (completed < submitted) {
        const VkResult r = vk.GetFenceStatus(device, fences[(completed + 1) % fence_count]);
        if (r == VK_ERROR_DEVICE_LOST) lost = true;
        if (r != VK_SUCCESS) return;
        ++completed;
    }
}

void Context::retire(Garbage item) {
    // What is being recorded may use it: its ticket comes with the next submission.
    item.ticket = recording || upload.recording ? 0 : submitted;
    if (item.ticket == submitted && item.ticket <= completed && !recording && !upload.recording) {
        destroy_now(item);
        return;
    }
    garbage.push_back(item);
}

void Context::collect() {
    std::size_t kept = 0;
    for (const Garbage& item : garbage) {
        if (item.ticket != 0 && item.ticket <= completed) {
            destroy_now(item);
        } else {
            garbage[kept++] = item;
        }
    }
    garbage.resize(kept);
}

void Context::destroy_now(const Garbage& item) {
    const auto as = [&]<class H>(H) {
        return std::bit_cast<H>(
            static_cast<std::conditional_t<sizeof(H) == 8, std::uint64_t, std::uint32_t>>(item.handle));
    };
    switch (item.type) {
        case VK_OBJECT_TYPE_BUFFER:
            vk.DestroyBuffer(device, as(VkBuffer{}), nullptr);
            break;
        case VK_OBJECT_TYPE_IMAGE:
            vk.DestroyImage(device, as(VkImage{}), nullptr);
            break;
        case VK_OBJECT_TYPE_IMAGE_VIEW:
            vk.DestroyImageView(device, as(VkImageView{}), nullptr);
            break;
        case VK_OBJECT_TYPE_SAMPLER:
            vk.DestroySampler(device, as(VkSampler{}), nullptr);
            break;
        case VK_OBJECT_TYPE_PIPELINE:
            vk.DestroyPipeline(device, as(VkPipeline{}), nullptr);
            break;
        case VK_OBJECT_TYPE_QUERY_POOL:
            vk.DestroyQueryPool(device, as(VkQueryPool{}), nullptr);
            break;
        case VK_OBJECT_TYPE_DESCRIPTOR_SET: {
            SetLayout::Pool& pool = set_layouts[item.set.layout].pools[item.set.pool];
            vk.FreeDescriptorSets(device, pool.handle, 1, &item.set.handle);
            ++pool.free;
            break;
        }
        default:
            break;
    }
    memory.free(item.memory);
}

Result<std::uint64_t> Context::submit(VkCommandBuffer frame_commands, VkSemaphore before, VkSemaphore after) {
    // The tracked layouts and the upload's state are those after commands that would never run: once a step of this
    // fails, nothing of the device can be trusted.
    const auto broken = [this](VkResult result, const char* what) {
        lost = true;
        return fail(result, what, "submission");
    };
    VkCommandBufferSubmitInfo batch[2] = {};
    std::uint32_t count = 0;
    const auto add = [&](VkCommandBuffer commands) {
        batch[count].sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
        batch[count++].commandBuffer = commands;
    };
    if (upload.recording) {
        Upload::Piece& piece = upload.pieces[upload.current];
        if (const VkResult r = vk.EndCommandBuffer(piece.commands)) return broken(r, "vkEndCommandBuffer");
        add(piece.commands);
    }
    if (frame_commands) {
        if (const VkResult r = vk.EndCommandBuffer(frame_commands)) return broken(r, "vkEndCommandBuffer");
        add(frame_commands);
    }
    const VkFence fence = fences[(submitted + 1) % fence_count];
    if (submitted >= fence_count) {
        if (auto waited = wait(submitted + 1 - fence_count); !waited) {
            lost = true;
            return waited.error();
        }
    }
    if (const VkResult r = vk.ResetFences(device, 1, &fence)) return broken(r, "vkResetFences");
    VkSubmitInfo2 info = {VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.commandBufferInfoCount = count;
    info.pCommandBufferInfos = batch;
    VkSemaphoreSubmitInfo semaphores[2] = {};
    const auto use = [&](VkSemaphoreSubmitInfo& out, VkSemaphore semaphore, VkPipelineStageFlags2 stages) {
        out = {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
        out.semaphore = semaphore;
        out.stageMask = stages;
        return semaphore ? 1u : 0u;
    };
    info.waitSemaphoreInfoCount = use(semaphores[0], before, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
    info.pWaitSemaphoreInfos = &semaphores[0];
    info.signalSemaphoreInfoCount = use(semaphores[1], after, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    info.pSignalSemaphoreInfos = &semaphores[1];
    if (const VkResult r = vk.QueueSubmit2(queue, 1, &info, fence)) return broken(r, "vkQueueSubmit2");
    ++submitted;
    if (upload.recording) {
        upload.pieces[upload.current].ticket = submitted;
        upload.recording = false;
        upload.current ^= 1u;
        upload.used = 0;
    }
    // An upload on its own, in the midst of a frame, does not end the use of what the frame has recorded.
    if (frame_commands || !recording)
        for (Garbage& item : garbage)
            if (item.ticket == 0) item.ticket = submitted;
    return submitted;
}

Result<Commands*> Device::begin_frame() {
    Context& c = context_;
    if (c.lost) return c.lost_error();
    if (c.recording) return Error{Errc::invalid_argument, "begin_frame: the frame before was not submitted"};
    Frame& frame = c.frame();
    PELLUCID_CHECK(c.wait(frame.ticket));
    if (!c.garbage.empty()) {
        c.poll();
        c.collect();
    }
    if (const VkResult r = c.vk.ResetCommandPool(c.device, frame.pool, 0))
        return c.fail(r, "vkResetCommandPool", "frame");
    frame.uniforms.rewind();
    frame.records.rewind();
    frame.staging.rewind();
    VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (const VkResult r = c.vk.BeginCommandBuffer(frame.commands, &begin))
        return c.fail(r, "vkBeginCommandBuffer", "frame");
    c.recording = true;
    commands_.start(frame.commands);
    return &commands_;
}

Result<rhi::Ticket> Device::submit() {
    Context& c = context_;
    if (c.lost) return c.lost_error();
    if (!c.recording) return Error{Errc::invalid_argument, "submit: no frame was begun"};
    commands_.host_barrier();
    Frame& frame = c.frame();
    const Result<std::uint64_t> ticket = c.submit(frame.commands);
    c.recording = false;
    if (!ticket) return ticket.error();
    frame.ticket = *ticket;
    c.frame_index = (c.frame_index + 1) % c.frame_count;
    // What could be recorded has been submitted, so the state is sound; the caller learns what was left out.
    if (commands_.failed_) return commands_.error_;
    return rhi::Ticket{*ticket};
}

Result<void> Device::wait(rhi::Ticket ticket) {
    PELLUCID_CHECK(context_.wait(static_cast<std::uint64_t>(ticket)));
    context_.collect();
    return {};
}

bool Device::done(rhi::Ticket ticket) {
    const auto value = static_cast<std::uint64_t>(ticket);
    if (value <= context_.completed || context_.lost) return true;
    context_.poll();
    return value <= context_.completed || context_.lost;
}

}  // namespace pellucid::inline v0_1::vulkan
