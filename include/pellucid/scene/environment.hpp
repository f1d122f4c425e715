// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Light from all around.
#include <pellucid/core/image.hpp>
#include <pellucid/scene/image_file.hpp>
#include <pellucid/scene/sky.hpp>
#include <cstdint>
#include <memory>

namespace pellucid::inline v0_1 {

/// Where light from all around comes from.
enum class EnvironmentKind : std::uint8_t {
    none,
    sky,     ///< procedural: scene/sky.hpp
    picture  ///< equirectangular, `[h, 2h, 3]` linear radiance, y up; which way: reference/environment.hpp
};
/// As programs spell it.
[[nodiscard]] constexpr const char* name(EnvironmentKind kind) noexcept {
    constexpr const char* names[] = {"none", "sky", "picture"};
    return names[static_cast<std::size_t>(kind)];
}

/// Light from all around.
struct Environment {
    EnvironmentKind kind = EnvironmentKind::none;
    Sky sky = {};
    std::shared_ptr<const ImageF> picture = {};  ///< of that kind; `check_environment` says what it must be
    std::uint32_t size = 0;                      ///< [texel] side of its cube map; 0: by the picture and the device
    bool backdrop = true;                        ///< seen where nothing else is, instead of the background
};

/// Errors: Errc::invalid_argument for a kind without its picture, or what `check_environment` of the picture says.
[[nodiscard]] inline Result<void> check_environment(const Environment& environment) {
    if (environment.kind != EnvironmentKind::picture) return {};
    if (!environment.picture)
        return Error{Errc::invalid_argument,
                     "an environment of the kind 'picture' has no picture: read one with read_hdr"};
    return check_environment(*environment.picture, "the environment");
}

}  // namespace pellucid::inline v0_1
