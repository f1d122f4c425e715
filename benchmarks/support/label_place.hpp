// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Where the labels of a plot's points go, so that no label covers another one, a point or a line that matters.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pellucid::bench {

/// An upright rectangle [px], y down.
struct PlotBox {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    /// [px²] of what both cover.
    [[nodiscard]] double overlap(const PlotBox& other) const {
        const double w = std::min(x1, other.x1) - std::max(x0, other.x0);
        const double h = std::min(y1, other.y1) - std::max(y0, other.y0);
        return w > 0 && h > 0 ? w * h : 0;
    }
    [[nodiscard]] double area() const { return (x1 - x0) * (y1 - y0); }
    [[nodiscard]] bool holds(double x, double y) const { return x > x0 && x < x1 && y > y0 && y < y1; }
};

/// A position [px].
struct PlotPin {
    double x = 0, y = 0;
};
/// The point of a box that is nearest to (x, y).
[[nodiscard]] inline PlotPin nearest(const PlotBox& box, double x, double y) {
    return {std::clamp(x, box.x0, box.x1), std::clamp(y, box.y0, box.y1)};
}

/// A point and the size of its label [px].  A width of 0: it has none, but no other label may cover it.
struct PlotAnchor {
    double x = 0, y = 0;
    double width = 0, height = 0;
};

namespace detail {

/// Places around a point that a label may take, the best first: beside it, then above and below, then farther off.
inline std::vector<PlotBox> label_places(const PlotAnchor& a) {
    constexpr double pi = 3.14159265358979323846;
    std::vector<PlotBox> out;
    for (const double gap : {8.0, 16.0, 26.0, 38.0, 52.0, 68.0})
        for (const int turn : {0, 8, 12, 4, 14, 2, 10, 6, 15, 1, 9, 7, 13, 3, 11, 5}) {
            const double angle = turn * pi / 8, dx = std::cos(angle), dy = std::sin(angle);
            // The label's nearest point to the anchor lies on a circle around it.
            const double x = a.x + gap * dx + 0.5 * a.width * (std::abs(dx) < 1e-9 ? 0 : dx > 0 ? 1 : -1);
            const double y = a.y + gap * dy + 0.5 * a.height * dy;
            out.push_back({x - 0.5 * a.width, y - 0.5 * a.height, x + 0.5 * a.width, y + 0.5 * a.height});
        }
    return out;
}

}  // namespace detail

/// One box for each anchor, inside `area` wherever there is room, off `obstacles`.  Each label in turn moves to the
/// place that costs least while the others stay, until none moves; the same input gives the same places.
[[nodiscard]] inline std::vector<PlotBox> place_labels(const std::vector<PlotAnchor>& anchors, const PlotBox& area,
                                                       const std::vector<PlotBox>& obstacles = {}) {
    constexpr double marker = 5;  // [px] half a point's own box
    std::vector<std::vector<PlotBox>> places;
    std::vector<std::size_t> chosen(anchors.size(), 0);
    for (const PlotAnchor& a : anchors) places.push_back(detail::label_places(a));
    const auto marker_of = [](const PlotAnchor& a) {
        return PlotBox{a.x - marker, a.y - marker, a.x + marker, a.y + marker};
    };
    const auto cost = [&](std::size_t i, std::size_t place) {
        const PlotBox& box = places[i][place];
        const PlotAnchor& a = anchors[i];
        const PlotPin pin = nearest(box, a.x, a.y);
        double sum = 0.5 * static_cast<double>(place);  // farther is worse, but any overlap is worse still
        sum += 50 * (box.area() - box.overlap(area));
        // What the label and the line that leads to it cover.
        const auto avoid = [&](const PlotBox& other, double weight) {
            sum += weight * box.overlap(other);
            for (const double t : {0.25, 0.5, 0.75, 1.0})
                sum += other.holds(a.x + t * (pin.x - a.x), a.y + t * (pin.y - a.y)) ? 40 : 0;
        };
        for (const PlotBox& o : obstacles) avoid(o, 10);
        for (std::size_t j = 0; j < anchors.size(); ++j) {
            if (j == i) {
                sum += 20 * box.overlap(marker_of(a));
                continue;
            }
            avoid(marker_of(anchors[j]), 20);
            if (anchors[j].width > 0) avoid(places[j][chosen[j]], 20);
        }
        return sum;
    };
    bool moved = true;
    for (int pass = 0; moved && pass < 50; ++pass) {
        moved = false;
        for (std::size_t i = 0; i < anchors.size(); ++i) {
            if (anchors[i].width <= 0) continue;
            std::size_t best = chosen[i];
            for (std::size_t p = 0; p < places[i].size(); ++p)
                if (cost(i, p) < cost(i, best)) best = p;
            moved = moved || best != chosen[i];
            chosen[i] = best;
        }
    }
    std::vector<PlotBox> out;
    for (std::size_t i = 0; i < anchors.size(); ++i) out.push_back(places[i][chosen[i]]);
    return out;
}

}  // namespace pellucid::bench
