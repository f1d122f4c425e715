// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Pixels of translucent layers in double, how far number formats may move a method from them, and frames with the
/// counts of their fragments.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <pellucid/measure/image_error.hpp>
#include <pellucid/measure/order_variance.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <span>
#include <string>
#include <vector>
#include "support/devices.hpp"
#include "support/methods.hpp"

namespace pellucid::test {

/// One fragment of a pixel, as it composites.
struct Layer {
    glm::dvec3 color{0, 0, 0};  ///< premultiplied radiance
    double alpha = 0;
};
[[nodiscard]] inline Layer straight(const glm::vec4& color) {
    const glm::dvec4 c(color);
    return {glm::dvec3(c) * c.a, c.a};
}
[[nodiscard]] inline Layer glow(const glm::vec3& color) {
    return {glm::dvec3(color), 0};
}

/// `layers`, nearest first, over what is behind them: Porter and Duff's operator from the back, c + (1 - a) behind.
[[nodiscard]] inline glm::dvec3 over(std::span<const Layer> layers, glm::dvec3 behind) {
    for (std::size_t i = layers.size(); i-- > 0;) behind = layers[i].color + (1 - layers[i].alpha) * behind;
    return behind;
}

/// The most that a picture holds, in binary16; more becomes this.
inline constexpr glm::dvec3 most_radiance{65504};

/// What the values of a pixel may be.
struct Window {
    glm::dvec3 lower{0, 0, 0}, upper{0, 0, 0};
    [[nodiscard]] bool holds(const float* texel) const {
        for (int c = 0; c < 3; ++c)
            if (!(texel[c] >= lower[c] && texel[c] <= upper[c])) return false;
        return true;
    }
};

/// What a method keeps of a fragment until it composites it; see `kept_by`.
enum class Kept : std::uint8_t {
    nothing,  ///< it composites as it shades
    colors,   ///< FragmentContent::colors: premultiplied colour and alpha
    surfaces  ///< FragmentContent::surfaces: radiance and alpha, multiplied afterwards
};

/// Methods whose last step is a blend into the picture; others read it and write it.
[[nodiscard]] constexpr bool blends_over_picture(Transparency method) {
    return method == Transparency::peel || method == Transparency::dual_peel;
}

/// Largest and least result of `method` for these layers, nearest first.  Everything is >= 0, so both ends come from
/// the ends of what each operation may give, u = 2^-24 being half a unit in the last place of binary32:
///   shading: factors, interpolated vertex colours and alpha are multiplied, (1 ± 8u); alpha itself (1 ± 4u);
///   colours are kept as binary16, to nearest: (1 ± 2^-11), and below 2^-14, where it has no more digits, a unit of
///     2^-24; alpha as the nearest of 524280 steps, which is known; to the step and back to float it rounds, (1 ± 4u);
///   surfaces: the same for radiance, and the alpha that multiplies it moves the product as far;
///   each layer: C + T c and T (1 - a) are two operations each, (1 ± 2u); dual_peel keeps 1 - T instead of T, which
///     rounds by up to u three times a layer, whatever T is;
///   the end: C + T behind, two operations; then binary16, limited to 65504: toward zero on software drivers, to a
///     neighbour elsewhere, a unit being 2^-10 of the value or 2^-24.  Where the fixed function blends into binary16,
///     hardware may hold what it blends in that format too (Vulkan asks for the target's precision, no more): C and T
///     lose a unit each before (seen on NVIDIA H100).
/// `behind` must be held by binary16.
[[nodiscard]] inline Window window(std::span<const Layer> layers, const glm::dvec3& behind, Transparency method,
                                   Kept kept, bool software) {
    constexpr double u = 0x1p-24, alpha_steps = 255 * 2056;
    const bool stored = kept != Kept::nothing;
    const double rounds = method == Transparency::dual_peel ? 3 * u : 0.0;
    Window w;
    double least = 1, most = 1;  // T
    for (const Layer& layer : layers) {
        double moved = 8 * u * layer.alpha;
        if (stored) moved += std::abs(std::round(layer.alpha * alpha_steps) / alpha_steps - layer.alpha);
        double relative = 8 * u + (stored ? 0x1p-11 : 0.0);
        if (kept == Kept::surfaces && layer.alpha > 0) relative += moved / layer.alpha;
        const glm::dvec3 wide = layer.color * relative + (stored ? 0x1p-24 : 0.0);
        w.lower = (w.lower + least * glm::max(layer.color - wide, glm::dvec3(0))) * (1 - 2 * u);
        w.upper = (w.upper + most * (layer.color + wide)) * (1 + 2 * u);
        if (layer.alpha != 0 && layer.alpha != 1) {  // by these T is multiplied exactly
            least *= (1 - std::min(1.0, layer.alpha + moved)) * (1 - 2 * u);
            most *= (1 - std::max(0.0, layer.alpha - moved)) * (1 + 2 * u);
        } else {
            least *= 1 - layer.alpha;
            most *= 1 - layer.alpha;
        }
        least = std::max(0.0, least - rounds);
        most += rounds;
    }
    w.lower = (w.lower + least * behind) * (1 - 2 * u);
    w.upper = (w.upper + most * behind) * (1 + 2 * u);
    if (!software && blends_over_picture(method)) {
        w.lower = w.lower * (1 - 0x1p-10) - 0x1p-24;
        w.upper = w.upper * (1 + 0x1p-10) + 0x1p-24;
    }
    w.lower = w.lower * (1 - 0x1p-10) - 0x1p-24;
    if (!software) w.upper = w.upper * (1 + 0x1p-10) + 0x1p-24;
    return {glm::min(w.lower, most_radiance), glm::min(w.upper, most_radiance)};
}

/// A scene of which every pixel is known.
struct KnownPixel {
    std::vector<Layer> layers;     ///< nearest first, as they must be composited
    glm::dvec3 behind{0, 0, 0};    ///< what is opaque, or the background; held by binary16
    glm::dvec3 radiance{0, 0, 0};  ///< the answer, by a formula of the test
};
struct KnownScene {
    static constexpr std::size_t unknown = ~std::size_t{0};
    std::string name;
    Scene scene;
    Camera camera;
    RenderSettings settings;  ///< size and background; nothing else
    std::vector<KnownPixel> pixels;
    std::function<std::size_t(std::uint32_t x, std::uint32_t y)> at;  ///< index into `pixels`, or unknown
};

[[nodiscard]] inline Kept kept_by(Transparency method, const KnownScene& known) {
    if (method == Transparency::interleaved) return Kept::surfaces;
    if (method != Transparency::abuffer) return Kept::nothing;
    RenderSettings settings = known.settings;
    settings.transparency = method;
    // Light may fall on something, or the G-buffer is kept: then the A-buffer lights later.
    return scene_needs(known.scene, settings).has(PELLUCID_NEED_NORMALS) ? Kept::surfaces : Kept::colors;
}

/// A pixel whose answer needs no formula of its own.
[[nodiscard]] inline KnownPixel known_pixel(std::vector<Layer> nearest_first, const glm::dvec3& behind = {0, 0, 0}) {
    const glm::dvec3 radiance = over(nearest_first, behind);
    return {std::move(nearest_first), behind, radiance};
}

/// One frame of a method.
struct Composited {
    ImageF hdr;
    Image8 display;
    Image<std::uint32_t> counted;     ///< fragments in front of what is opaque
    Image<std::uint32_t> composited;  ///< of them; empty unless settings.audit
};
template <rhi::Backend B>
[[nodiscard]] Composited composite(typename B::Device& device, const Scene& scene, const Camera& camera,
                                   const RenderSettings& settings) {
    const auto renderer = must(Renderer<B>::create(device, scene, settings));
    (void)must(renderer->render(camera));
    Composited out{must(renderer->read_hdr()), must(renderer->read_display()), {}, {}};
    if (settings.audit) out.composited = must(renderer->read_composited());
    out.counted = must(renderer->count_layers());
    return out;
}
template <rhi::Backend B>
[[nodiscard]] Composited composite(typename B::Device& device, const KnownScene& known, Transparency method,
                                   bool audit = false) {
    RenderSettings settings = known.settings;
    settings.transparency = method;
    settings.audit = audit;
    return composite<B>(device, known.scene, known.camera, settings);
}

/// How a picture stands to what is known of it.
struct Verdict {
    std::size_t pixels = 0, outside = 0;  ///< judged; of them out of their window
    double worst = 0;                     ///< largest error over max(1, answer)
    std::string first;                    ///< the first pixel that is outside
};
[[nodiscard]] inline std::string to_text(const float* t) {
    return "(" + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) + ")";
}
[[nodiscard]] inline std::string to_text(const glm::dvec3& v) {
    return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}
