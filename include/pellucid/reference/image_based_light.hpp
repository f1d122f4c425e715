// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a surface returns of light from all around, by the split sum (Karis 2013) in double: prefiltered light times
/// the lobe's directional albedo, diffuse light times what is left,
///   radiance = E_1(N·V) P(R, roughness) + (several + (1 − E_1 − several)(1 − metallic) base) P(N, 1),
/// with E_1 = F0 scale + bias, several = F_ms loss of conserving.hpp (0 for other models: they have no second lobe),
/// P(d, r) the light prefiltered by the GGX lobe of roughness r around d with N = V = R.  P(N, 1) is E(N)/π.
/// For an environment of one radiance this is exact; for others it is what real-time renderers mean by image-based
/// light, not the integral of the model over the environment.
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <pellucid/reference/conserving.hpp>
#include <pellucid/reference/brdf.hpp>
#include <pellucid/reference/cube_map.hpp>
#include <pellucid/scene/environment.hpp>

namespace pellucid::inline v0_1::reference {

/// Light from all around, ready to be asked.
class EnvironmentLight {
public:
    /// Precondition: `check_environment(environment)`, and a kind other than none.
    explicit EnvironmentLight(const Environment& environment) : environment_(environment) {
        if (environment.kind != EnvironmentKind::picture) return;
        const ImageF& picture = *environment.picture;
        std::uint32_t size = 64;
        while (size * 2 <= picture.height / 2 && size < 256) size *= 2;
        cube_ = make_cube_chain([&](glm::dvec3 d) { return environment_radiance(picture, d); }, size);
    }

    /// The light around `direction` (unit, world), prefiltered by a lobe of `roughness` in [0,1].  Of a picture: a sum
    /// over a cube map of up to 256² texels a face, so a lobe narrower than a texel (roughness below 0.06) is that
    /// wide.
    [[nodiscard]] glm::dvec3 operator()(glm::dvec3 direction, double roughness) const {
        if (environment_.kind == EnvironmentKind::sky) return prefiltered_sky(environment_.sky, direction.y, roughness);
        if (roughness == 0) return environment_radiance(*environment_.picture, direction);
        const double alpha = std::max(roughness * roughness, 0.0036);
        return prefiltered_radiance(*cube_, prefilter_level(*cube_, alpha), direction, alpha);
    }
    /// Whether it is seen where nothing else is.
    [[nodiscard]] bool backdrop() const noexcept { return environment_.backdrop; }

private:
    Environment environment_;
    std::optional<CubeChain> cube_;
};

/// Before occlusion.  `to_eye` is unit.
[[nodiscard]] inline glm::dvec3 environment_response(const Surface<double>& surface, glm::dvec3 to_eye,
                                                     const EnvironmentLight& light, BrdfModel model,
                                                     const DfgTable& table = reference_dfg_table()) {
    const double n_v = glm::dot(surface.normal, to_eye), mu = std::min(std::abs(n_v), 1.0);
    const glm::dvec3 f0 = normal_reflectance(surface);
    const Dfg<double> eye = table.lookup(mu, surface.roughness), average = table.average(surface.roughness);
    const glm::dvec3 between = model == BrdfModel::conserving ? multiple_scattering(f0, average) : glm::dvec3(0.0);
    const glm::dvec3 single = conserving_albedo(f0, glm::dvec3(0.0), eye), several = between * eye.loss;
    const glm::dvec3 rest = glm::max(1.0 - single - several, 0.0) * surface.base_color * (1 - surface.metallic);
    const glm::dvec3 mirrored = glm::normalize(2 * n_v * surface.normal - to_eye);
    return single * light(mirrored, surface.roughness) + (several + rest) * light(surface.normal, 1.0);
}

}  // namespace pellucid::inline v0_1::reference
