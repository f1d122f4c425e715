// SPDX-License-Identifier: MIT
#include <pellucid/vulkan/device.hpp>

namespace pellucid::inline v0_1::vulkan {

Result<rhi::Queries> Device::make_queries(const rhi::QueriesDesc& desc) {
    Context& c = context_;
    if (desc.count == 0)
        return Error{Errc::invalid_argument,
                     std::string("queries '") + desc.debug_name + "': their count is 0; give at least 1"};
    if (desc.kind == rhi::QueryKind::timestamp && c.timestamp_bits == 0)
        return Error{Errc::unsupported, std::string("queries '") + desc.debug_name + "': the device '" +
                                            c.device_info.name + "' has no timestamps"};
    VkQueryPoolCreateInfo info = {VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = desc.kind == rhi::QueryKind::timestamp ? VK_QUERY_TYPE_TIMESTAMP : VK_QUERY_TYPE_OCCLUSION;
    info.queryCount = desc.count;
    QueriesObject object = {VK_NULL_HANDLE, desc.count, desc.kind};
    if (const VkResult r = c.vk.CreateQueryPool(c.device, &info, nullptr, &object.handle))
        return c.fail(r, "vkCreateQueryPool", desc.debug_name);
    c.set_name(VK_OBJECT_TYPE_QUERY_POOL, object.handle, desc.debug_name);
    c.vk.ResetQueryPool(c.device, object.handle, 0, desc.count);
    return c.queries.insert(object);
}

Result<void> Device::results(rhi::Queries queries, std::uint32_t first, std::span<std::uint64_t> out) {
    Context& c = context_;
    if (c.lost) return c.lost_error();
    const QueriesObject* object = c.queries.find(queries);
    if (!object) return Error{Errc::invalid_argument, "results: the queries were destroyed or never made"};
    if (first + out.size() > object->count)
        return Error{Errc::invalid_argument, "results: queries " + std::to_string(first) + " to " +
                                                 std::to_string(first + out.size()) + " of a pool of " +
                                                 std::to_string(object->count)};
    if (out.empty()) return {};
    const VkResult r =
        c.vk.GetQueryPoolResults(c.device, object->handle, first, static_cast<std::uint32_t>(out.size()),
                                 out.size_bytes(), out.data(), sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT);
    if (r == VK_NOT_READY)
        return Error{
            Errc::invalid_argument,
            "results: some of the queries were not written, or their work is not done; wait for its ticket first"};
    if (r != VK_SUCCESS) return c.fail(r, "vkGetQueryPoolResults", "queries");
    if (object->kind == rhi::QueryKind::timestamp && c.timestamp_bits < 64)
        for (std::uint64_t& value : out) value &= (std::uint64_t{1} << c.timestamp_bits) - 1;
    return {};
}

void Device::destroy(rhi::Queries queries) {
    if (alive(queries)) context_.retire(VK_OBJECT_TYPE_QUERY_POOL, context_.queries.erase(queries).handle);
}

void Commands::reset(rhi::Queries queries) {
    const QueriesObject& object = context_.queries[queries];
    vk_.CmdResetQueryPool(commands_, object.handle, 0, object.count);
}

void Commands::write_timestamp(rhi::Queries queries, std::uint32_t index) {
    vk_.CmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, context_.queries[queries].handle, index);
}

void Commands::begin_query(rhi::Queries queries, std::uint32_t index) {
    vk_.CmdBeginQuery(commands_, context_.queries[queries].handle, index, VK_QUERY_CONTROL_PRECISE_BIT);
}

void Commands::end_query(rhi::Queries queries, std::uint32_t index) {
    vk_.CmdEndQuery(commands_, context_.queries[queries].handle, index);
}

}  // namespace pellucid::inline v0_1::vulkan
