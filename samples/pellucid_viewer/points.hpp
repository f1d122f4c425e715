// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Time against error: a point for each combination of settings that was tried on one scene from one camera.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace pellucid::samples::viewer {

struct Point {
    std::string label;       ///< the settings
    double ms = 0;           ///< [ms] of a frame
    double error = 0;        ///< RMSE of linear radiance; 0 is possible
    std::uint32_t runs = 0;  ///< times it was measured; `ms` is the least of them
};

/// All points are of one occasion: a scene, a camera, a size and a truth.  Another occasion begins anew.
class Points {
public:
    /// `key`: differs where the occasion does; `text`: says it to people.
    void begin(const std::string& key, const std::string& text) {
        if (key == key_) return;
        key_ = key;
        text_ = text;
        points_.clear();
    }
    /// Settings that were measured before keep one point: the least time, the newest error.
    void add(const std::string& label, double ms, double error) {
        const auto at = std::find_if(points_.begin(), points_.end(), [&](const Point& p) { return p.label == label; });
        if (at == points_.end()) {
            points_.push_back({label, ms, error, 1});
        } else {
            at->ms = std::min(at->ms, ms);
            at->error = error;
            ++at->runs;
        }
    }
    [[nodiscard]] bool has(const std::string& label) const {
        return std::any_of(points_.begin(), points_.end(), [&](const Point& p) { return p.label == label; });
    }
    /// Whether no other point is both no slower and no more wrong (and better in one of the two).
    [[nodiscard]] bool best(const Point& p) const {
        return std::none_of(points_.begin(), points_.end(), [&](const Point& q) {
            return q.ms <= p.ms && q.error <= p.error && (q.ms < p.ms || q.error < p.error);
        });
    }
    [[nodiscard]] const std::vector<Point>& all() const noexcept { return points_; }
    [[nodiscard]] const std::string& occasion() const noexcept { return text_; }

private:
    std::string key_, text_;
    std::vector<Point> points_;
};

}  // namespace pellucid::samples::viewer
