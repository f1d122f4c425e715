// SPDX-License-Identifier: MIT
// The sub-allocator's arithmetic, with a device that only counts. [cpu]
#include <bit>
#include <map>
#include <pellucid/vulkan/memory.hpp>
#include <random>
#include "support/catch.hpp"

using namespace pellucid;
using vulkan::Allocation;
using vulkan::SubAllocator;

namespace {

constexpr VkDeviceSize mib = VkDeviceSize{1} << 20u;

/// A device whose memory is numbers: at most `budget` bytes at a time.
struct FakeDevice {
    VkDeviceSize budget = 1024 * mib;
    VkDeviceSize held = 0;
    std::uint64_t next = 1;
    std::map<VkDeviceMemory, VkDeviceSize> live;
    std::vector<std::uint32_t> types;  ///< of each allocation
    std::vector<bool> dedicated;       ///< likewise
    std::vector<std::byte> space = std::vector<std::byte>(1);

    vulkan::MemoryApi api() {
        return {this,
                [](void* user, const VkMemoryAllocateInfo& info, VkDeviceMemory* memory, void** mapped) {
                    auto& device = *static_cast<FakeDevice*>(user);
                    if (device.held + info.allocationSize > device.budget) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
                    *memory = std::bit_cast<VkDeviceMemory>(device.next++);
                    device.live[*memory] = info.allocationSize;
                    device.held += info.allocationSize;
                    device.types.push_back(info.memoryTypeIndex);
                    device.dedicated.push_back(info.pNext != nullptr);
                    if (mapped) *mapped = device.space.data();
                    return VK_SUCCESS;
                },
                [](void* user, VkDeviceMemory memory) {
                    auto& device = *static_cast<FakeDevice*>(user);
                    device.held -= device.live.at(memory);
                    device.live.erase(memory);
                }};
    }
};

constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

VkPhysicalDeviceMemoryProperties types(std::initializer_list<VkMemoryPropertyFlags> list) {
    VkPhysicalDeviceMemoryProperties properties = {};
    for (const VkMemoryPropertyFlags flags : list)
        properties.memoryTypes[properties.memoryTypeCount++] = {flags, flags & local ? 0u : 1u};
    properties.memoryHeapCount = 2;
    properties.memoryHeaps[0] = {512 * mib, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
    properties.memoryHeaps[1] = {512 * mib, 0};
    return properties;
}
/// A card with a window for the CPU: local, host, host cached, local and host.
const VkPhysicalDeviceMemoryProperties card = types({local, host, host | cached, local | host});

vulkan::MemoryRequest request(VkDeviceSize size, VkDeviceSize alignment = 256, rhi::Memory use = rhi::Memory::device) {
    vulkan::MemoryRequest out;
    out.requirements = {size, alignment, 0xF};
    out.use = use;
    out.debug_name = "thing";
    return out;
}
Allocation must(Result<Allocation> made) {
    REQUIRE(made);
    return *made;
}

}  // namespace

TEST_CASE("each use gets the memory type that suits it", "[cpu]") {
    FakeDevice device;
    const SubAllocator a(card, 1, device.api());
    CHECK(a.candidates(0xF, rhi::Memory::device) == std::vector<std::uint32_t>{0, 3});
    CHECK(a.candidates(0xF, rhi::Memory::upload) == std::vector<std::uint32_t>{1, 2, 3});
    CHECK(a.candidates(0xF, rhi::Memory::readback) == std::vector<std::uint32_t>{2, 1, 3});
    CHECK(a.candidates(0x1, rhi::Memory::upload).empty());
    // One type for all, as software drivers have it.
    const SubAllocator b(types({local | host | cached}), 1, device.api());
    for (const auto use : {rhi::Memory::device, rhi::Memory::upload, rhi::Memory::readback})
        CHECK(b.candidates(1, use) == std::vector<std::uint32_t>{0});
    // Not coherent: never chosen for the CPU, so nothing needs flushing.
    const SubAllocator c(types({local, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | cached, host}), 1, device.api());
    CHECK(c.candidates(0x7, rhi::Memory::readback) == std::vector<std::uint32_t>{2});
}

TEST_CASE("small objects share a block, aligned; large ones get their own", "[cpu]") {
    FakeDevice device;
    SubAllocator a(card, 1, device.api());
    const Allocation first = must(a.allocate(request(100)));
    const Allocation second = must(a.allocate(request(100, 4096)));
    CHECK(first.memory == second.memory);
    CHECK(first.offset == 0);
    CHECK(second.offset == 4096);
    CHECK(first.mapped == nullptr);
    CHECK(a.block_count() == 1);
    CHECK(a.held_bytes() == 64 * mib);
    CHECK(a.used_bytes() == 200);
    // The gap that the alignment left is used.
    CHECK(must(a.allocate(request(1000))).offset == 256);
    const Allocation large = must(a.allocate(request(33 * mib)));
    CHECK(large.memory != first.memory);
    CHECK(a.held_bytes() == 97 * mib);
    a.free(large);
    CHECK(a.held_bytes() == 64 * mib);
    vulkan::MemoryRequest wants_own = request(100);
    const VkMemoryDedicatedAllocateInfo own = {VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
    wants_own.dedicated = &own;
    const Allocation alone = must(a.allocate(wants_own));
    CHECK(alone.memory != first.memory);
    CHECK(device.live.at(alone.memory) == 100);
    CHECK(device.dedicated.back());
    a.free(alone);
    a.release_all();
    CHECK(device.live.empty());
}

TEST_CASE("memory for the CPU is mapped at its own offset", "[cpu]") {
    FakeDevice device;
    SubAllocator a(card, 1, device.api());
    const Allocation first = must(a.allocate(request(512, 256, rhi::Memory::upload)));
    const Allocation second = must(a.allocate(request(512, 256, rhi::Memory::upload)));
    CHECK(first.mapped == device.space.data());
    CHECK(second.mapped == device.space.data() + 512);
    CHECK(device.types == std::vector<std::uint32_t>{1});
}

TEST_CASE("buffers and images share a block only where the granularity allows it", "[cpu]") {
    FakeDevice device;
    vulkan::MemoryRequest image = request(100);
    image.linear = false;
    SubAllocator fine(card, 1, device.api());
    CHECK(must(fine.allocate(request(100))).memory == must(fine.allocate(image)).memory);
    SubAllocator coarse(card, 1024, device.api());
    CHECK(must(coarse.allocate(request(100))).memory != must(coarse.allocate(image)).memory);
}

TEST_CASE("out of memory: the next type is tried, then a smaller block, then it is said what there was", "[cpu]") {
    FakeDevice device;
    device.budget = 100 * mib;
    SubAllocator a(card, 1, device.api());
    (void)must(a.allocate(request(32 * mib)));
    (void)must(a.allocate(request(20 * mib)));
    // 36 MiB are left: no further block of 64, but one of the object's size.
    const Allocation third = must(a.allocate(request(30 * mib)));
    CHECK(device.live.at(third.memory) == 30 * mib);
    const auto fourth = a.allocate(request(31 * mib));
    REQUIRE_FALSE(fourth);
    CHECK(fourth.error().code == Errc::out_of_memory);
    for (const char* part : {"'thing'", "31 MiB were asked for", "82 MiB in use", "2 blocks of 94 MiB", "512 MiB"}) {
        INFO(fourth.error().message);
        CHECK(fourth.error().message.find(part) != std::string::npos);
    }
    a.free(third);
    CHECK(a.allocate(request(31 * mib)));
    vulkan::MemoryRequest nowhere = request(16);
    nowhere.requirements.memoryTypeBits = 0;
    CHECK(a.allocate(nowhere).error().code == Errc::unsupported);
}

TEST_CASE("random traffic: nothing overlaps, everything comes back", "[cpu]") {
    FakeDevice device;
    device.budget = ~VkDeviceSize{0};
    SubAllocator a(card, 64, device.api(), 4096);
    std::mt19937 random(7);
    std::vector<Allocation> live;
    VkDeviceSize used = 0;
    for (int step = 0; step < 20000; ++step) {
        if (live.empty() || random() % 5 < 3) {
            const VkDeviceSize alignment = VkDeviceSize{1} << random() % 9;
            const Allocation made = must(a.allocate(request(1 + random() % 700, alignment)));
            REQUIRE(made.offset % alignment == 0);
            REQUIRE(made.offset + made.size <= device.live.at(made.memory));
            if (step % 16 == 0)
                for (const Allocation& other : live)
                    REQUIRE((other.memory != made.memory || other.offset + other.size <= made.offset ||
                             made.offset + made.size <= other.offset));
            used += made.size;
            live.push_back(made);
        } else {
            std::swap(live[random() % live.size()], live.back());
            used -= live.back().size;
            a.free(live.back());
            live.pop_back();
        }
        REQUIRE(a.used_bytes() == used);
    }
    for (const Allocation& allocation : live) a.free(allocation);
    CHECK(a.used_bytes() == 0);
    CHECK(a.block_count() == 1);  // one empty block is kept
    CHECK(must(a.allocate(request(2048))).offset == 0);
}