[[nodiscard]] inline Verdict judge(const ImageF& hdr, const KnownScene& known, Transparency method, bool software) {
    const Kept kept = kept_by(method, known);
    std::vector<Window> windows;
    for (const KnownPixel& p : known.pixels) windows.push_back(window(p.layers, p.behind, method, kept, software));
    Verdict out;
    for (std::uint32_t y = 0; y < hdr.height; ++y)
        for (std::uint32_t x = 0; x < hdr.width; ++x) {
            const std::size_t which = known.at(x, y);
            if (which == KnownScene::unknown) continue;
            const float* got = hdr.texel(x, y);
            const glm::dvec3 wanted = glm::min(known.pixels[which].radiance, most_radiance);
            ++out.pixels;
            for (int c = 0; c < 3; ++c)
                out.worst = std::max(out.worst, std::abs(got[c] - wanted[c]) / std::max(1.0, wanted[c]));
            if (windows[which].holds(got) && got[3] == 1.0f) continue;
            if (out.outside++ == 0)
                out.first = "pixel (" + std::to_string(x) + ", " + std::to_string(y) + "): " + to_text(got) +
                            " instead of " + to_text(wanted) + ", which may be " + to_text(windows[which].lower) +
                            " to " + to_text(windows[which].upper);
        }
    return out;
}

