// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Plots as SVG: points and lines over two logarithmic axes, each point with a label.  Speed against error is the
/// use: x milliseconds, y error, so that lower left is better.  No script, no font file; readable on light and dark.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include "support/label_place.hpp"
#include "support/svg_parts.hpp"

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
    bool guest = false;      ///< not what it is about (somebody else's, or beaten): a grey diamond
};
struct Plot {
    std::string title;
    std::string x_label;  ///< with its unit
    std::string y_label;
    std::vector<PlotSeries> series;
    std::string remark = {};       ///< a small line under a panel's title
    double floor = 0;              ///< > 0: a marked line, and points below it are drawn on it
    std::string floor_label = {};  ///< what the line is
    double y_low = 0, y_high = 0;  ///< > 0: the y axis reaches at least from here to there
};
/// Small plots side by side, whose points are labelled with their series' names: no legend.
struct PlotSheet {
    std::string title, subtitle;
    std::vector<Plot> panels;
    std::size_t columns = 3;
};

namespace detail {

/// Series have colours in turn; guests are grey.
inline const PlotColor& color_of(const Plot& plot, std::size_t series) {
    return plot.series[series].guest ? plot_colors.back() : plot_colors[series % plot_colors.size()];
}

/// A plot in a rectangle of a document.
class PlotPanel {
public:
    /// `names`: points without a label of their own have the name of their series.
    PlotPanel(const Plot& plot, const PlotBox& area, double font_size, bool names)
        : plot_(plot), area_(area), font_(font_size), names_(names) {
        double x_low = INFINITY, x_high = 0, y_low = INFINITY, y_high = 0;
        const auto reach = [&](double y) {
            if (y > 0) y_low = std::min(y_low, y), y_high = std::max(y_high, y);
        };
        for (const PlotSeries& series : plot.series)
            for (const PlotPoint& p : series.points) {
                if (!drawable(p)) continue;
                x_low = std::min(x_low, p.x), x_high = std::max(x_high, p.x);
                has_zero_ = has_zero_ || (p.y == 0 && plot.floor == 0);
                reach(std::max(p.y, plot.floor));
            }
        reach(plot.floor), reach(plot.y_low), reach(plot.y_high);
        if (!(x_high > 0)) x_low = 1, x_high = 10;
        if (!(y_high > 0)) y_low = 1e-3, y_high = 1;
        x_ = LogAxis::around(x_low, x_high, area.x0, area.x1);
        y_ = LogAxis::around(y_low, y_high, area.y1, area.y0);
        if (has_zero_) y_.low /= 10;  // the lowest line stands for zero
    }

    [[nodiscard]] std::string text() const { return axes() + floor() + points(); }

private:
    [[nodiscard]] static bool drawable(const PlotPoint& p) {
        return p.x > 0 && p.y >= 0 && std::isfinite(p.x) && std::isfinite(p.y);
    }
    [[nodiscard]] double y_at(double value) const {
        const double shown = std::max(value, plot_.floor);
        return shown > 0 ? y_.at(shown) : y_.from;
    }
    [[nodiscard]] std::string font(double share = 1) const {
        char text[32];
        std::snprintf(text, sizeof text, "font-size=\"%.1f\"", font_ * share);
        return text;
    }

    [[nodiscard]] std::string axes() const {
        const auto grid = [](bool strong) {
            return std::string("stroke=\"") + (strong ? "#d9d9d9" : "#efefef") + "\"";
        };
        std::string out;
        char number[32];
        for (const auto [value, labelled] : x_.ticks()) {
            out += line(x_.at(value), area_.y0, x_.at(value), area_.y1, grid(labelled));
            std::snprintf(number, sizeof number, "%g", value);
            if (labelled) out += label(x_.at(value), area_.y1 + 1.4 * font_, "middle", number, font());
        }
        for (const auto [value, labelled] : y_.ticks()) {
            const bool zero = has_zero_ && value <= 1.001 * y_.low;
            out += line(area_.x0, y_.at(value), area_.x1, y_.at(value), grid(labelled || zero));
            std::snprintf(number, sizeof number, "%g", value);
            if (labelled || zero)
                out += label(area_.x0 - 6, y_.at(value) + 0.35 * font_, "end", zero ? "0" : number, font());
        }
        out += line(area_.x0, area_.y1, area_.x1, area_.y1, "stroke=\"#888888\"");
        out += line(area_.x0, area_.y0, area_.x0, area_.y1, "stroke=\"#888888\"");
        out += label((area_.x0 + area_.x1) / 2, area_.y1 + 3 * font_, "middle", plot_.x_label, font());
        const double x = area_.x0 - 5.1 * font_, y = (area_.y0 + area_.y1) / 2;
        char turned[80];
        std::snprintf(turned, sizeof turned, " transform=\"rotate(-90 %.1f %.1f)\"", x, y);
        return out + label(x, y, "middle", plot_.y_label, font() + turned);
    }

    [[nodiscard]] std::string floor() const {
        if (!(plot_.floor > 0)) return {};
        return line(area_.x0, y_at(0), area_.x1, y_at(0), "stroke=\"#555555\" stroke-dasharray=\"5 4\"") +
               label(area_.x1 - 3, y_at(0) + 1.1 * font_, "end", plot_.floor_label, font(0.9) + " fill=\"#555555\"");
    }

