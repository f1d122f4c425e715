// SPDX-License-Identifier: MIT
#include "panel_parts.hpp"
#include "widgets.hpp"
#include <algorithm>
#include <cmath>

namespace pellucid::samples::viewer {
namespace {

/// A logarithmic axis over whole decades.
struct Axis {
    double low = 0, high = 1;  ///< exponents of ten
    [[nodiscard]] float share(double value) const {
        return static_cast<float>(std::clamp((std::log10(value) - low) / (high - low), 0.0, 1.0));
    }
    static Axis over(double least, double most) {
        Axis out{std::floor(std::log10(least)), std::ceil(std::log10(most))};
        if (out.high <= out.low) out.high = out.low + 1;
        return out;
    }
};

}  // namespace

void scatter_plot(const Points& points, float height) {
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, height};
    ImGui::Dummy(size);
    if (points.all().empty()) return;
    double least_ms = 1e30, most_ms = 0, least_error = 1e30, most_error = 0;
    for (const Point& p : points.all()) {
        least_ms = std::min(least_ms, p.ms), most_ms = std::max(most_ms, p.ms);
        if (p.error > 0) least_error = std::min(least_error, p.error), most_error = std::max(most_error, p.error);
    }
    if (most_error == 0) least_error = most_error = 1e-6;
    const Axis x = Axis::over(std::max(least_ms, 1e-4), std::max(most_ms, 1e-4)),
               y = Axis::over(least_error, most_error);
    // Below the last decade there is room for errors of exactly 0.
    const float left = origin.x + 52, right = origin.x + size.x - 12, top = origin.y + 8,
                bottom = origin.y + size.y - 56, zero = bottom + 18;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 line = IM_COL32(255, 255, 255, 40), text = IM_COL32(200, 200, 200, 255);
    const auto label = [&](float at_x, float at_y, const char* format, double value) {
        char out[24];
        std::snprintf(out, sizeof out, format, value);
        list.AddText({at_x, at_y}, text, out);
    };
    for (double e = x.low; e <= x.high; ++e) {
        const float at = left + (right - left) * x.share(std::pow(10.0, e));
        list.AddLine({at, top}, {at, zero}, line);
        label(std::min(at - 8, right - 22), zero + 6, "%g", std::pow(10.0, e));
    }
    for (double e = y.low; e <= y.high; ++e) {
        const float at = bottom - (bottom - top) * y.share(std::pow(10.0, e));
        list.AddLine({left, at}, {right, at}, line);
        label(origin.x, at - 7, "%.0e", std::pow(10.0, e));
    }
    list.AddLine({left, zero}, {right, zero}, line);
    list.AddText({origin.x, zero - 7}, text, "0");
    list.AddText({left, zero + 22}, text, "time of a frame [ms], error: RMSE of radiance");
    const Point* nearest = nullptr;
    float nearest_distance = 100;  // squared pixels
    for (const Point& p : points.all()) {
        const ImVec2 at{left + (right - left) * x.share(std::max(p.ms, 1e-4)),
                        p.error > 0 ? bottom - (bottom - top) * y.share(p.error) : zero};
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const float distance = (at.x - mouse.x) * (at.x - mouse.x) + (at.y - mouse.y) * (at.y - mouse.y);
        if (distance < nearest_distance) nearest = &p, nearest_distance = distance;
        const ImU32 color = points.best(p) ? IM_COL32(120, 220, 120, 255) : IM_COL32(230, 150, 70, 255);
        list.AddCircleFilled(at, 4, color);
        const std::string name = p.label.substr(0, p.label.find(','));
        const float wide = ImGui::CalcTextSize(name.c_str()).x;
        list.AddText({at.x + 7 + wide < right ? at.x + 7 : at.x - 7 - wide, at.y - 7}, color, name.c_str());
    }
    if (nearest)
        ImGui::SetTooltip("%s\n%.3f ms, RMSE %.3g, measured %u times%s", nearest->label.c_str(), nearest->ms,
                          nearest->error, nearest->runs,
                          points.best(*nearest) ? "\nnone is both faster and closer" : "");
}

}  // namespace pellucid::samples::viewer
