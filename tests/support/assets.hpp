// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Where the big test inputs are: models and malformed files (`assets`), scenes with known answers (`scenes`).  They
/// are not part of the repository.
#include <filesystem>
#include <optional>
#include <string>
#include "support/skip.hpp"

namespace pellucid::test {

/// A folder named by the environment variable, else `shared/<name>` in or beside the source folder; nothing where there
/// is none.
inline std::optional<std::filesystem::path> find_shared(const char* variable, const char* name) {
    namespace fs = std::filesystem;
    if (const char* given = std::getenv(variable); given && *given) {
        if (fs::is_directory(given)) return fs::path(given);
        return std::nullopt;
    }
    const fs::path source = PELLUCID_SOURCE_DIR;
    for (const fs::path& base : {source, source.parent_path(), source.parent_path().parent_path()})
        if (fs::is_directory(base / "shared" / name)) return base / "shared" / name;
    return std::nullopt;
}

/// The assets' folder, or a skip (a failure under PELLUCID_REQUIRE_ASSETS=1).
inline std::optional<std::filesystem::path> assets() {
    auto found = find_shared("PELLUCID_ASSETS", "assets");
    if (!found) skip("no folder of assets: set PELLUCID_ASSETS", "PELLUCID_REQUIRE_ASSETS");
    return found;
}
/// The folder of scenes with known answers, or a skip.
inline std::optional<std::filesystem::path> scenes() {
    auto found = find_shared("PELLUCID_SCENES", "scenes");
    if (!found) skip("no folder of scenes: set PELLUCID_SCENES", "PELLUCID_REQUIRE_ASSETS");
    return found;
}

}  // namespace pellucid::test
