// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Every method of transparency there is, whoever adds one, and what may be expected of it.
#include <algorithm>
#include <optional>
#include <pellucid/renderer/settings.hpp>
#include <vector>

namespace pellucid::test {

/// How near to the truth a method comes.
enum class Exactness : std::uint8_t {
    no,             ///< by construction: it loses layers, orders whole objects, or mixes pixels
    single_depths,  ///< where no two fragments of a pixel have the same depth
    without_light,  ///< coverage, order, alpha and transmittance; light is shared
    yes
};
/// What Renderer::read_composited tells of each pixel.
enum class Audit : std::uint8_t { nothing, fragments, lights };

struct MethodFacts {
    Exactness exact = Exactness::no;
    Audit audit = Audit::nothing;
    bool mixes_pixels = false;  ///< a pixel shows what lies beside it
};

/// What tests may expect of each method of `all_transparencies`.  One that is not here does not compile where warnings
/// are errors, and fails a test elsewhere.
[[nodiscard]] constexpr std::optional<MethodFacts> find_facts(Transparency t) {
    switch (t) {
        case Transparency::none:
        case Transparency::sorted:
        case Transparency::peel_seed:
            return MethodFacts{};
        case Transparency::peel:
        case Transparency::abuffer:
            return MethodFacts{.exact = Exactness::yes, .audit = Audit::fragments};
        case Transparency::dual_peel:
            return MethodFacts{.exact = Exactness::single_depths};
        case Transparency::interleaved_skyx:
            return MethodFacts{.mixes_pixels = true};
        case Transparency::interleaved:
            return MethodFacts{.exact = Exactness::without_light, .audit = Audit::lights};
    }
    return {};
}
[[nodiscard]] inline MethodFacts facts(Transparency t) {
    return find_facts(t).value();
}

/// All of them, `none` too.
[[nodiscard]] inline std::vector<Transparency> none_and_all_methods() {
    std::vector<Transparency> out;
    for (const TransparencyTraits& t : all_transparencies) out.push_back(t.method);
    return out;
}
/// All of them but `none`.
[[nodiscard]] inline std::vector<Transparency> all_methods() {
    std::vector<Transparency> out = none_and_all_methods();
    out.erase(std::find(out.begin(), out.end(), Transparency::none));
    return out;
}
/// Those that are at least so exact.
[[nodiscard]] inline std::vector<Transparency> methods_exact(Exactness least) {
    std::vector<Transparency> out;
    for (const Transparency t : all_methods())
        if (facts(t).exact >= least) out.push_back(t);
    return out;
}

}  // namespace pellucid::test
