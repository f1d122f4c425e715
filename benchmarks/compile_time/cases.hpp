// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What is compiled: nothing, a yardstick, the umbrella, each public header alone.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace pellucid::bench {

/// A file of the standard library's headers and no others.  How long it takes says how fast the machine compiles just
/// now. It never changes, or results cannot be compared.
inline constexpr const char* yardstick =
    "#include <algorithm>\n#include <array>\n#include <chrono>\n#include <functional>\n#include <map>\n"
    "#include <memory>\n#include <optional>\n#include <random>\n#include <ranges>\n#include <regex>\n"
    "#include <string>\n#include <thread>\n#include <unordered_map>\n#include <variant>\n#include <vector>\n";

struct CompileCase {
    std::string name;
    std::string source;
    std::vector<std::string> definitions = {};
    bool budgeted = false;  ///< the umbrella with one backend: DESIGN.md has a budget for it
};

/// The umbrella without a backend, with either one, and with both; and beside it all passes, for who drives them.
[[nodiscard]] inline std::vector<CompileCase> umbrella_cases() {
    const std::string source = "#include <pellucid/pellucid.hpp>\n";
    const std::string vulkan = "-DPELLUCID_HAS_VULKAN=1", opengl = "-DPELLUCID_HAS_OPENGL=1";
    return {{"pellucid.hpp, no backend", source},
            {"pellucid.hpp, Vulkan", source, {vulkan}, true},
            {"pellucid.hpp, OpenGL", source, {opengl}, true},
            {"pellucid.hpp, both backends", source, {vulkan, opengl}},
            {"pellucid.hpp, vulkan/passes.hpp", source + "#include <pellucid/vulkan/passes.hpp>\n", {vulkan}},
            {"pellucid.hpp, opengl/passes.hpp", source + "#include <pellucid/opengl/passes.hpp>\n", {opengl}}};
}

/// Each public header of the folders `roots`, by its path: what users include, so neither bodies nor details.
[[nodiscard]] inline std::vector<CompileCase> header_cases(const std::vector<std::string>& roots) {
    std::vector<CompileCase> out;
    for (const std::string& root : roots) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
            const std::string path = entry.path().lexically_relative(root).generic_string();
            const bool header = path.ends_with(".hpp") || path.ends_with(".h");
            if (!header || path.ends_with("-inl.hpp") || path.find("/detail/") != std::string::npos) continue;
            if (path != "pellucid/pellucid.hpp")
                out.push_back({path.substr(path.find('/') + 1), "#include <" + path + ">\n"});
        }
    }
    std::sort(out.begin(), out.end(), [](const CompileCase& a, const CompileCase& b) { return a.name < b.name; });
    return out;
}

}  // namespace pellucid::bench
