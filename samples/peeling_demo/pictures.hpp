// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The demonstration without a window: each layer alone, the first ones composited, and all of them on one sheet.
#include "../support/demo.hpp"
#include "sheet.hpp"
#include "stage.hpp"
#include <pellucid/scene/image_file.hpp>
#include <cstdio>
#include <filesystem>
#include <vector>

namespace pellucid::samples {

/// Writes folder/layer_01.png, … (a layer alone), folder/first_01.png, … (so many layers composited), of `layers` >= 1
/// each, and folder/sheet.png: layers above, composites below.  Errors: the device's, and io.
template <rhi::Backend B>
[[nodiscard]] Result<void> write_layers(typename B::Device& device, PeelingStage<B>& stage, const Camera& camera,
                                        std::uint32_t layers, const std::string& folder) {
    PELLUCID_CHECK(make_folder(folder));
    PELLUCID_CHECK(stage.draw(camera));
    const std::uint32_t found = stage.layers();
    std::vector<Image8> pictures;
    for (const bool alone : {true, false})
        for (std::uint32_t k = 0; k < layers; ++k) {
            PELLUCID_CHECK(stage.draw(camera, {.first = alone ? k : 0, .end = k + 1}));
            PELLUCID_TRY(Image8 picture, stage.read_display());
            char name[32];
            std::snprintf(name, sizeof name, "%s_%02u.png", alone ? "layer" : "first", k + 1);
            PELLUCID_CHECK(write_png((std::filesystem::path(folder) / name).string(), picture));
            pictures.push_back(std::move(picture));
        }
    const std::string sheet = (std::filesystem::path(folder) / "sheet.png").string();
    PELLUCID_CHECK(write_png(sheet, contact_sheet(pictures, layers)));
    std::printf("%s on %s: %u of the scene's %u layers, alone and composited: %s\n", B::name,
                device.info().name.c_str(), std::min(layers, found), found, sheet.c_str());
    return {};
}

}  // namespace pellucid::samples
