// SPDX-License-Identifier: MIT
// A result that nobody looks at.
// expect: error: ignoring returned value of type .*Result<.*BufferTag.*nodiscard
#include <pellucid/rhi/null.hpp>

void leave(pellucid::null::Device& device) {
    device.make_buffer({.size = 4});
}
