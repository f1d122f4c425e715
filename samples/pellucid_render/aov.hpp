// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// G-buffer channels as pictures.
#include <pellucid/reference/gbuffer.hpp>
#include <pellucid/reference/srgb.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <string>

/// The channel `name` of the last frame as `[h, w, 3]` values: depth is the distance along the view axis [m], 0 where
/// nothing is; normal is the unit world-space normal; the rest are linear.
template <pellucid::rhi::Backend B>
pellucid::Result<pellucid::ImageF> read_aov(pellucid::Renderer<B>& renderer, const pellucid::Camera& camera,
                                            const std::string& name) {
    using namespace pellucid;
    const RenderSettings& s = renderer.settings();
    const bool compact = s.gbuffer == GBufferLayout::compact;
    const char* const names[] = {"depth", "normal", "base_color", "roughness", "metallic", "occlusion", "emissive"};
    if (std::find(std::begin(names), std::end(names), name) == std::end(names))
        return Error{Errc::invalid_argument,
                     "there is no AOV called '" + name +
                         "': there are depth, normal, base_color, roughness, metallic, occlusion and emissive"};
    ImageF out(s.size.width, s.size.height, 3);
    if (!renderer.needs().opaque || (name == "emissive" && !renderer.needs().emissive_target)) return out;
    rhi::Texels depth, texels;
    PELLUCID_TRY(depth, renderer.read_gbuffer(Renderer<B>::depth_index));
    auto for_each = [&](auto&& value) {
        for (std::uint32_t y = 0; y < s.size.height; ++y)
            for (std::uint32_t x = 0; x < s.size.width; ++x)
                if (depth.template at<float>(x, y) != 0) {
                    const glm::vec3 v = value(x, y);
                    std::copy_n(&v.x, 3, out.texel(x, y));
                }
    };
    if (name == "depth") {
        const ClipFromView clip = clip_from_view(camera, s.size);
        for_each([&](std::uint32_t x, std::uint32_t y) {
            const double d = depth.template at<float>(x, y);
            return glm::vec3(static_cast<float>(-(clip.zw - d * clip.ww) / (d * clip.wz - clip.zz)));
        });
        return out;
    }
    struct Half4 {
        std::uint16_t v[4];
    };
    struct Byte4 {
        std::uint8_t v[4];
    };
    const std::size_t index = name == "normal"                 ? (compact ? 0 : 1)
                              : name == "base_color"           ? (compact ? 1 : 2)
                              : name == "occlusion" && compact ? 1
                              : name == "emissive"             ? (compact ? 3 : 4)
                                                               : (compact ? 2 : 3);
    PELLUCID_TRY(texels, renderer.read_gbuffer(index));
    auto half3 = [&](std::uint32_t x, std::uint32_t y) {
        const auto h = texels.template at<Half4>(x, y);
        return glm::vec3(half_to_float(h.v[0]), half_to_float(h.v[1]), half_to_float(h.v[2]));
    };
    if (name == "emissive") {
        for_each(half3);
    } else if (name == "normal" && !compact) {
        for_each([&](std::uint32_t x, std::uint32_t y) {
            return glm::vec3(glm::dmat3(camera.world_from_view) * glm::dvec3(half3(x, y)));
        });
    } else if (name == "normal") {
        for_each([&](std::uint32_t x, std::uint32_t y) {
            const auto n = reference::direction_from_oct32<double>(texels.template at<std::uint32_t>(x, y));
            return glm::vec3(glm::dmat3(camera.world_from_view) * n);
        });
    } else if (name == "base_color") {
        for_each([&](std::uint32_t x, std::uint32_t y) {
            const auto b = texels.template at<Byte4>(x, y);
            auto linear = [&](int i) { return static_cast<float>(reference::linear_from_srgb8<double>(b.v[i])); };
            return glm::vec3(linear(0), linear(1), linear(2));
        });
    } else if (name == "occlusion" && compact) {
        for_each(
            [&](std::uint32_t x, std::uint32_t y) { return glm::vec3(texels.template at<Byte4>(x, y).v[3] / 255.0f); });
    } else if (compact) {
        for_each([&](std::uint32_t x, std::uint32_t y) {
            const auto m = texels.template at<std::uint32_t>(x, y);
            return glm::vec3(name == "roughness" ? static_cast<float>(m & 0xFFFFu) / 65535.0f
                                                 : static_cast<float>(m >> 16u & 0xFFu) / 255.0f);
        });
    } else {
        const int channel = name == "metallic" ? 0 : name == "roughness" ? 1 : 2;
        for_each([&](std::uint32_t x, std::uint32_t y) {
            return glm::vec3(texels.template at<Byte4>(x, y).v[channel] / 255.0f);
        });
    }
    return out;
}
