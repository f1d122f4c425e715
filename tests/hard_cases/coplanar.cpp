// SPDX-License-Identifier: MIT
// Fragments of equal depth, bit by bit: the later primitive is in front, and translucent ones are in front of opaque
// ones.  One is never lost and never composited twice.
#include <algorithm>
#include "hard_cases/check_known.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

/// Sheet i of any number: colours and alphas k/255, all different.
glm::vec4 color_of(std::size_t i) {
    const auto code = [](std::size_t k) { return static_cast<float>(k % 256) / 255.0f; };
    return {code(20 + 37 * i), code(250 + 91 * i), code(130 + 53 * i), code(40 + 11 * (i % 16))};
}
Layer layer_of(std::size_t i) {
    return straight(color_of(i));
}

/// `numbers` of sheets in the order they are drawn in, all in one slot.
std::vector<Layer> last_first(const std::vector<std::size_t>& numbers) {
    std::vector<Layer> layers;
    for (auto i = numbers.rbegin(); i != numbers.rend(); ++i) layers.push_back(layer_of(*i));
    return layers;
}

/// All `numbers` as triangles of one mesh.
void add_as_one_mesh(Patches& patches, std::size_t patch, std::uint32_t slot, const std::vector<std::size_t>& numbers) {
    const std::uint32_t instance = patches.add(patch, slot, flat({1, 1, 1, 1}, AlphaMode::blend));
    Mesh& mesh = patches.scene().meshes[patches.scene().instances[instance].mesh];
    const Mesh one = mesh;
    mesh.indices.clear();
    mesh.positions.clear();
    mesh.normals.clear();
    for (const std::size_t n : numbers) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const std::uint32_t i : one.indices) mesh.indices.push_back(first + i);
        mesh.positions.insert(mesh.positions.end(), one.positions.begin(), one.positions.end());
        mesh.normals.insert(mesh.normals.end(), one.normals.begin(), one.normals.end());
        mesh.colors.insert(mesh.colors.end(), 4, color_of(n));
    }
}

/// 2, 8 and 16 sheets in one place, in both orders, as instances and as triangles of one mesh; and three such places
/// behind each other.
KnownScene stacks() {
    Patches patches("coplanar stacks", 4, 4, 8, {0.25f, 0.5f, 0.125f});
    std::size_t patch = 0;
    for (const std::size_t count : {2u, 8u, 16u})
        for (const bool reversed : {false, true})
            for (const bool one_mesh : {false, true}) {
                std::vector<std::size_t> numbers;
                for (std::size_t i = 0; i < count; ++i) numbers.push_back(reversed ? count - 1 - i : i);
                if (one_mesh)
                    add_as_one_mesh(patches, patch, 100, numbers);
                else
                    for (const std::size_t n : numbers) patches.add(patch, 100, color_of(n));
                patches.expect(patch++, last_first(numbers));
            }
    // Drawn as slot 60, 200, 130, 60, 200, …: the order of drawing decides within a slot only.
    for (const bool reversed : {false, true}) {
        std::vector<std::size_t> in_slot[3];
        for (std::size_t i = 0; i < 12; ++i) {
            const std::size_t n = reversed ? 11 - i : i;
            constexpr std::uint32_t slots[] = {60, 200, 130};
            patches.add(patch, slots[n % 3], color_of(n));
            in_slot[n % 3].push_back(n);
        }
        std::vector<Layer> layers;
        for (const std::size_t s : {1u, 2u, 0u})
            for (const Layer& l : last_first(in_slot[s])) layers.push_back(l);
        patches.expect(patch++, std::move(layers));
    }
    // The same sheet eight times: losing or doubling one shows as a wrong power of what it lets through.
    for (std::size_t i = 0; i < 8; ++i) patches.add(patch, 100, {1, 0.5f, 0.25f, 0.25f});
    patches.expect(patch, std::vector<Layer>(8, straight({1, 0.5f, 0.25f, 0.25f})));
    const double through = std::pow(0.75, 8);
    KnownScene known = patches.known();
    known.pixels[patch].radiance =
        (1 - through) * glm::dvec3(1, 0.5, 0.25) + through * glm::dvec3(patches.known().settings.background);
    return known;
}

