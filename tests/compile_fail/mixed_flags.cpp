// SPDX-License-Identifier: MIT
// A buffer's usage is no texture's.
// expect: error: no match for .operator\|.*BufferUsage.*TextureUsage
#include <pellucid/rhi/desc.hpp>

auto mixed = pellucid::rhi::BufferUsage::storage | pellucid::rhi::TextureUsage::storage;
