// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// One long computation at a time on a thread of its own, while the window stays alive.
#include <pellucid/core/result.hpp>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace pellucid::samples::viewer {

/// What the computation and the one who waits for it share.
struct TaskControl {
    std::atomic<double> fraction{-1};  ///< [0,1] that is done; below 0: nobody knows
    std::atomic<bool> stop{false};     ///< set where the result is wanted no more
};

/// Starting another computation abandons the one that runs: it is told to stop, and its result is dropped.  All threads
/// have ended when the task goes.
template <class T>
class Task {
public:
    ~Task() { cancel(); }
    Task() = default;
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

    /// `work(TaskControl&) -> Result<T>`, called on the other thread.  `what`: for people, "reading scene.glb".
    template <class Work>
    void start(std::string what, Work work) {
        cancel();
        what_ = std::move(what);
        running_ = std::make_shared<Running>();
        threads_.emplace_back([running = running_, work = std::move(work)]() mutable {
            running->result.emplace(work(running->control));
            running->done.store(true, std::memory_order_release);
        });
    }
    /// Nothing runs afterwards, as far as the caller is concerned; the thread ends when it heeds the wish.
    void cancel() {
        if (running_) running_->control.stop = true;
        running_.reset();
    }
    [[nodiscard]] bool running() const noexcept { return running_ != nullptr; }
    [[nodiscard]] const std::string& what() const noexcept { return what_; }
    /// [0,1], or below 0.
    [[nodiscard]] double fraction() const noexcept { return running_ ? running_->control.fraction.load() : 0; }

    /// The result, once, when it is there.
    [[nodiscard]] std::optional<Result<T>> take() {
        if (!running_ || !running_->done.load(std::memory_order_acquire)) return std::nullopt;
        std::optional<Result<T>> out = std::move(running_->result);
        running_.reset();
        threads_.clear();  // joins; those that were told to stop too
        return out;
    }
    /// Waits for the result.  Precondition: running().
    [[nodiscard]] Result<T> wait() {
        threads_.back().join();
        threads_.pop_back();
        return *take();
    }

private:
    struct Running {
        TaskControl control;
        std::optional<Result<T>> result;
        std::atomic<bool> done{false};
    };
    std::string what_;
    std::shared_ptr<Running> running_;
    std::vector<std::jthread> threads_;
};

}  // namespace pellucid::samples::viewer