/// Values that differ.
template <class T>
[[nodiscard]] std::size_t different(const Image<T>& a, const Image<T>& b) {
    REQUIRE(a.data.size() == b.data.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) count += a.data[i] != b.data[i];
    return count;
}

/// Pixels of `counts` that have another number than `wanted(x, y)`.
template <class F>
[[nodiscard]] std::size_t miscounted(const Image<std::uint32_t>& counts, F&& wanted) {
    std::size_t wrong = 0;
    for (std::uint32_t y = 0; y < counts.height; ++y)
        for (std::uint32_t x = 0; x < counts.width; ++x) wrong += *counts.texel(x, y) != wanted(x, y);
    return wrong;
}

/// Judges a picture of `known`, prints and checks it.
inline void check_picture(const ImageF& hdr, const KnownScene& known, Transparency method, const char* backend,
                          bool software) {
    const Verdict verdict = judge(hdr, known, method, software);
    INFO(known.name << ", " << name(method) << " on " << backend << ": " << verdict.first);
    std::printf("%s, %s on %s: %zu of %zu pixels outside, worst error %.3g\n", known.name.c_str(), name(method),
                backend, verdict.outside, verdict.pixels, verdict.worst);
    CHECK(verdict.pixels > 0);
    CHECK(verdict.outside == 0);
}

/// `method` draws `known` within its window.
template <rhi::Backend B>
void check_within(typename B::Device& device, const KnownScene& known, Transparency method) {
    RenderSettings settings = known.settings;
    settings.transparency = method;
    const auto renderer = must(Renderer<B>::create(device, known.scene, settings));
    (void)must(renderer->render(known.camera));
    check_picture(must(renderer->read_hdr()), known, method, B::name, device.info().software);
}

