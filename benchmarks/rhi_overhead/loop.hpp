// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The workload of the draw loop and what each implementation of it must do.
///
/// One frame: draw `draws` times a mesh of three vertices into a 64 x 64 RGBA8 target cleared to zero, each draw with
/// its own 64-byte matrix that differs from last frame's; copy the target to mapped memory; wait until all is done. All
/// draws but the last lie outside the clip volume, so the frame's cost is the cost of draws.  The last covers the
/// centre, and more of the target in odd frames than in even ones: a stale picture is found out.
#include <pellucid/gpu/types.h>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <pellucid/core/result.hpp>
#include <span>
#include <vector>

namespace pellucid::bench {

inline constexpr std::uint32_t target_size = 64;     ///< [texel] width and height
inline constexpr std::uint32_t record_stride = 128;  ///< [byte] of one draw's record; the matrix is its first half
inline constexpr std::uint32_t frames_in_flight = 2;

/// Column-major `clip_from_mesh`.
struct alignas(16) DrawMatrix {
    float values[16];
};
/// The frame's uniform block.
struct FrameUniforms {
    gpu::vec4 scale = {1, 1, 1, 1};
};

/// How a draw gets its matrix, and which draw it is.
enum class Variant : std::uint8_t {
    records,          ///< a record in a mapped ring, indexed by the base instance
    records_indexed,  ///< the same with an indexed draw
    push              ///< push data: push constants, or a range of a uniform ring
};
inline constexpr Variant variants[] = {Variant::records, Variant::records_indexed, Variant::push};
[[nodiscard]] constexpr const char* name(Variant variant) noexcept {
    constexpr const char* names[] = {"records", "records, indexed", "push data"};
    return names[static_cast<std::size_t>(variant)];
}

/// The matrices of even and of odd frames, made once, so that no loop pays for computing them.
class Workload {
public:
    explicit Workload(std::uint32_t draws);

    [[nodiscard]] std::span<const DrawMatrix> matrices(std::uint64_t frame) const noexcept {
        return matrices_[frame % 2];
    }
    /// Whether `rgba` ([64, 64, 4] bytes, row 0 at the top) is the picture of that frame, or an empty one where nothing
    /// was `drawn`; the error says which texel is wrong.
    [[nodiscard]] static Result<void> check(std::span<const std::byte> rgba, std::uint64_t frame, bool drawn);

private:
    std::vector<DrawMatrix> matrices_[2];
};

/// [ns] of one frame.
struct FrameTime {
    double record = 0;  ///< from before the wait for a free command list to after the end of the render pass
    double total = 0;   ///< and the copy, the submission and the wait until the GPU is done
};

/// One implementation of the frame, with everything made before the first one.
class Loop {
public:
    virtual ~Loop() = default;
    /// Makes what the loop needs current on this thread; not timed.
    virtual void enter() {}
    /// One frame, timed.
    virtual Result<FrameTime> frame(const Workload& workload, std::uint64_t number, Variant variant) = 0;
    /// What the last frame drew: [64, 64, 4] bytes.
    [[nodiscard]] virtual std::span<const std::byte> picture() = 0;
    /// Calls into the API so far; 0 where the device does not count.
    [[nodiscard]] virtual std::uint64_t api_calls() const = 0;
};

}  // namespace pellucid::bench
