// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// --environment none|sky|FILE.hdr, and the picture that it may name.
#include <pellucid/renderer/settings.hpp>
#include <string>
#include <utility>

namespace pellucid::samples {

/// Puts the text's meaning into the settings, and the file's name into `file`.  What is wrong with it, or nothing.
[[nodiscard]] inline std::string parse_environment(const std::string& text, RenderSettings& settings,
                                                   std::string& file) {
    if (text == "none") settings.default_light = false;
    if (text == "sky") settings.environment.kind = EnvironmentKind::sky;
    if (text.ends_with(".hdr"))
        file = text;
    else if (!text.empty() && text != "none" && text != "sky")
        return "--environment is none, sky or a FILE.hdr, not '" + text + "'";
    return {};
}

/// Reads a picture of all around.  Errors: io, parse.
[[nodiscard]] inline Result<std::shared_ptr<const ImageF>> read_environment(const std::string& file) {
    PELLUCID_TRY(ImageF picture, read_hdr(file));
    if (const Result<void> fit = check_environment(picture, file); !fit) return Error{Errc::parse, fit.error().message};
    return std::make_shared<const ImageF>(std::move(picture));
}

}  // namespace pellucid::samples
