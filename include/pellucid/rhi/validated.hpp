// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// `Validated<B>`: a backend that wraps another one and finds misuse.  Each broken rule becomes one sentence with the
/// debug names of what is concerned, sent to `DeviceDesc::log` as an error and counted by `Device::violations()`; the
/// call is then not forwarded, so the wrapped backend only ever sees calls that keep the rules.
///
/// Found: null, stale and foreign handles; nested passes and work outside them; missing pipelines, groups, frame data,
/// push data and index buffers; layouts, formats and attachments that do not fit; resources that a bound group reads
/// and the pass does not declare, or attaches at the same time; ranges out of bounds; missing usages; empty work;
/// queries out of order; textures that cannot be shown; double destruction; objects still alive when the device goes.
///
/// Costs a few hash look-ups and comparisons a call: for development and tests.
#include <pellucid/rhi/validated/surface.hpp>

namespace pellucid::inline v0_1 {

/// The backend `B` with every call checked; the file's comment says what is found.
template <rhi::Backend B>
struct Validated {
    static constexpr const char* name = B::name;
    using Device = validated::Device<B>;
    using Commands = validated::Commands<B>;
    using Surface = validated::Surface<B>;

    static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc& desc) {
        PELLUCID_TRY(auto inner, B::create(desc));
        return std::make_unique<Device>(std::move(inner), desc.log);
    }
    static std::vector<rhi::DeviceInfo> list() { return B::list(); }
};

}  // namespace pellucid::inline v0_1
