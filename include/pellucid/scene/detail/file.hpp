// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Whole files in and out of memory, with the operating system's reason in every error.
#include <pellucid/core/result.hpp>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <vector>

namespace pellucid::inline v0_1::detail {

struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

/// The content of the regular file `path`, at most `limit` bytes of it.  Devices and pipes are refused: they have no
/// end to read to.
inline Result<std::vector<std::byte>> read_file(const std::string& path, std::uint64_t limit) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status)) return Error{Errc::io, path + ": there is no such file"};
    if (!std::filesystem::is_regular_file(status)) return Error{Errc::io, path + ": is not a regular file"};
    const std::uint64_t size = std::filesystem::file_size(path, code);
    if (code) return Error{Errc::io, path + ": cannot be examined: " + code.message()};
    if (size > limit)
        return Error{Errc::io, path + ": holds " + std::to_string(size) + " bytes, the limit is " +
                                   std::to_string(limit) + "; raise the limit to read it"};
    const FilePointer file(std::fopen(path.c_str(), "rb"));
    if (!file) return Error{Errc::io, path + ": cannot be opened: " + std::strerror(errno)};
    std::vector<std::byte> bytes(size);
    if (size != 0 && std::fread(bytes.data(), 1, size, file.get()) != size)
        return Error{Errc::io, path + ": could not be read to its end, " + std::to_string(size) + " bytes"};
    return bytes;
}

/// Replaces `path` by `bytes` in one step: they go to a new file beside it, which then takes its name.  Where any of it
/// fails, `path` is as it was.  What is no regular file (a pipe, /dev/null) is written to directly.
inline Result<void> write_file(const std::string& path, std::span<const std::byte> bytes) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    const bool direct = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
    std::string target = path;
    FilePointer file;
    if (direct) {
        file.reset(std::fopen(path.c_str(), "wb"));
    } else {
        // "x": a name that nobody holds yet, so that two writers never share a temporary file.
        for (int attempt = 0; attempt < 100 && !file; ++attempt) {
            target = path + ".part" + std::to_string(attempt);
            file.reset(std::fopen(target.c_str(), "wbx"));
            if (!file && errno != EEXIST) break;
        }
    }
    if (!file) return Error{Errc::io, path + ": cannot be written: " + std::strerror(errno)};
    errno = 0;
    bool good = bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    good = std::fclose(file.release()) == 0 && good;
    const int reason = errno;
    if (good && !direct) std::filesystem::rename(target, path, code);
    if (good && !code) return {};
    const std::string why = good ? code.message() : std::string(std::strerror(reason));
    if (!direct) std::filesystem::remove(target, code);
    return Error{Errc::io, path + ": " + std::to_string(bytes.size()) + " bytes could not be written: " + why};
}

}  // namespace pellucid::inline v0_1::detail
