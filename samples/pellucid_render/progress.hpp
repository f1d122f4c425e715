// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How far a long computation is, in one line on stderr that vanishes in the end; nothing where that is no terminal.
#include <unistd.h>
#include <cstdio>
#include <string>

class ProgressBar {
public:
    explicit ProgressBar(const char* what) : what_(what), shown_(::isatty(STDERR_FILENO) != 0) {}
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() {
        if (percent_ >= 0) std::fprintf(stderr, "\r%*s\r", width_ + 40, "");
    }
    /// As RenderOptions::progress wants it; `user` is the bar.
    static void show(void* user, double fraction) { static_cast<ProgressBar*>(user)->show(fraction); }

private:
    void show(double fraction) {
        const int percent = static_cast<int>(100 * fraction);
        if (!shown_ || percent == percent_) return;
        percent_ = percent;
        const auto done = static_cast<std::size_t>(fraction * width_);
        const std::string bar = std::string(done, '#') + std::string(width_ - done, '.');
        std::fprintf(stderr, "\r%s [%s] %d %%", what_, bar.c_str(), percent);
        std::fflush(stderr);
    }

    static constexpr int width_ = 40;
    const char* what_;
    bool shown_;
    int percent_ = -1;
};
