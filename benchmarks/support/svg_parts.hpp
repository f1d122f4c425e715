// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What plots are made of: SVG elements as text, colours, and a logarithmic axis.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace pellucid::bench::detail {

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

/// Eight colours that the common kinds of colour blindness tell apart (Okabe and Ito 2008), in the order of use, and a
/// shade of each that is dark enough for text on white.
struct PlotColor {
    const char* fill;
    const char* text;
};
inline constexpr std::array<PlotColor, 8> plot_colors = {{{"#0072b2", "#005a8e"},
                                                          {"#d55e00", "#a84a00"},
                                                          {"#009e73", "#00754f"},
                                                          {"#cc79a7", "#9c4677"},
                                                          {"#e69f00", "#8f6300"},
                                                          {"#56b4e9", "#2377a5"},
                                                          {"#999933", "#6b6b1f"},
                                                          {"#777777", "#555555"}}};

inline std::string line(double x0, double y0, double x1, double y1, std::string_view style) {
    char text[120];
    std::snprintf(text, sizeof text, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" ", x0, y0, x1, y1);
    return text + std::string(style) + "/>\n";
}
inline std::string label(double x, double y, const char* anchor, std::string_view words, std::string_view style = "") {
    char text[120];
    std::snprintf(text, sizeof text, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" ", x, y, anchor);
    return text + std::string(style) + ">" + escape_xml(words) + "</text>\n";
}
/// [px] about the width of words in a common sans-serif face: no font is measured here.
inline double text_width(std::string_view words, double font_size) {
    double letters = 0;
    for (const char c : words) letters += (c & 0xC0) == 0x80 ? 0 : c == 'l' || c == 'i' || c == ' ' ? 0.33 : 0.6;
    return letters * font_size;
}

/// One logarithmic axis, from one of 1, 2, 5 · 10^n to another, mapped to [from, to] in pixels.
struct LogAxis {
    double low = 1, high = 10;
    double from = 0, to = 1;

    /// The values `smallest` <= `largest`, both > 0, lie on it with some room on both sides.
    static LogAxis around(double smallest, double largest, double from, double to) {
        const auto beyond = [](double value, bool up) {  // the next of 1, 2, 5 · 10^n
            const double decade = std::pow(10.0, std::floor(std::log10(value)));
            constexpr double steps[] = {1, 2, 5, 10};
            double below = 1, above = 10;
            for (const double step : steps)
                if (step * decade <= value) below = step;
            for (int i = 3; i >= 0; --i)
                if (steps[i] * decade >= value) above = steps[i];
            return (up ? above : below) * decade;
        };
        return {beyond(smallest / 1.2, false), beyond(largest * 1.2, true), from, to};
    }
    [[nodiscard]] double at(double value) const {
        return from + (to - from) * (std::log(value / low) / std::log(high / low));
    }
    struct Tick {
        double value;
        bool labelled;
    };
    /// At 1, 2, 5 · 10^n; only decades have labels where there are many.
    [[nodiscard]] std::vector<Tick> ticks() const {
        std::vector<Tick> out;
        const bool few = high / low <= 300;
        for (double decade = std::pow(10.0, std::floor(std::log10(low) + 1e-9)); decade <= high * 1.001; decade *= 10)
            for (const double step : {1.0, 2.0, 5.0})
                if (const double v = step * decade; v >= low * 0.999 && v <= high * 1.001)
                    out.push_back({v, few || step == 1.0});
        return out;
    }
};

}  // namespace pellucid::bench::detail
