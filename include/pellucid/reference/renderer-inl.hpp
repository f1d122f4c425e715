// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of renderer.hpp: triangles are binned by screen tile, tiles are drawn in parallel, and each visible
/// fragment is shaded once.
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <algorithm>
#include <memory>
#include <mutex>
#include <new>
#include <pellucid/reference/detail/fragments.hpp>
#include <pellucid/reference/detail/shadow_rays.hpp>
#include <pellucid/reference/detail/tiles.hpp>
#include <pellucid/reference/renderer.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pellucid::inline v0_1::reference {
namespace detail {

/// Runs `work` with the threads that the options allow.
template <class F>
void with_threads(std::uint32_t threads, F&& work) {
    const int all = oneapi::tbb::info::default_concurrency();
    oneapi::tbb::task_arena arena(threads == 0 || std::cmp_greater(threads, all) ? all : static_cast<int>(threads));
    arena.execute(work);
}

/// Makes the levels of every texture that a drawn material uses, and points the materials at them.
inline void bind_materials(const Scene& scene, Prepared& out) {
    out.color_textures.resize(scene.textures.size());
    out.data_textures.resize(scene.textures.size());
    struct Wanted {
        std::unique_ptr<SampledTexture>* place;
        const SceneTexture* source;
        bool srgb;
    };
    std::vector<Wanted> wanted;
    const auto use = [&](const TextureRef& ref, bool srgb) {
        TextureUse made{.texture = nullptr, .ref = ref};
        if (!ref.used() || scene.textures[ref.texture].image == no_index) return made;
        std::unique_ptr<SampledTexture>& place = (srgb ? out.color_textures : out.data_textures)[ref.texture];
        if (!place) {
            place = std::make_unique<SampledTexture>();
            wanted.push_back({&place, &scene.textures[ref.texture], srgb});
        }
        made.texture = place.get();
        return made;
    };
    for (const Draw& draw : out.draws) {
        const Material& m = scene.materials[draw.mesh->material];
        out.materials[draw.mesh->material] = {.factors = m,
                                              .base_color = use(m.base_color_texture, true),
                                              .metallic_roughness = use(m.metallic_roughness_texture, false),
                                              .normal = use(m.normal_texture, false),
                                              .occlusion = use(m.occlusion_texture, false),
                                              .emissive = use(m.emissive_texture, true)};
    }
    oneapi::tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
        const Wanted& w = wanted[i];
        **w.place = sampled_texture(scene.images[w.source->image].pixels, w.source->sampler, w.srgb);
    });
}

/// Everything but the pixels.  `scene` and `options` must outlive the result.
inline Result<Prepared> prepare(const Scene& scene, const Camera& camera, const RenderOptions& options) {
    PELLUCID_CHECK(check_options(options));
    PELLUCID_CHECK(check_camera(camera));
    Prepared out;
    out.camera = camera;
    out.clip = clip_from_view(camera, options.size);
    out.options = &options;
    PELLUCID_CHECK(list_draws(scene, out));
    bind_materials(scene, out);
    PELLUCID_CHECK(check_environment(options.environment));
    if (options.environment.kind != EnvironmentKind::none) out.environment.emplace(options.environment);
    if (options.shadows) out.casters = caster_tree(out);
    return out;
}

/// What is seen where nothing is, at the centre of pixel (x, y).
inline glm::dvec3 behind(const Prepared& prepared, std::int64_t x, std::int64_t y) {
    const RenderOptions& options = *prepared.options;
    if (!prepared.environment || !prepared.environment->backdrop()) return options.background;
    const Camera& camera = prepared.camera;
    if (camera.projection == Projection::orthographic) return (*prepared.environment)(-prepared.backward(), 0);
    const ClipFromView& clip = prepared.clip;
    const glm::dvec2 ndc(2 * (static_cast<double>(x) + 0.5) / options.size.width - 1,
                         1 - 2 * (static_cast<double>(y) + 0.5) / options.size.height);
    const glm::dvec3 ray((ndc.x - clip.ox) / clip.sx, (ndc.y - clip.oy) / clip.sy, -1);  // w = 1 there
    return (*prepared.environment)(glm::normalize(glm::dmat3(camera.world_from_view) * ray), 0);
}