    [[nodiscard]] std::string points() const {
        std::string lines, marks, texts;
        std::vector<PlotAnchor> anchors;
        std::vector<const PlotColor*> colors;
        std::vector<std::string> words;
        for (std::size_t s = 0; s < plot_.series.size(); ++s) {
            const PlotSeries& series = plot_.series[s];
            const PlotColor& color = color_of(plot_, s);
            const std::string stroke = std::string("stroke=\"") + color.fill + "\"";
            const PlotPoint* previous = nullptr;
            for (const PlotPoint& p : series.points) {
                if (!drawable(p)) continue;
                if (series.connected && previous)
                    lines += line(x_.at(previous->x), y_at(previous->y), x_.at(p.x), y_at(p.y), stroke);
                previous = &p;
                marks += mark(x_.at(p.x), y_at(p.y), color.fill, series.guest);
                words.push_back(p.label.empty() && names_ ? series.name : p.label);
                anchors.push_back(
                    {x_.at(p.x), y_at(p.y), text_width(words.back(), font_), words.back().empty() ? 0 : font_});
                colors.push_back(&color);
            }
        }
        std::vector<PlotBox> obstacles;
        if (plot_.floor > 0) {
            const double width = text_width(plot_.floor_label, 0.9 * font_);
            obstacles.push_back({area_.x0, y_at(0) - 1.5, area_.x1, y_at(0) + 1.5});
            obstacles.push_back({area_.x1 - 3 - width, y_at(0), area_.x1, y_at(0) + 1.4 * font_});
        }
        const PlotBox inside{area_.x0 + 3, area_.y0 + 2, area_.x1 - 3, area_.y1 - 2};
        const std::vector<PlotBox> places = place_labels(anchors, inside, obstacles);
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (words[i].empty()) continue;
            const PlotBox& b = places[i];
            // A label that is not beside its point is led to it.
            const auto [x, y] = nearest(b, anchors[i].x, anchors[i].y);
            if (std::hypot(x - anchors[i].x, y - anchors[i].y) > 13)
                lines += line(anchors[i].x, anchors[i].y, x, y,
                              std::string("stroke=\"") + colors[i]->fill + "\" stroke-width=\"0.8\"");
            texts += label((b.x0 + b.x1) / 2, b.y1 - 0.22 * font_, "middle", words[i],
                           font() + " fill=\"" + colors[i]->text +
                               "\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
        }
        return lines + marks + texts;
    }

    [[nodiscard]] static std::string mark(double x, double y, const char* color, bool guest) {
        char text[200];
        if (guest)
            std::snprintf(text, sizeof text, "<path d=\"M%.1f %.1fl5 5l-5 5l-5 -5z\" fill=\"%s\"/>\n", x, y - 5, color);
        else
            std::snprintf(text, sizeof text, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\" fill=\"%s\"/>\n", x, y, color);
        return text;
    }

    const Plot& plot_;
    PlotBox area_;
    double font_;
    bool names_;
    bool has_zero_ = false;
    LogAxis x_, y_;
};

inline std::string svg_document(double width, double height, const std::string& content) {
    char text[300];
    std::snprintf(text, sizeof text,
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
                  "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"%.0f\" height=\"%.0f\" "
                  "fill=\"#ffffff\"/>\n",
                  width, height, width, height, width, height);
    return text + content + "</svg>\n";
}

}  // namespace detail

/// The plot as one SVG document of 860 by 560 pixels with a legend.  Points with x <= 0 or a value that is not finite
/// are left out.
[[nodiscard]] inline std::string to_svg(const Plot& plot) {
    constexpr PlotBox area{80, 50, 640, 490};
    std::string out = detail::label((area.x0 + area.x1) / 2, 28, "middle", plot.title, "font-size=\"16\"");
    out += detail::PlotPanel(plot, area, 12, false).text();
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
        const double row = area.y0 + 10 + 20 * static_cast<double>(s);
        const std::string stroke = std::string("stroke=\"") + detail::color_of(plot, s).fill + "\" stroke-width=\"4\"";
        out += detail::line(area.x1 + 20, row, area.x1 + 44, row, stroke);
        out += detail::label(area.x1 + 52, row + 4, "start", plot.series[s].name);
    }
    return detail::svg_document(860, 560, out);
}

/// All panels in rows of `columns`, 340 by 310 pixels each, under one title.
[[nodiscard]] inline std::string to_svg(const PlotSheet& sheet) {
    constexpr double width = 340, height = 310, head = 64, font = 11;
    const std::size_t columns = std::clamp<std::size_t>(sheet.panels.size(), 1, sheet.columns);
    const std::size_t rows = (sheet.panels.size() + columns - 1) / columns;
    std::string out = detail::label(16, 28, "start", sheet.title, "font-size=\"18\" font-weight=\"bold\"");
    out += detail::label(16, 48, "start", sheet.subtitle, "font-size=\"12\" fill=\"#555555\"");
    for (std::size_t i = 0; i < sheet.panels.size(); ++i) {
        const double x = width * static_cast<double>(i % columns), y = head + height * static_cast<double>(i / columns);
        const PlotBox area{x + 68, y + 42, x + width - 12, y + height - 46};
        out += detail::label(area.x0, y + 18, "start", sheet.panels[i].title, "font-size=\"13\" font-weight=\"bold\"");
        out += detail::label(area.x0, y + 34, "start", sheet.panels[i].remark, "font-size=\"11\" fill=\"#555555\"");
        out += detail::PlotPanel(sheet.panels[i], area, font, true).text();
    }
    return detail::svg_document(width * static_cast<double>(columns) + 8, head + height * static_cast<double>(rows),
                                out);
}

}  // namespace pellucid::bench
