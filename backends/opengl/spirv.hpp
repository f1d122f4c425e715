// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The specialisation constants that a SPIR-V module declares.
#include <cstdint>
#include <pellucid/rhi/shader.hpp>
#include <span>
#include <vector>

namespace pellucid::inline v0_1::opengl {

/// Ids with their default values, in the module's order.  32-bit scalars only; a broken module gives fewer.
[[nodiscard]] std::vector<rhi::SpecConstant> declared_constants(std::span<const std::uint32_t> spirv);

/// `declared` with the values that `given` has for the same ids; given ids that are not declared are left out.
[[nodiscard]] std::vector<rhi::SpecConstant> merged_constants(std::vector<rhi::SpecConstant> declared,
                                                              std::span<const rhi::SpecConstant> given);

}  // namespace pellucid::inline v0_1::opengl
