// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A compiler as a process of its own: how much processor time it takes for a file.
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <pellucid/core/result.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>
#include "support/json.hpp"

namespace pellucid::bench {

[[nodiscard]] inline std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
}

/// Runs a command; the user time [s] of it and of the processes that it started.  Errors: it cannot be run, or fails.
[[nodiscard]] inline Result<double> user_seconds(const std::vector<std::string>& command) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t child = 0;
    if (const int error = posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ))
        return Error{Errc::io, "cannot run '" + command[0] + "': " + std::strerror(error)};
    int status = 0;
    rusage usage{};
    while (wait4(child, &status, 0, &usage) < 0)
        if (errno != EINTR) return Error{Errc::io, "cannot wait for '" + command[0] + "': " + std::strerror(errno)};
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        std::string text;
        for (const std::string& word : command) text += word + " ";
        return Error{Errc::io, "this command failed, with the message above: " + text};
    }
    return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// Compiles sources of a few lines in a folder of its own, which it removes at the end.
class Compiler {
public:
    /// \param flags for every file, separated by spaces.
    static Result<Compiler> create(const std::string& program, const std::string& flags) {
        std::string folder = (std::filesystem::temp_directory_path() / "pellucid-compile-XXXXXX").string();
        if (!mkdtemp(folder.data())) return Error{Errc::io, "cannot make the folder " + folder};
        return Compiler(program, words(flags), folder);
    }
    Compiler(const Compiler&) = delete;
    Compiler& operator=(const Compiler&) = delete;
    Compiler(Compiler&& other) noexcept
        : program_(std::move(other.program_)),
          flags_(std::move(other.flags_)),
          folder_(std::exchange(other.folder_, std::string())) {}
    Compiler& operator=(Compiler&&) = delete;
    ~Compiler() {
        std::error_code ignored;
        if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
    }

    /// User time [s] of compiling `source` to an object.
    [[nodiscard]] Result<double> seconds(const std::string& source, const std::vector<std::string>& definitions = {}) {
        const std::string file = folder_ + "/source.cpp";
        PELLUCID_CHECK(write_file(file, source));
        std::vector<std::string> command = {program_};
        command.insert(command.end(), flags_.begin(), flags_.end());
        command.insert(command.end(), definitions.begin(), definitions.end());
        command.insert(command.end(), {"-c", "-o", folder_ + "/source.o", file});
        return user_seconds(command);
    }

private:
    Compiler(std::string program, std::vector<std::string> flags, std::string folder)
        : program_(std::move(program)), flags_(std::move(flags)), folder_(std::move(folder)) {}

    std::string program_;
    std::vector<std::string> flags_;
    std::string folder_;
};

/// The first line that a compiler tells about itself.
[[nodiscard]] inline std::string compiler_version(const std::string& program) {
    std::string out;
    if (std::FILE* pipe = popen((program + " --version 2>/dev/null").c_str(), "r")) {
        std::array<char, 256> line{};
        if (std::fgets(line.data(), static_cast<int>(line.size()), pipe)) out = line.data();
        pclose(pipe);
    }
    while (!out.empty() && out.back() == '\n') out.pop_back();
    return out.empty() ? program : out;
}

}  // namespace pellucid::bench
