// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Times of the last frames, by pass.
#include <pellucid/measure/statistics.hpp>
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

namespace pellucid::samples::viewer {

/// A ring of the last 240 values, oldest first as ImGui::PlotLines wants them: from `offset()` on.
class Ring {
public:
    static constexpr std::size_t capacity = 240;
    void push(double ms) {
        values_[next_] = static_cast<float>(ms);
        next_ = (next_ + 1) % capacity;
        count_ = std::min(count_ + 1, capacity);
    }
    [[nodiscard]] const float* data() const noexcept { return values_.data(); }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] std::size_t offset() const noexcept { return count_ < capacity ? 0 : next_; }
    [[nodiscard]] float last() const noexcept { return count_ ? values_[(next_ + capacity - 1) % capacity] : 0; }
    [[nodiscard]] double median() const {
        return measure::median(std::vector<double>(values_.begin(), values_.begin() + static_cast<long>(count_)));
    }
    [[nodiscard]] float max() const {
        return count_ ? *std::max_element(values_.begin(), values_.begin() + static_cast<long>(count_)) : 0;
    }

private:
    std::array<float, capacity> values_{};
    std::size_t next_ = 0, count_ = 0;
};

/// Passes are told apart by name; those of a renderer that is gone go with it (`clear`).
struct FrameHistory {
    struct Pass {
        std::string name;
        Ring ms;
    };
    Ring gpu;   ///< [ms] sum of the passes' GPU times
    Ring wall;  ///< [ms] wall clock of the frame
    std::vector<Pass> passes;

    void clear() { *this = {}; }
    /// `spans`: anything with `name` and `ms`; none where the device has no timestamps or none have arrived.
    template <class Spans>
    void push_gpu(const Spans& spans) {
        double sum = 0;
        for (const auto& span : spans) {
            sum += span.ms;
            auto at = std::find_if(passes.begin(), passes.end(), [&](const Pass& p) { return p.name == span.name; });
            if (at == passes.end()) at = passes.insert(passes.end(), {span.name, {}});
            at->ms.push(span.ms);
        }
        if (!std::empty(spans)) gpu.push(sum);
    }
};

}  // namespace pellucid::samples::viewer
