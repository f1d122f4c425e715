// SPDX-License-Identifier: MIT
#include "program_cache.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <memory>

#include "text.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

constexpr char magic[4] = {'P', 'G', 'L', '1'};

struct EntryHead {
    std::uint64_t key[2] = {};
    std::uint32_t format = 0, size = 0;
    std::uint64_t check = 0;  ///< of the bytes: a driver may crash on a damaged binary
};

std::uint64_t checksum(std::span<const std::byte> bytes) {
    ProgramKey key;
    key.add(bytes);
    return key.value()[0];
}

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

std::vector<std::byte> read_all(std::FILE* file) {
    std::vector<std::byte> bytes;
    std::byte block[65536];
    while (const std::size_t n = std::fread(block, 1, sizeof block, file)) bytes.insert(bytes.end(), block, block + n);
    return bytes;
}

}  // namespace

void ProgramKey::add(std::span<const std::byte> bytes) {
    auto mix = [this](std::uint64_t value) {
        for (std::uint64_t& s : state_) s = (s ^ value) * 0x100000001B3u;
        state_[1] ^= state_[1] >> 29u;
    };
    for (const std::byte b : bytes) mix(static_cast<std::uint64_t>(b));
    for (std::size_t n = bytes.size(), i = 0; i < 8; ++i, n >>= 8u) mix(n & 0xFFu);  // no two lists run together
}

ProgramCache::ProgramCache(std::string file, std::string identity, LogSink log)
    : file_(std::move(file)), identity_(std::move(identity)), log_(log) {
    read();
}

void ProgramCache::read() {
    const File file(std::fopen(file_.c_str(), "rb"));
    if (!file) return;  // the first start
    const std::vector<std::byte> bytes = read_all(file.get());
    std::span<const std::byte> rest = bytes;
    auto take = [&](void* to, std::size_t n) {
        if (rest.size() < n) return false;
        if (n > 0) std::memcpy(to, rest.data(), n);
        rest = rest.subspan(n);
        return true;
    };
    char head[4] = {};
    std::uint32_t length = 0;
    bool broken = !take(head, 4) || std::memcmp(head, magic, 4) != 0 || !take(&length, 4) || rest.size() < length;
    if (!broken) {
        std::string identity(length, '\0');
        take(identity.data(), length);
        if (identity != identity_) return;  // another driver's: replaced when this one saves
    }
    while (!broken && !rest.empty()) {
        EntryHead entry;
        broken =
            !take(&entry, sizeof entry) || rest.size() < entry.size || checksum(rest.first(entry.size)) != entry.check;
        if (broken) break;
        Entry& made = entries_[{entry.key[0], entry.key[1]}];
        made.format = entry.format;
        made.bytes.assign(rest.begin(), rest.begin() + entry.size);
        rest = rest.subspan(entry.size);
    }
    if (!broken) return;
    entries_.clear();
    changed_ = true;
    log_(Severity::warning,
         text("The pipeline cache '%s' is broken and is ignored: it is written anew", file_.c_str()).c_str());
}

GLuint ProgramCache::load(const ProgramKey& key) {
    const auto found = entries_.find(key.value());
    if (found == entries_.end()) return 0;
    const GLuint program = glCreateProgram();
    glProgramBinary(program, found->second.format, found->second.bytes.data(),
                    static_cast<GLsizei>(found->second.bytes.size()));
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) return program;
    glDeleteProgram(program);  // e.g. a driver update that kept its version string
    entries_.erase(found);
    changed_ = true;
    return 0;
}

void ProgramCache::store(const ProgramKey& key, GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0) return;  // Mesa without its shader cache
    Entry entry;
    entry.bytes.resize(static_cast<std::size_t>(length));
    GLsizei written = 0;
    glGetProgramBinary(program, length, &written, &entry.format, entry.bytes.data());
    if (written <= 0) return;
    entry.bytes.resize(static_cast<std::size_t>(written));
    entries_[key.value()] = std::move(entry);
    changed_ = true;
}

void ProgramCache::save() {
    if (!changed_ || entries_.empty()) return;
    const std::string temporary = text("%s.%ld.part", file_.c_str(), static_cast<long>(getpid()));
    bool ok = false;
    if (const File file(std::fopen(temporary.c_str(), "wb")); file) {
        auto put = [&](const void* from, std::size_t n) { return std::fwrite(from, 1, n, file.get()) == n; };
        const auto length = static_cast<std::uint32_t>(identity_.size());
        ok = put(magic, 4) && put(&length, 4) && put(identity_.data(), length);
        for (const auto& [key, entry] : entries_) {
            const EntryHead head{.key = {key[0], key[1]},
                                 .format = entry.format,
                                 .size = static_cast<std::uint32_t>(entry.bytes.size()),
                                 .check = checksum(entry.bytes)};
            ok = ok && put(&head, sizeof head) && put(entry.bytes.data(), entry.bytes.size());
        }
        ok = ok && std::fflush(file.get()) == 0;
    }
    if (ok && std::rename(temporary.c_str(), file_.c_str()) == 0) {
        changed_ = false;
        return;
    }
    std::remove(temporary.c_str());
    log_(Severity::warning,
         text("The pipeline cache '%s' could not be written: check the folder and its space", file_.c_str()).c_str());
}

}  // namespace pellucid::inline v0_1::opengl
