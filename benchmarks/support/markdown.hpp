// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Tables in Markdown, and numbers as people read them.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>
#include "support/time.hpp"

namespace pellucid::bench {

/// `number` with `digits` significant digits, without an exponent where that is readable (1e-4 … 1e7).
[[nodiscard]] inline std::string significant(double number, int digits = 3) {
    char text[48];
    if (number == 0) return "0";
    const double size = number < 0 ? -number : number;
    if (size < 1e-4 || size >= 1e7) {
        std::snprintf(text, sizeof text, "%.*e", digits - 1, number);
    } else {
        int decimals = digits - 1;
        for (double limit = 10; decimals > 0 && size >= limit; limit *= 10) --decimals;
        for (double limit = 1; size < limit; limit /= 10) ++decimals;
        std::snprintf(text, sizeof text, "%.*f", decimals, number);
    }
    return text;
}

/// "median [first quartile – third quartile]", each times `scale`.
[[nodiscard]] inline std::string with_spread(const Summary& s, double scale = 1, int digits = 3) {
    if (s.count == 0) return "–";
    return significant(s.median * scale, digits) + " [" + significant(s.q1 * scale, digits) + " – " +
           significant(s.q3 * scale, digits) + "]";
}

/// Rows of cells under a header, padded so that the text reads as a table too.
class MarkdownTable {
public:
    explicit MarkdownTable(std::vector<std::string> header) : rows_{std::move(header)} {}

    /// Missing cells are left empty; more cells than the header has are dropped.
    void row(std::vector<std::string> cells) {
        cells.resize(rows_.front().size());
        rows_.push_back(std::move(cells));
    }

    [[nodiscard]] std::string text() const {
        std::vector<std::size_t> width(rows_.front().size(), 3);
        for (const auto& cells : rows_)
            for (std::size_t i = 0; i < cells.size(); ++i) width[i] = std::max(width[i], letters(cells[i]));
        std::string out;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            for (std::size_t i = 0; i < rows_[r].size(); ++i)
                out += "| " + rows_[r][i] + std::string(width[i] - letters(rows_[r][i]) + 1, ' ');
            out += "|\n";
            if (r > 0) continue;
            for (const std::size_t w : width) out += "|" + std::string(w + 2, '-');
            out += "|\n";
        }
        return out;
    }

private:
    /// Code points of UTF-8 text.
    static std::size_t letters(const std::string& text) {
        return static_cast<std::size_t>(
            std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
    }

    std::vector<std::vector<std::string>> rows_;
};

}  // namespace pellucid::bench
