// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// FLIP once more, for the tests: written from the paper as it stands there, with two-dimensional filters that are
/// normalised as a whole and applied pixel by pixel, formulas in place of matrices, and nothing shared with the
/// library.
#include <algorithm>
#include <array>
#include <cmath>
#include <pellucid/core/image.hpp>
#include <vector>

namespace flip_direct {

using Color = std::array<double, 3>;

/// A two-dimensional filter: weight(x, y), |x|, |y| <= radius.
struct Filter {
    int radius = 0;
    std::vector<double> weights;
    template <class F>
    Filter(int r, const F& f) : radius(r) {
        for (int y = -r; y <= r; ++y)
            for (int x = -r; x <= r; ++x) weights.push_back(f(x, y));
    }
    /// Positive weights add up to 1, negative ones to −1.
    Filter& normalized() {
        double positive = 0, negative = 0;
        for (const double w : weights) w > 0 ? positive += w : negative -= w;
        for (double& w : weights) w /= w > 0 ? positive : negative;
        return *this;
    }
    /// Beyond the border: the nearest pixel.
    double at(const pellucid::Image<double>& plane, int x, int y) const {
        double sum = 0;
        std::size_t i = 0;
        for (int j = -radius; j <= radius; ++j)
            for (int k = -radius; k <= radius; ++k)
                sum +=
                    weights[i++] *
                    *plane.texel(static_cast<std::uint32_t>(std::clamp(x + k, 0, static_cast<int>(plane.width) - 1)),
                                 static_cast<std::uint32_t>(std::clamp(y + j, 0, static_cast<int>(plane.height) - 1)));
        return sum;
    }
};

inline Color xyz(const Color& c) {
    const double d = 24577794;
    return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / d,
            (5226144 * c[0] + 17577620 * c[1] + 1774030 * c[2]) / d,
            (475104 * c[0] + 8788810.0 / 3 * c[1] + 70074185.0 / 3 * c[2]) / d};
}
inline const Color white = xyz({1, 1, 1});

inline double lab_curve(double t) {
    return t > 0.008856451679035631 ? std::pow(t, 1.0 / 3) : 7.787037037037037 * t + 16.0 / 116;
}
inline Color lab_hunt(const Color& rgb) {
    const Color c = xyz(rgb);
    const double x = lab_curve(c[0] / white[0]), y = lab_curve(c[1]), z = lab_curve(c[2] / white[2]);
    const double lightness = 116 * y - 16;
    return {lightness, lightness / 100 * 500 * (x - y), lightness / 100 * 200 * (y - z)};
}
inline double distance(const Color& a, const Color& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}
inline double color_error(const Color& a, const Color& b) {
    const double most = std::pow(distance(lab_hunt({0, 1, 0}), lab_hunt({0, 0, 1})), 0.7);
    const double here = std::pow(distance(lab_hunt(a), lab_hunt(b)), 0.7);
    return here < 0.4 * most ? here / (0.4 * most) * 0.95 : 0.95 + (here - 0.4 * most) / (0.6 * most) * 0.05;
}

/// Solves xyz(rgb) = c by Cramer's rule.
inline Color rgb_of_xyz(const Color& c) {
    const Color r = xyz({1, 0, 0}), g = xyz({0, 1, 0}), b = xyz({0, 0, 1});
    const auto det = [](const Color& p, const Color& q, const Color& s) {
        return p[0] * (q[1] * s[2] - q[2] * s[1]) - q[0] * (p[1] * s[2] - p[2] * s[1]) +
               s[0] * (p[1] * q[2] - p[2] * q[1]);
    };
    const double d = det(r, g, b);
    return {det(c, g, b) / d, det(r, c, b) / d, det(r, g, c) / d};
}

/// LDR-FLIP of linear RGB in [0,1].
inline pellucid::Image<double> error_map(const pellucid::Image<double>& a, const pellucid::Image<double>& b,
                                         double ppd) {
    using Plane = pellucid::Image<double>;
    const double pi = std::acos(-1.0), sigma = 0.5 * 0.082 * ppd;
    const int wide = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    const int narrow = static_cast<int>(std::ceil(3 * sigma));
    const auto bell = [&](double scale, double spread, int x, int y) {
        return scale * std::sqrt(pi / spread) * std::exp(-pi * pi / spread * (x * x + y * y) / (ppd * ppd));
    };
    const Filter luminance = Filter(wide, [&](int x, int y) { return bell(1, 0.0047, x, y); }).normalized();
    const Filter red_green = Filter(wide, [&](int x, int y) { return bell(1, 0.0053, x, y); }).normalized();
    const Filter blue_yellow =
        Filter(wide, [&](int x, int y) { return bell(34.1, 0.04, x, y) + bell(13.5, 0.025, x, y); }).normalized();
    const auto gauss = [&](int x, int y) { return std::exp(-(x * x + y * y) / (2 * sigma * sigma)); };
    const Filter edge_x = Filter(narrow, [&](int x, int y) { return -x * gauss(x, y); }).normalized();
    const Filter edge_y = Filter(narrow, [&](int x, int y) { return -y * gauss(x, y); }).normalized();
    const Filter point_x =
        Filter(narrow, [&](int x, int y) { return (x * x / (sigma * sigma) - 1) * gauss(x, y); }).normalized();
    const Filter point_y =
        Filter(narrow, [&](int x, int y) { return (y * y / (sigma * sigma) - 1) * gauss(x, y); }).normalized();

    struct Opponent {
        Plane y, cx, cz, luminance;
    };
    const auto opponent = [](const Plane& rgb) {
        Opponent o{Plane(rgb.width, rgb.height, 1), Plane(rgb.width, rgb.height, 1), Plane(rgb.width, rgb.height, 1),
                   Plane(rgb.width, rgb.height, 1)};
        for (std::size_t i = 0; i < o.y.data.size(); ++i) {
            const Color c = xyz({rgb.data[3 * i], rgb.data[3 * i + 1], rgb.data[3 * i + 2]});
            o.y.data[i] = 116 * c[1] - 16;
            o.cx.data[i] = 500 * (c[0] / white[0] - c[1]);
            o.cz.data[i] = 200 * (c[1] - c[2] / white[2]);
            o.luminance.data[i] = c[1];
        }
        return o;
    };
    const Opponent oa = opponent(a), ob = opponent(b);
    Plane errors(a.width, a.height, 1);
    for (int y = 0; y < static_cast<int>(a.height); ++y)
        for (int x = 0; x < static_cast<int>(a.width); ++x) {
            const auto color = [&](const Opponent& o) {
                const double yy = (luminance.at(o.y, x, y) + 16) / 116;
                Color rgb = rgb_of_xyz({(yy + red_green.at(o.cx, x, y) / 500) * white[0], yy,
                                        (yy - blue_yellow.at(o.cz, x, y) / 200) * white[2]});
                for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
                return rgb;
            };
            const auto feature = [&](const Filter& fx, const Filter& fy) {
                return std::abs(std::hypot(fx.at(oa.luminance, x, y), fy.at(oa.luminance, x, y)) -
                                std::hypot(fx.at(ob.luminance, x, y), fy.at(ob.luminance, x, y)));
            };
            const double features = std::max(feature(edge_x, edge_y), feature(point_x, point_y));
            *errors.texel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) =
                std::pow(color_error(color(oa), color(ob)), 1 - std::pow(features / std::sqrt(2.0), 0.5));
        }
    return errors;
}

/// The curve of HDR-FLIP: Narkowicz's numbers, of 0.6 times the light.
inline double aces(double light) {
    const double x = 0.6 * light;
    return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

}  // namespace flip_direct
