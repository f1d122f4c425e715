// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What `Validated<B>` knows of the objects a program made: their descriptors and names, which handles are live, stale
/// or another device's, and where its sentences go.
#include <pellucid/core/handle.hpp>
#include <pellucid/core/log.hpp>
#include <pellucid/rhi/desc.hpp>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pellucid::inline v0_1::validated {

/// "a" + 1 + "b": the parts of a sentence, numbers in decimal.
template <class... Parts>
[[nodiscard]] std::string text(const Parts&... parts) {
    std::string out;
    auto add = [&](const auto& part) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(part)>>) {
            out += std::to_string(part);
        } else {
            out += part;
        }
    };
    (add(parts), ...);
    return out;
}

/// Sends sentences to the device's log as errors, and counts them.
struct Reporter {
    LogSink log = {};
    std::uint64_t violations = 0;

    /// Always false: `return report(…);` is a failed check.
    template <class... Parts>
    bool operator()(const Parts&... parts) {
        ++violations;
        log(Severity::error, text(parts...).c_str());
        return false;
    }
};

/// A binding that a shader reads, found in its SPIR-V.
struct ShaderBinding {
    std::uint32_t group = 0, binding = 0;
};

struct BufferInfo {
    rhi::Buffer inner = {};
    std::string name = {};
    std::uint64_t size = 0;
    rhi::BufferUsage usage = {};
    bool written = false;  ///< by the GPU since it was made: its uses then need declarations
};
struct TextureInfo {
    rhi::Texture inner = {};
    std::string name = {};
    rhi::TextureDesc desc = {};
    bool written = false;
};
struct SamplerInfo {
    rhi::Sampler inner = {};
    std::string name = {};
};
struct PipelineInfo {
    rhi::Pipeline inner = {};
    std::string name = {};
    bool compute = false;
    rhi::GroupLayout groups[3] = {};
    std::uint32_t push_bytes = 0;
    SmallVector<rhi::Format, rhi::max_color_attachments> colors = {};
    rhi::DepthStencil depth = {};
    bool reads_frame = false;    ///< a shader reads the frame's uniforms
    bool reads_records = false;  ///< a shader reads the frame's records
};
struct GroupInfo {
    rhi::Group inner = {};
    std::string name = {};
    rhi::GroupDesc desc = {};  ///< with the program's handles; its debug_name is not kept
};
struct QueriesInfo {
    rhi::Queries inner = {};
    std::string name = {};
    rhi::QueryKind kind = {};
    std::uint32_t count = 0;
};

constexpr const char* kind_of(rhi::Buffer) {
    return "buffer";
}
constexpr const char* kind_of(rhi::Texture) {
    return "texture";
}
constexpr const char* kind_of(rhi::Sampler) {
    return "sampler";
}
constexpr const char* kind_of(rhi::Pipeline) {
    return "pipeline";
}
constexpr const char* kind_of(rhi::Group) {
    return "group";
}
constexpr const char* kind_of(rhi::Queries) {
    return "pool of queries";
}

/// The live objects of one kind.  The handles it gives carry the device's tag (1 … 15) in the top four bits of their
/// index, so that a handle of another device is told from a stale one (exact up to 65,536 objects a kind).
template <class Tag, class Info>
class Table {
public:
    explicit Table(std::uint32_t tag) : tag_(tag << 16u) {}

    Handle<Tag> insert(Info info) { return {live_.insert(std::move(info)).bits ^ tag_}; }
    [[nodiscard]] Info* find(Handle<Tag> handle) {
        return handle ? live_.find(Handle<Tag>{handle.bits ^ tag_}) : nullptr;
    }
    [[nodiscard]] const Info* find(Handle<Tag> handle) const { return const_cast<Table*>(this)->find(handle); }
    /// The object, or null after a sentence that begins with `where`.
    [[nodiscard]] Info* find(Handle<Tag> handle, Reporter& report, const std::string& where) {
        if (Info* found = find(handle)) return found;
        const char* kind = kind_of(handle);
        if (!handle) {
            report(where, ": the ", kind, "'s handle is null");
        } else if (const auto dead = dead_.find(handle.bits); dead != dead_.end()) {
            report(where, ": the ", kind, " '", dead->second, "' was destroyed");
        } else {
            report(where, ": the ", kind, "'s handle ", handle.bits, " was not made by this device");
        }
        return nullptr;
    }
    Info erase(Handle<Tag> handle) {
        if (dead_.size() > 65536) dead_.clear();  // a program that runs long forgets the names of its oldest dead
        const Info* found = find(handle);
        if (found) dead_[handle.bits] = found->name;
        return live_.erase(Handle<Tag>{handle.bits ^ tag_});
    }
    /// The names of what is still live, quoted, each after a space.
    [[nodiscard]] std::string names() {
        std::string out;
        live_.for_each([&](Handle<Tag> handle, const Info& info) {
            out += text(out.empty() ? " " : ", ", kind_of(handle), " '", info.name, "'");
        });
        return out;
    }
    [[nodiscard]] std::uint32_t size() const { return live_.size(); }

private:
    std::uint32_t tag_;
    SlotMap<Tag, Info> live_;
    std::unordered_map<std::uint32_t, std::string> dead_;
};

/// Everything of one device.
struct Objects {
    explicit Objects(std::uint32_t tag)
        : buffers(tag), textures(tag), samplers(tag), pipelines(tag), groups(tag), queries(tag) {}
    Table<rhi::BufferTag, BufferInfo> buffers;
    Table<rhi::TextureTag, TextureInfo> textures;
    Table<rhi::SamplerTag, SamplerInfo> samplers;
    Table<rhi::PipelineTag, PipelineInfo> pipelines;
    Table<rhi::GroupTag, GroupInfo> groups;
    Table<rhi::QueriesTag, QueriesInfo> queries;
    Reporter report = {};

    [[nodiscard]] auto& of(rhi::Buffer) { return buffers; }
    [[nodiscard]] auto& of(rhi::Texture) { return textures; }
    [[nodiscard]] auto& of(rhi::Sampler) { return samplers; }
    [[nodiscard]] auto& of(rhi::Pipeline) { return pipelines; }
    [[nodiscard]] auto& of(rhi::Group) { return groups; }
    [[nodiscard]] auto& of(rhi::Queries) { return queries; }
    /// The object that a handle names, or null after a sentence.
    [[nodiscard]] auto* find(auto handle, const std::string& where) { return of(handle).find(handle, report, where); }
};

}  // namespace pellucid::inline v0_1::validated
