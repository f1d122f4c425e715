// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Plots as SVG: points and lines over two logarithmic axes, each point with a label.  Speed against error is the
/// use: x milliseconds, y error, so that lower left is better.  No script, no font file; readable on light and dark.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace pellucid::bench {

struct PlotPoint {
    double x = 0;  ///< > 0
    double y = 0;  ///< >= 0; zero (no error at all) is drawn on the lowest line and labelled 0
    std::string label;
};
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    bool connected = false;  ///< a line through the points, in order: the settings of one method
};
struct Plot {
    std::string title;
    std::string x_label;  ///< with its unit
    std::string y_label;
    std::vector<PlotSeries> series;
};

namespace detail {

inline std::string escape_xml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

/// One logarithmic axis: whole decades around the values, mapped to [from, to] in pixels.
struct LogAxis {
    int low = 0, high = 1;  ///< exponents of ten
    double from = 0, to = 1;

    static LogAxis around(double smallest, double largest, double from, double to) {
        LogAxis axis{static_cast<int>(std::floor(std::log10(smallest))),
                     static_cast<int>(std::ceil(std::log10(largest))), from, to};
        if (axis.high == axis.low) ++axis.high;
        return axis;
    }
    [[nodiscard]] double at(double value) const {
        return from + (to - from) * (std::log10(value) - low) / (high - low);
    }
};

inline std::string line(double x0, double y0, double x1, double y1, const char* style) {
    char text[160];
    std::snprintf(text, sizeof text, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", x0, y0, x1, y1,
                  style);
    return text;
}
inline std::string label(double x, double y, const char* anchor, std::string_view words, const char* style = "") {
    char text[160];
    std::snprintf(text, sizeof text, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" %s>", x, y, anchor, style);
    return text + escape_xml(words) + "</text>\n";
}

}  // namespace detail

/// The plot as one SVG document of 860 by 560 pixels.  Points with x <= 0 or a value that is not finite are left out.
[[nodiscard]] inline std::string to_svg(const Plot& plot) {
    using detail::LogAxis;
    constexpr double left = 80, right = 640, top = 50, bottom = 490;
    // Eight colours that the common kinds of colour blindness tell apart (Okabe and Ito 2008).
    constexpr std::array colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                   "#e69f00", "#56b4e9", "#999933", "#777777"};
    const auto drawable = [](const PlotPoint& p) {
        return p.x > 0 && p.y >= 0 && std::isfinite(p.x) && std::isfinite(p.y);
    };

    double x_low = INFINITY, x_high = 0, y_low = INFINITY, y_high = 0;
    bool has_zero = false;
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& p : series.points) {
            if (!drawable(p)) continue;
            x_low = std::min(x_low, p.x), x_high = std::max(x_high, p.x);
            has_zero = has_zero || p.y == 0;
            if (p.y > 0) y_low = std::min(y_low, p.y), y_high = std::max(y_high, p.y);
        }
    if (!(x_high > 0)) x_low = 1, x_high = 10;
    if (!(y_high > 0)) y_low = 1e-3, y_high = 1;
    const LogAxis x = LogAxis::around(x_low, x_high, left, right);
    LogAxis y = LogAxis::around(y_low, y_high, bottom, top);
    if (has_zero) --y.low;  // the lowest line stands for zero
    const auto y_at = [&](double value) { return value > 0 ? y.at(value) : y.from; };

    std::string out =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"860\" height=\"560\" viewBox=\"0 0 860 560\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"860\" height=\"560\" fill=\"#ffffff\"/>\n";
    out += detail::label((left + right) / 2, 28, "middle", plot.title, "font-size=\"16\"");
    out += detail::label((left + right) / 2, bottom + 45, "middle", plot.x_label);
    out += detail::label(22, (top + bottom) / 2, "middle", plot.y_label, "transform=\"rotate(-90 22 270)\"");
    char number[32];
    for (int e = x.low; e <= x.high; ++e) {
        const double at = x.at(std::pow(10.0, e));
        out += detail::line(at, top, at, bottom, "stroke=\"#dddddd\"");
        std::snprintf(number, sizeof number, "%g", std::pow(10.0, e));
        out += detail::label(at, bottom + 18, "middle", number);
    }
    for (int e = y.low; e <= y.high; ++e) {
        const double at = y.at(std::pow(10.0, e));
        out += detail::line(left, at, right, at, "stroke=\"#dddddd\"");
        std::snprintf(number, sizeof number, "%g", std::pow(10.0, e));
        out += detail::label(left - 8, at + 4, "end", has_zero && e == y.low ? "0" : number);
    }
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
        const PlotSeries& series = plot.series[s];
        const std::string color = colors[s % colors.size()];
        const std::string stroke = "stroke=\"" + color + "\"";
        const PlotPoint* previous = nullptr;
        for (const PlotPoint& p : series.points) {
            if (!drawable(p)) continue;
            if (series.connected && previous)
                out += detail::line(x.at(previous->x), y_at(previous->y), x.at(p.x), y_at(p.y), stroke.c_str());
            previous = &p;
            char circle[96];
            std::snprintf(circle, sizeof circle, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"", x.at(p.x),
                          y_at(p.y));
            out += circle + color + "\"/>\n";
            if (!p.label.empty())
                out += detail::label(x.at(p.x) + 6, y_at(p.y) - 6, "start", p.label, "font-size=\"10\"");
        }
        const double row = top + 10 + 20 * static_cast<double>(s);
        out += detail::line(right + 20, row, right + 44, row, (stroke + " stroke-width=\"4\"").c_str());
        out += detail::label(right + 52, row + 4, "start", series.name);
    }
    return out + "</svg>\n";
}

}  // namespace pellucid::bench