/// What an audited frame says of `known`: of fragments, that none is missing; of lights, one a pixel at least.
inline void check_audit(const Composited& audited, const KnownScene& known, Transparency method, const char* backend) {
    INFO(known.name << ", " << name(method) << " on " << backend);
    const auto wanted = [&](std::uint32_t x, std::uint32_t y) {
        const std::size_t which = known.at(x, y);
        return which == KnownScene::unknown ? *audited.counted.texel(x, y)
                                            : static_cast<std::uint32_t>(known.pixels[which].layers.size());
    };
    CHECK(miscounted(audited.counted, wanted) == 0);
    if (facts(method).audit == Audit::fragments) CHECK(different(audited.composited, audited.counted) == 0);
    if (facts(method).audit == Audit::lights) {
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < audited.counted.data.size(); ++i) {
            const std::uint32_t lights = audited.composited.data[i], layers = audited.counted.data[i];
            wrong += lights > layers || (lights == 0) != (layers == 0);
        }
        CHECK(wrong == 0);
    }
}

/// The exact methods draw `known`, on which no light falls, within their windows and composite every fragment there
/// is; the audit, which goes on where nothing can be seen any more, changes no bit.
template <rhi::Backend B>
void check_exact(typename B::Device& device, const KnownScene& known,
                 const std::vector<Transparency>& methods = methods_exact(Exactness::without_light)) {
    for (const Transparency method : methods) {
        const Composited audited = composite<B>(device, known, method, true);
        check_picture(audited.hdr, known, method, B::name, device.info().software);
        check_audit(audited, known, method, B::name);
        if (facts(method).audit != Audit::fragments) continue;  // the audit is no other walk
        const Composited plain = composite<B>(device, known, method);
        INFO(known.name << ", " << name(method) << " on " << B::name);
        CHECK(different(plain.hdr, audited.hdr) == 0);
        CHECK(different(plain.counted, audited.counted) == 0);
    }
}

/// The same of the A-buffer where light may fall, so that it keeps surfaces instead of colours: something opaque is in
/// the scene, out of sight.
template <rhi::Backend B>
void check_as_if_lit(typename B::Device& device, KnownScene known) {
    known.name += ", as if lit";
    Mesh mesh = known.scene.meshes.front();
    for (glm::vec3& p : mesh.positions) p.x += 100;
    update_bounds(mesh);
    mesh.material = static_cast<std::uint32_t>(known.scene.materials.size());
    known.scene.materials.push_back({});
    known.scene.instances.push_back({static_cast<std::uint32_t>(known.scene.meshes.size()), glm::dmat4(1)});
    known.scene.meshes.push_back(std::move(mesh));
    REQUIRE(kept_by(Transparency::abuffer, known) == Kept::surfaces);
    const Composited audited = composite<B>(device, known, Transparency::abuffer, true);
    check_picture(audited.hdr, known, Transparency::abuffer, B::name, device.info().software);
    check_audit(audited, known, Transparency::abuffer, B::name);
}

/// Both backends draw the same bits of radiance with exact arithmetic.
inline void check_backends_agree([[maybe_unused]] std::span<const KnownScene> scenes) {
#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
    const auto vulkan = make_device<Vulkan>();
    const auto opengl = make_device<OpenGL>();
    if (!vulkan || !opengl) return;
    for (const KnownScene& known : scenes)
        for (const Transparency method : methods_exact(Exactness::yes)) {
            RenderSettings settings = known.settings;
            settings.transparency = method;
            settings.exact = true;
            const Composited a = composite<Vulkan>(*vulkan, known.scene, known.camera, settings);
            const Composited b = composite<OpenGL>(*opengl, known.scene, known.camera, settings);
            const auto hdr = must(measure::image_error(a.hdr, b.hdr));
            INFO(known.name << ", " << name(method));
            std::printf("%s, %s: %zu of %zu pixels differ between Vulkan and OpenGL\n", known.name.c_str(),
                        name(method), static_cast<std::size_t>(hdr.different_pixels),
                        static_cast<std::size_t>(hdr.pixels));
            CHECK(hdr.bit_equal());
            CHECK(different(a.counted, b.counted) == 0);
            CHECK(must(measure::image_error(a.display, b.display)).max <= 1);
        }
#endif
}

}  // namespace pellucid::test
