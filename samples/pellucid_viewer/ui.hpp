// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Dear ImGui's context: one for as long as the viewer runs, whatever device draws it.
#include "input.hpp"
#include <pellucid/core/image.hpp>

struct ImDrawData;
struct ImGuiContext;
struct ImFontAtlas;

namespace pellucid::samples::viewer {

class Ui {
public:
    Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;
    ~Ui();

    [[nodiscard]] ImFontAtlas& fonts() const;
    /// Begins a frame on a canvas of this size, both sides above 0.
    void begin(const Input& input, Extent2D canvas) const;
    /// Ends it.  The lists are valid until the next frame begins.
    [[nodiscard]] const ImDrawData& end() const;
    /// The panel uses the pointer, so the camera must not.
    [[nodiscard]] bool wants_pointer() const;

private:
    ImGuiContext* context_;
};

}  // namespace pellucid::samples::viewer
