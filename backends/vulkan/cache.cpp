// SPDX-License-Identifier: MIT
// The driver's compiled pipelines in a file: an envelope {magic, size, hash} around Vulkan's own data, because drivers
// trust what they are given.
#include <unistd.h>
#include <cstdio>
#include <cstring>
#include <memory>
#include <pellucid/vulkan/context.hpp>

namespace pellucid::inline v0_1::vulkan {
namespace {

struct Envelope {
    char magic[8] = {'P', 'L', 'C', 'D', 'V', 'K', '0', '1'};
    std::uint64_t size = 0;  ///< [byte] of what follows
    std::uint64_t hash = 0;  ///< FNV-1a of what follows
};

std::uint64_t hash_of(const std::vector<char>& data) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : data) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// The file's content; `problem` says why there is none.  No file at all is no problem.
std::vector<char> read_cache(const Context& context, std::string& problem) {
    const File file(std::fopen(context.pipeline_cache_file.c_str(), "rb"));
    if (!file) return {};
    Envelope envelope;
    const Envelope expected;
    constexpr std::uint64_t most = std::uint64_t{1} << 30u;
    if (std::fread(&envelope, sizeof envelope, 1, file.get()) != 1 ||
        std::memcmp(envelope.magic, expected.magic, sizeof expected.magic) != 0 || envelope.size > most) {
        problem = "it is no pipeline cache";
        return {};
    }
    std::vector<char> data(envelope.size);
    if (std::fread(data.data(), 1, data.size(), file.get()) != data.size() || hash_of(data) != envelope.hash) {
        problem = "it is damaged";
        return {};
    }
    VkPipelineCacheHeaderVersionOne header = {};
    VkPhysicalDeviceProperties properties = {};
    context.instance->vk.GetPhysicalDeviceProperties(context.physical, &properties);
    if (data.size() >= sizeof header) std::memcpy(&header, data.data(), sizeof header);
    if (header.headerVersion != VK_PIPELINE_CACHE_HEADER_VERSION_ONE || header.vendorID != properties.vendorID ||
        header.deviceID != properties.deviceID ||
        std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) != 0) {
        problem = "it was written by another driver or device";
        return {};
    }
    return data;
}

}  // namespace

Result<void> Context::open_pipeline_cache() {
    std::vector<char> data;
    if (!pipeline_cache_file.empty()) {
        std::string problem;
        data = read_cache(*this, problem);
        if (!problem.empty())
            log(Severity::warning, ("the pipeline cache '" + pipeline_cache_file + "' is ignored: " + problem).c_str());
    }
    VkPipelineCacheCreateInfo info = {VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = data.size();
    info.pInitialData = data.data();
    if (const VkResult r = vk.CreatePipelineCache(device, &info, nullptr, &pipeline_cache))
        return fail(r, "vkCreatePipelineCache", pipeline_cache_file.c_str());
    return {};
}

void Context::save_pipeline_cache() {
    if (pipeline_cache_file.empty() || !pipelines_made || lost || !pipeline_cache) return;
    Envelope envelope;
    std::size_t size = 0;
    if (vk.GetPipelineCacheData(device, pipeline_cache, &size, nullptr) != VK_SUCCESS || size == 0) return;
    std::vector<char> data(size);
    if (vk.GetPipelineCacheData(device, pipeline_cache, &size, data.data()) != VK_SUCCESS) return;
    data.resize(size);
    envelope.size = size;
    envelope.hash = hash_of(data);
    // Another process may write the same file: each writes its own and renames it.
    const std::string partial = pipeline_cache_file + "." + std::to_string(getpid()) + ".part";
    File file(std::fopen(partial.c_str(), "wb"));
    bool written = file && std::fwrite(&envelope, sizeof envelope, 1, file.get()) == 1 &&
                   std::fwrite(data.data(), 1, data.size(), file.get()) == data.size();
    if (file) written = std::fclose(file.release()) == 0 && written;
    if (written && std::rename(partial.c_str(), pipeline_cache_file.c_str()) == 0) return;
    std::remove(partial.c_str());
    log(Severity::warning, ("the pipeline cache '" + pipeline_cache_file + "' could not be written").c_str());
}

}  // namespace pellucid::inline v0_1::vulkan
