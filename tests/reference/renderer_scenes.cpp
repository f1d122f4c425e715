// SPDX-License-Identifier: MIT
// The reference renderer against pictures that another program made: float64 ray casting with its own geometry,
// lighting and compositing (the scenes' README says how).
#include <cstdio>
#include <pellucid/measure/image_error.hpp>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/image_file.hpp>
#include "support/assets.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"

using namespace pellucid;

namespace {

struct Known {
    const char* name;
    glm::dvec3 background;
    double bound;  ///< largest |difference| / max(1, reference) of a stable pixel
};
const Known all_known[] = {{"S1_random_quads", {0.10196078, 0.12156863, 0.16078431}, 1e-6},
                           {"S2_intersecting_planes", {0.2, 0.2, 0.21960784}, 1e-6},
                           {"S3_linked_chain", {0.25098039, 0.25882353, 0.29803922}, 1e-6},
                           {"L1_lit", {0.03921569, 0.03921569, 0.05098039}, 1e-5}};

}  // namespace

TEST_CASE("scenes with an independent reference: the same radiance at every stable pixel", "[cpu]") {
    const auto folder = test::scenes();
    if (!folder) return;
    for (const Known& known : all_known) {
        INFO(known.name);
        const std::string base = (*folder / known.name).string();
        const Scene scene = test::must(load_gltf(base + ".gltf"));
        const reference::Picture picture = test::must(reference::render(
            scene, scene.cameras.at(0),
            {.size = {256, 256}, .background = known.background, .lights = scene.lights, .stability = true}));
        const ImageF expected = test::must(read_pfm(base + ".reference.pfm"));
        const Image8 stable = test::must(read_pgm(base + ".stable.pgm"));
        REQUIRE(expected.width == 256);
        REQUIRE(expected.height == 256);
        REQUIRE(stable.data.size() == picture.stable.data.size());
        double worst = 0, worst_unstable = 0;
        int theirs = 0, ours = 0, both = 0, differ = 0;
        for (std::size_t i = 0; i < stable.data.size(); ++i) {
            double error = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double e = expected.data[3 * i + c];
                error = std::max(error, std::abs(picture.radiance.data[3 * i + c] - e) / std::max(1.0, e));
            }
            double& place = stable.data[i] == 255 ? worst : worst_unstable;
            place = std::max(place, error);
            theirs += stable.data[i] == 255;
            ours += picture.stable.data[i] == 255;
            both += stable.data[i] == 255 && picture.stable.data[i] == 255;
            differ += error > known.bound;
        }
        std::printf(
            "%-22s worst %.2e on stable pixels, %.2e elsewhere (%d pixels above %.0e); stable: theirs %d, ours %d\n",
            known.name, worst, worst_unstable, differ, known.bound, theirs, ours);
        CHECK(worst <= known.bound);
        CHECK(both == ours);  // what no primitive's change touches, no object's does
        CHECK(ours > 62000);
    }
}