inline void draw_tile(const Prepared& prepared, const PixelRect& rect, std::span<const std::uint32_t> primitives,
                      Picture& out) {
    const RenderOptions& options = *prepared.options;
    PixelHits hits;
    find_hits(prepared, rect, primitives, 0, 0, hits);
    std::uint32_t pixel = 0;
    for (std::int32_t y = rect.top; y < rect.bottom; ++y)
        for (std::int32_t x = rect.left; x < rect.right; ++x, ++pixel) {
            Composite composite;
            std::uint32_t layers = 0;
            for (const Hit& hit : hits.of(pixel)) {
                const Fragment fragment = shade(prepared, hit, x, y);
                composite.put_behind(fragment.premultiplied, fragment.alpha);
                layers += fragment.opaque ? 0 : 1;
            }
            const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
            const glm::dvec3 radiance = composite.over(behind(prepared, x, y));
            for (int c = 0; c < 3; ++c) out.radiance.texel(column, row)[c] = static_cast<float>(radiance[c]);
            *out.layers.texel(column, row) = layers;
        }
    if (!options.stability) return;
    const auto unstable = [&](std::int32_t x, std::int32_t y) {
        *out.stable.texel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) = 0;
    };
    pixel = 0;
    for (std::int32_t y = rect.top; y < rect.bottom; ++y)
        for (std::int32_t x = rect.left; x < rect.right; ++x, ++pixel)
            if (order_in_doubt(prepared, hits.of(pixel), x, y)) unstable(x, y);
    PixelHits moved;
    for (int i = 0; i < 9; ++i) {
        const int right = i % 3 - 1, down = i / 3 - 1;
        if (right == 0 && down == 0) continue;
        find_hits(prepared, rect, primitives, right, down, moved);
        pixel = 0;
        for (std::int32_t y = rect.top; y < rect.bottom; ++y)
            for (std::int32_t x = rect.left; x < rect.right; ++x, ++pixel) {
                const auto a = hits.of(pixel), b = moved.of(pixel);
                const auto same = [](const Hit& p, const Hit& q) { return p.primitive == q.primitive; };
                if (!std::equal(a.begin(), a.end(), b.begin(), b.end(), same)) unstable(x, y);
            }
    }
}

/// The share of a number of equal steps that is done, told as it rises.
class Progress {
public:
    Progress(const RenderOptions& options, std::size_t steps) : options_(options), steps_(steps) {}
    void step() {
        if (!options_.progress) return;
        const std::lock_guard lock(mutex_);
        ++done_;
        options_.progress(options_.user, static_cast<double>(done_) / static_cast<double>(steps_));
    }

private:
    const RenderOptions& options_;
    std::size_t steps_, done_ = 0;
    std::mutex mutex_;
};

inline Error out_of_memory(const RenderOptions& options) {
    return {Errc::out_of_memory, "memory ran out while the reference drew " + std::to_string(options.size.width) + "x" +
                                     std::to_string(options.size.height) +
                                     " pixels; ask for a smaller picture, or draw a simpler scene"};
}

}  // namespace detail

PELLUCID_INLINE Result<Picture> render(const Scene& scene, const Camera& camera, const RenderOptions& options) try {
    Result<Picture> result{Picture{}};
    detail::with_threads(options.threads, [&] {
        const Result<detail::Prepared> prepared = detail::prepare(scene, camera, options);
        if (!prepared) {
            result = prepared.error();
            return;
        }
        const auto [width, height] = options.size;
        Picture& picture = *result;
        picture.radiance = ImageF(width, height, 3);
        picture.layers = Image<std::uint32_t>(width, height, 1);
        if (options.stability) {
            picture.stable = Image8(width, height, 1);
            std::fill(picture.stable.data.begin(), picture.stable.data.end(), std::uint8_t{255});
        }
        const detail::Tiles tiles = detail::make_tiles(*prepared);
        detail::Progress progress(options, tiles.count());
        std::atomic<bool> complete = true;
        oneapi::tbb::parallel_for(std::size_t{0}, tiles.count(), [&](std::size_t tile) {
            if (options.stop && options.stop->load(std::memory_order_relaxed)) {
                complete = false;
                return;
            }
            detail::draw_tile(*prepared, tiles.rect(tile, options.size), tiles.of(tile), picture);
            progress.step();
        });
        picture.complete = complete;
    });
    return result;
} catch (const std::bad_alloc&) {
    return detail::out_of_memory(options);
}

PELLUCID_INLINE Result<std::vector<Fragment>> fragments_at(const Scene& scene, const Camera& camera,
                                                           const RenderOptions& options, std::uint32_t x,
                                                           std::uint32_t y) try {
    if (x >= options.size.width || y >= options.size.height)
        return Error{Errc::invalid_argument,
                     "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is outside of the picture of " +
                         std::to_string(options.size.width) + "x" + std::to_string(options.size.height)};
    Result<std::vector<Fragment>> result{std::vector<Fragment>{}};
    detail::with_threads(options.threads, [&] {
        const Result<detail::Prepared> prepared = detail::prepare(scene, camera, options);
        if (!prepared) {
            result = prepared.error();
            return;
        }
        const auto left = static_cast<std::int32_t>(x), top = static_cast<std::int32_t>(y);
        const PixelRect pixel{left, top, left + 1, top + 1};
        const std::vector<PixelRect> bounds = detail::find_bounds(*prepared);
        std::vector<std::uint32_t> primitives;
        for (std::uint32_t p = 0; p < bounds.size(); ++p)
            if (!intersection(bounds[p], pixel).empty()) primitives.push_back(p);
        detail::PixelHits hits;
        detail::find_hits(*prepared, pixel, primitives, 0, 0, hits);
        for (const detail::Hit& hit : hits.hits) result->push_back(detail::shade(*prepared, hit, x, y));
    });
    return result;
} catch (const std::bad_alloc&) {
    return detail::out_of_memory(options);
}

}  // namespace pellucid::inline v0_1::reference
