// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Textures of a G-buffer and of a lit picture, and what a G-buffer's texels mean.
#include <pellucid/core/half.hpp>
#include <pellucid/passes/gbuffer.hpp>
#include <pellucid/reference/gbuffer.hpp>
#include <pellucid/renderer/scene_convert.hpp>
#include <pellucid/rhi/readback.hpp>
#include <vector>

namespace pellucid::bench {

/// One target of `size`, of every usage that the passes ask for.
template <rhi::Backend B>
[[nodiscard]] Result<rhi::Unique<rhi::DeviceFor<B>, rhi::Texture>> make_target(rhi::DeviceFor<B>& device, Extent2D size,
                                                                               rhi::Format format,
                                                                               const char* debug_name) {
    using enum rhi::TextureUsage;
    rhi::TextureUsage usage = attachment | sampled | copy_source;
    if (format == rhi::Format::rgba16_float) usage |= storage;
    rhi::Unique<rhi::DeviceFor<B>, rhi::Texture> out;
    PELLUCID_OWN(out, device,
                 device.make_texture({.size = size, .format = format, .usage = usage, .debug_name = debug_name}));
    return out;
}

/// A G-buffer without a target for emitted radiance, and its texels on the CPU.
template <rhi::Backend B>
struct GBufferSet {
    GBufferLayout layout = GBufferLayout::compact;
    GBufferTargets targets = {};
    std::vector<rhi::Unique<rhi::DeviceFor<B>, rhi::Texture>> owned = {};
    std::vector<rhi::Texels> texels = {};  ///< in the order of gbuffer_formats, depth last; after `read`
    double bytes_per_pixel = 0;            ///< with depth

    [[nodiscard]] static Result<GBufferSet> create(rhi::DeviceFor<B>& device, GBufferLayout layout, Extent2D size) {
        GBufferSet out;
        out.layout = layout;
        out.targets.size = size;
        auto formats = gbuffer_formats(layout, false);
        formats.push_back(rhi::Format::d32_float);
        for (const rhi::Format format : formats) {
            PELLUCID_TRY(auto texture, make_target<B>(device, size, format, "gbuffer"));
            if (format == rhi::Format::d32_float)
                out.targets.depth = texture;
            else
                out.targets.colors.push_back(texture);
            out.bytes_per_pixel += rhi::info(format).bytes;
            out.owned.push_back(std::move(texture));
        }
        return out;
    }
    [[nodiscard]] Result<void> read(rhi::DeviceFor<B>& device) {
        texels.clear();
        auto formats = gbuffer_formats(layout, false);
        formats.push_back(rhi::Format::d32_float);
        for (std::size_t i = 0; i < formats.size(); ++i) {
            PELLUCID_TRY(rhi::Texels read,
                         rhi::download<B>(device, owned[i], {.size = targets.size, .format = formats[i]}));
            texels.push_back(std::move(read));
        }
        return {};
    }
};

/// A pixel as it is stored, in double, in view space.
struct StoredPixel {
    bool covered = false;
    reference::Surface<double> surface = {};
    glm::dvec3 position{0, 0, 0};  ///< [m] view space
};

/// Precondition: `set.read()` was called; `camera` is the one that the G-buffer was drawn with.
template <rhi::Backend B>
[[nodiscard]] StoredPixel stored_pixel(const GBufferSet<B>& set, const Camera& camera, std::uint32_t x,
                                       std::uint32_t y) {
    StoredPixel out;
    const auto depth = set.texels.back().template at<float>(x, y);
    out.covered = depth != 0;
    if (!out.covered) return out;
    if (set.layout == GBufferLayout::compact) {
        out.surface = reference::unpack_surface<double>({.normal = set.texels[0].template at<std::uint32_t>(x, y),
                                                         .color = set.texels[1].template at<std::uint32_t>(x, y),
                                                         .material = set.texels[2].template at<std::uint32_t>(x, y),
                                                         .depth = depth});
        const reference::ClipCoefficients<double> clip(clip_from_view(camera, set.targets.size));
        out.position = reference::view_from_depth(clip, reference::ndc_from_pixel<double>(x, y, set.targets.size),
                                                  static_cast<double>(depth));
        return out;
    }
    struct Float4 {
        float v[4];
    };
    struct Half4 {
        std::uint16_t v[4];
    };
    struct Byte4 {
        std::uint8_t v[4];
    };
    const auto world = set.texels[0].template at<Float4>(x, y);
    const auto normal = set.texels[1].template at<Half4>(x, y);
    const auto base = set.texels[2].template at<Byte4>(x, y);
    const auto material = set.texels[3].template at<Byte4>(x, y);
    out.position =
        glm::dvec3(rigid_inverse(camera.world_from_view) * glm::dvec4(world.v[0], world.v[1], world.v[2], 1));
    out.surface.normal =
        glm::normalize(glm::dvec3(half_to_float(normal.v[0]), half_to_float(normal.v[1]), half_to_float(normal.v[2])));
    for (int i = 0; i < 3; ++i) out.surface.base_color[i] = reference::linear_from_srgb8(base.v[i]);
    out.surface.metallic = material.v[0] / 255.0;
    out.surface.roughness = material.v[1] / 255.0;
    out.surface.occlusion = material.v[2] / 255.0;
    return out;
}

/// The stored 8-bit code of a channel of the base colour.
template <rhi::Backend B>
[[nodiscard]] int base_code(const GBufferSet<B>& set, std::uint32_t x, std::uint32_t y, int channel) {
    const auto code = set.texels[set.layout == GBufferLayout::compact ? 1 : 2].template at<std::uint32_t>(x, y);
    return static_cast<int>(code >> (8 * channel) & 0xFFu);
}

/// `[h, w, 4]` of an rgba16_float target.
template <rhi::Backend B>
[[nodiscard]] Result<ImageF> read_hdr(rhi::DeviceFor<B>& device, rhi::Texture texture, Extent2D size) {
    PELLUCID_TRY(const rhi::Texels texels,
                 rhi::download<B>(device, texture, {.size = size, .format = rhi::Format::rgba16_float}));
    ImageF out(size.width, size.height, 4);
    for (std::size_t i = 0; i < out.data.size(); ++i) {
        std::uint16_t half = 0;
        std::memcpy(&half, texels.bytes.data() + 2 * i, 2);
        out.data[i] = half_to_float(half);
    }
    return out;
}

}  // namespace pellucid::bench
