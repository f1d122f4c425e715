// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Another program, spoken with line by line: a peer that takes its turn in every round.
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <pellucid/core/result.hpp>
#include <string>
#include <utility>

namespace pellucid::bench {

/// A shell command whose standard input and output are ours.  It must end when its input ends, which it does when this
/// object goes; one that was silent for too long is terminated.
class Conversation {
public:
    Conversation() = default;
    Conversation(Conversation&& other) noexcept
        : socket_(std::exchange(other.socket_, -1)),
          process_(std::exchange(other.process_, -1)),
          hangs_(other.hangs_),
          unread_(std::move(other.unread_)) {}
    Conversation& operator=(Conversation&& other) noexcept {
        std::swap(socket_, other.socket_);
        std::swap(process_, other.process_);
        std::swap(hangs_, other.hangs_);
        std::swap(unread_, other.unread_);
        return *this;
    }
    ~Conversation() {
        if (socket_ >= 0) close(socket_);
        if (process_ > 0 && hangs_) kill(-process_, SIGTERM);
        if (process_ > 0) waitpid(process_, nullptr, 0);
    }

    /// `timeout`: [s] longest silence of the program.  Errors: io.
    [[nodiscard]] static Result<Conversation> start(const std::string& command, int timeout = 120) {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
            return Error{Errc::io, "cannot make a socket to speak with '" + command + "'"};
        Conversation out;
        out.socket_ = ends[0];
        const timeval limit{.tv_sec = timeout, .tv_usec = 0};
        setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawnattr_t attributes;  // a group of its own, which can be ended as a whole
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        const char* const words[] = {"sh", "-c", command.c_str(), nullptr};
        const int failed =
            posix_spawn(&out.process_, "/bin/sh", &actions, &attributes, const_cast<char**>(words), environ);
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
        close(ends[1]);
        if (failed) {
            out.process_ = -1;
            return Error{Errc::io, "cannot start '" + command + "'"};
        }
        return out;
    }

    /// Sends a line, unless it is empty, and returns the next line that starts with `sign`.
    /// Errors: io where the program ended or was silent for too long.
    [[nodiscard]] Result<std::string> ask(const std::string& words, char sign) {
        const std::string sent = words.empty() ? words : words + "\n";
        if (send(socket_, sent.data(), sent.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(sent.size()))
            return Error{Errc::io, "the program that was asked '" + words + "' has ended"};
        for (;;) {
            const std::size_t end = unread_.find('\n');
            if (end == std::string::npos) {
                char part[4096];
                const ssize_t n = read(socket_, part, sizeof part);
                hangs_ = n < 0;
                if (n <= 0)
                    return Error{Errc::io, "the program that was asked '" + words +
                                               (n == 0 ? "' has ended" : "' does not answer")};
                unread_.append(part, static_cast<std::size_t>(n));
                continue;
            }
            std::string line = unread_.substr(0, end);
            unread_.erase(0, end + 1);
            if (!line.empty() && line[0] == sign) return line;
        }
    }

private:
    int socket_ = -1;
    pid_t process_ = -1;
    bool hangs_ = false;  ///< it was silent for too long
    std::string unread_;
};

}  // namespace pellucid::bench
