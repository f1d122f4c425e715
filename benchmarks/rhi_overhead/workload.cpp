// SPDX-License-Identifier: MIT
#include <cstdio>
#include "rhi_overhead/loop.hpp"

namespace pellucid::bench {
namespace {

/// Places the mesh (0,0) (1,0) (0,1), scaled by `size`, with its lower left corner at (x, y) in clip space.
DrawMatrix place(float size, float x, float y) {
    return {{size, 0, 0, 0, 0, size, 0, 0, 0, 0, 1, 0, x, y, 0.5f, 1}};
}

}  // namespace

Workload::Workload(std::uint32_t draws) {
    for (std::uint32_t odd = 0; odd < 2; ++odd) {
        matrices_[odd].reserve(draws);
        for (std::uint32_t i = 0; i + 1 < draws; ++i)
            matrices_[odd].push_back(place(0.5f, 2.0f + 0.01f * static_cast<float>(i % 100), odd ? -0.5f : 0.5f));
        // The large one leaves out the upper right corner of the target.
        const float size = odd ? 4.0f : 0.5f;
        matrices_[odd].push_back(place(size, -size / 3, -size / 3));
    }
}

Result<void> Workload::check(std::span<const std::byte> rgba, std::uint64_t frame, bool drawn) {
    struct Probe {
        std::uint32_t x, y;
        bool covered;
    };
    const Probe probes[] = {{32, 32, true}, {2, 61, frame % 2 == 1}, {62, 1, false}};
    constexpr std::uint8_t color[4] = {51, 102, 153, 255};
    for (const Probe& probe : probes)
        for (std::uint32_t c = 0; c < 4; ++c) {
            const std::size_t at = (std::size_t{probe.y} * target_size + probe.x) * 4 + c;
            const unsigned expected = drawn && probe.covered ? color[c] : 0;
            const unsigned found = at < rgba.size() ? std::to_integer<unsigned>(rgba[at]) : 256u;
            if (found == expected) continue;
            char text[160];
            std::snprintf(text, sizeof text,
                          "wrong picture in frame %llu: texel (%u, %u) channel %u is %u instead of %u",
                          static_cast<unsigned long long>(frame), probe.x, probe.y, c, found, expected);
            return Error{Errc::internal, text};
        }
    return {};
}

}  // namespace pellucid::bench
