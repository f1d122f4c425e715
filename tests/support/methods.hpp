// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Every method of transparency there is, whoever adds one.
#include <pellucid/renderer/settings.hpp>
#include <type_traits>
#include <vector>

namespace pellucid::test {

/// Whether there is a method number `I`: behind the last one, `name` reads beyond its table, which is no constant.
template <std::size_t I>
concept IsMethod = requires {
    typename std::bool_constant<(name(static_cast<Transparency>(I)) != nullptr)>;
};

template <std::size_t I = 0>
[[nodiscard]] constexpr std::size_t method_count() {
    if constexpr (IsMethod<I>)
        return method_count<I + 1>();
    else
        return I;
}
static_assert(method_count() > static_cast<std::size_t>(Transparency::abuffer));

/// All of them but `none`.
[[nodiscard]] inline std::vector<Transparency> all_methods() {
    std::vector<Transparency> out;
    for (std::size_t i = 0; i < method_count(); ++i)
        if (const auto t = static_cast<Transparency>(i); t != Transparency::none) out.push_back(t);
    return out;
}

}  // namespace pellucid::test
