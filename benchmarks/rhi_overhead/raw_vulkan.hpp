// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The frame as a programmer would write it for Vulkan 1.3 alone.
#include <pellucid/vulkan/vulkan.hpp>
#include "rhi_overhead/loop.hpp"

namespace pellucid::bench {

/// `device` gives the VkDevice, its queue and its table of functions; everything else is the loop's own.  It must
/// outlive the loop.
Result<std::unique_ptr<Loop>> make_raw_vulkan(vulkan::Device& device);

}  // namespace pellucid::bench