/// Translucent sheets in the place of an opaque one, an ulp in front of it and an ulp behind it.
KnownScene on_opaque() {
    constexpr std::uint32_t middle = (1u << 23) + 12345;
    const glm::vec4 ground{0.25f, 0.5f, 0.125f, 1};
    Patches patches("on, before and behind something opaque", 4, 2, 24, {1, 1, 1});
    std::size_t patch = 0;
    for (const bool opaque_first : {true, false})
        for (const int ulps : {0, 1, -1}) {
            if (opaque_first) patches.add(patch, middle, flat(ground));
            patches.add(patch, middle + static_cast<std::uint32_t>(ulps), color_of(3));
            if (!opaque_first) patches.add(patch, middle, flat(ground));
            std::vector<Layer> layers;
            if (ulps >= 0) layers.push_back(layer_of(3));
            patches.expect(patch++, known_pixel(layers, glm::dvec3(ground)));
        }
    // Of several in the opaque one's place none is lost; what is behind it stays hidden.
    for (const bool opaque_first : {true, false}) {
        if (opaque_first) patches.add(patch, middle, flat(ground));
        for (std::size_t i = 0; i < 4; ++i) patches.add(patch, middle, color_of(i));
        patches.add(patch, middle - 1, color_of(9));
        if (!opaque_first) patches.add(patch, middle, flat(ground));
        patches.expect(patch++, known_pixel(last_first({0, 1, 2, 3}), glm::dvec3(ground)));
    }
    return patches.known();
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: coplanar sheets in both orders of drawing", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = stacks();
    check_known(known);
    check_exact<TestType>(*device, known);
    check_as_if_lit<TestType>(*device, known);
}

TEMPLATE_LIST_TEST_CASE("hard cases: translucent sheets in the place of an opaque one and an ulp off", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = on_opaque();
    check_known(known);
    check_exact<TestType>(*device, known);
}

TEMPLATE_LIST_TEST_CASE("hard cases: dual peeling keeps one fragment of each depth, of the largest channels", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    KnownScene known;
    {
        // One slot, so that the loss has a closed form: nearest and farthest are the same depth.
        Patches patches("coplanar stacks, what dual peeling leaves", 3, 2, 8, {0.25f, 0.5f, 0.125f});
        std::size_t patch = 0;
        for (const std::size_t count : {2u, 8u, 16u})
            for (const bool reversed : {false, true}) {
                Layer most;
                for (std::size_t i = 0; i < count; ++i) {
                    const std::size_t n = reversed ? count - 1 - i : i;
                    patches.add(patch, 100, color_of(n));
                    most.color = glm::max(most.color, layer_of(n).color);
                    most.alpha = std::max(most.alpha, layer_of(n).alpha);
                }
                patches.expect(patch++, {most});
            }
        known = patches.known();
    }
    check_within<TestType>(*device, known, Transparency::dual_peel);
    // And that is far from the truth.
    const KnownScene truth = stacks();
    const Verdict verdict = judge(composite<TestType>(*device, truth, Transparency::dual_peel).hdr, truth,
                                  Transparency::dual_peel, device->info().software);
    CHECK(verdict.worst > 0.1);
    // Where each depth has one fragment, the place of an opaque surface is no trouble.
    KnownScene single = on_opaque();
    const auto whole = single.at;
    single.at = [whole](std::uint32_t x, std::uint32_t y) {
        const std::size_t which = whole(x, y);
        return which < 6 ? which : KnownScene::unknown;
    };
    check_within<TestType>(*device, single, Transparency::dual_peel);
}

TEST_CASE("hard cases: coplanar fragments are the same bits on both backends", "[gpu]") {
    check_backends_agree(std::vector{stacks(), on_opaque()});
}
