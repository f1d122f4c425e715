// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The split, taken by the pointer on the picture itself.
#include "choices.hpp"
#include "input.hpp"
#include "layout.hpp"
#include <cmath>

namespace pellucid::samples::viewer {

class SplitDrag {
public:
    /// Moves the split where the left button went down on it, and for as long as it is held.  Gives whether the pointer
    /// belongs to it.
    bool move(const Input& input, const Layout& layout, bool over_picture, Choices& choices) {
        constexpr float reach = 6;  // pixels to either side
        const auto left = static_cast<float>(layout.picture.x), width = static_cast<float>(layout.picture.width);
        const bool pressed = input.left && !held_;
        held_ = input.left;
        if (choices.against == Against::nothing || !(width > 0)) return dragging_ = false;
        const bool near = std::abs(input.x - left - choices.split * width) <= reach;
        dragging_ = input.left && (dragging_ || (pressed && over_picture && near));
        if (dragging_) choices.split = std::clamp((input.x - left) / width, 0.0f, 1.0f);
        return dragging_;
    }

private:
    bool dragging_ = false, held_ = false;
};

}  // namespace pellucid::samples::viewer
