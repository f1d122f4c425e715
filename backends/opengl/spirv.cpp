// SPDX-License-Identifier: MIT
// Source of the numbers: SPIR-V specification 1.0, sections 2.3 (physical layout), 3.20 and 3.32.
#include "spirv.hpp"

namespace pellucid::inline v0_1::opengl {

std::vector<rhi::SpecConstant> declared_constants(std::span<const std::uint32_t> spirv) {
    constexpr std::size_t header_words = 5;
    constexpr std::uint32_t op_decorate = 71, op_spec_constant_true = 48, op_spec_constant = 50, decoration_spec_id = 1;
    std::vector<rhi::SpecConstant> out;
    std::vector<std::uint32_t> results;  // result id of out[i]
    for (std::size_t at = header_words; at < spirv.size();) {
        const std::uint32_t op = spirv[at] & 0xFFFFu, count = spirv[at] >> 16u;
        if (count == 0 || at + count > spirv.size()) break;
        if (op == op_decorate && count == 4 && spirv[at + 2] == decoration_spec_id) {
            results.push_back(spirv[at + 1]);
            out.push_back({.id = spirv[at + 3]});
        }
        const bool boolean_true = op == op_spec_constant_true && count == 3;
        if (boolean_true || (op == op_spec_constant && count == 4))
            for (std::size_t i = 0; i < out.size(); ++i)
                if (results[i] == spirv[at + 2]) out[i].value = boolean_true ? 1 : spirv[at + 3];
        at += count;
    }
    return out;
}

std::vector<rhi::SpecConstant> merged_constants(std::vector<rhi::SpecConstant> declared,
                                                std::span<const rhi::SpecConstant> given) {
    for (rhi::SpecConstant& constant : declared)
        for (const rhi::SpecConstant& g : given)
            if (g.id == constant.id) constant.value = g.value;
    return declared;
}

}  // namespace pellucid::inline v0_1::opengl
