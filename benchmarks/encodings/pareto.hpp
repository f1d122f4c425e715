// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Cost against error: what is beaten by nothing else, and a plot of it.
#include <string>
#include <vector>
#include "support/svg.hpp"

namespace pellucid::bench {

/// For each point whether it is on the Pareto front: no other point is at most as large in both x and y and smaller in
/// one of them.  Equal points are on it together.  Points with a coordinate that is not finite are never on it and beat
/// nothing.
[[nodiscard]] inline std::vector<bool> pareto_front(const std::vector<PlotPoint>& points) {
    const auto finite = [](const PlotPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
    std::vector<bool> out;
    for (const PlotPoint& p : points)
        out.push_back(finite(p) && std::none_of(points.begin(), points.end(), [&](const PlotPoint& q) {
                          return finite(q) && q.x <= p.x && q.y <= p.y && (q.x < p.x || q.y < p.y);
                      }));
    return out;
}

/// The plot of `points`: the front as one line from left to right, what it beats in grey.
[[nodiscard]] inline Plot pareto_plot(std::string title, std::string x_label, std::string y_label,
                                      const std::vector<PlotPoint>& points) {
    PlotSeries front{.name = "Pareto front", .points = {}, .connected = true};
    PlotSeries beaten{.name = "beaten by one of them", .points = {}, .guest = true};
    const std::vector<bool> on_front = pareto_front(points);
    for (std::size_t i = 0; i < points.size(); ++i) (on_front[i] ? front : beaten).points.push_back(points[i]);
    std::stable_sort(front.points.begin(), front.points.end(),
                     [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    Plot out{.title = std::move(title),
             .x_label = std::move(x_label),
             .y_label = std::move(y_label),
             .series = {std::move(front)}};
    if (!beaten.points.empty()) out.series.push_back(std::move(beaten));
    return out;
}

}  // namespace pellucid::bench
