// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a person may choose in the viewer: the panel and the command line change it, the session obeys at the start of
/// the next frame.
#include <pellucid/renderer/settings.hpp>
#include <cstdint>
#include <string>

namespace pellucid::samples::viewer {

/// What is shown to the left of the split.
enum class View : std::uint8_t {
    picture,
    layers,   ///< translucent fragments in front of what is opaque
    error,    ///< how far the picture is from the one that it is judged by
    overdraw  ///< fragments that are rasterised, hidden ones and opaque ones too
};
inline constexpr const char* view_names[] = {"picture", "layers", "error", "overdraw"};
[[nodiscard]] constexpr const char* name(View v) noexcept {
    return view_names[static_cast<std::size_t>(v)];
}

/// What is shown to the right of the split, and what the error is measured against.
enum class Against : std::uint8_t {
    nothing,   ///< no split; an exact method is what errors are measured against
    method,    ///< another method of transparency, all else being equal
    reference  ///< what the reference renderer draws
};

enum class Motion : std::uint8_t { orbit, walk };
inline constexpr const char* motion_names[] = {"orbit", "walk"};

enum class Tab : std::uint8_t { settings, time, error };
inline constexpr const char* tab_names[] = {"settings", "time", "error"};

struct Choices {
    RenderSettings render;  ///< of the left picture; the session sets the size
    Against against = Against::nothing;
    Transparency other = Transparency::abuffer;  ///< with Against::method
    float split = 0.5f;                          ///< [0,1] share of the picture that is left
    View view = View::picture;
    Motion motion = Motion::orbit;
    std::uint32_t reference_divisor = 2;  ///< of the size of reference pictures: 1, 2 or 4
    bool measure_at_rest = true;          ///< measure once the camera has stood still for a while
    bool hide_ui = false;
    Tab tab = Tab::settings;
};

/// Whether two settings draw the same picture in the same way, sizes included.
[[nodiscard]] bool same(const RenderSettings& a, const RenderSettings& b);

/// The method, and every setting that is not the default: "peel, 8 layers, volumes".
[[nodiscard]] std::string describe(const RenderSettings& settings);

/// The settings of the right picture with Against::method: those of the left but for the method, and what only other
/// methods heed left out.
[[nodiscard]] RenderSettings with_method(RenderSettings settings, Transparency method);

}  // namespace pellucid::samples::viewer
