// SPDX-License-Identifier: MIT
// A compute pass rebuilds, from the primitive id and the pixel alone, the surface that the G-buffer pass stored.
#include <glm/trigonometric.hpp>
#include <pellucid/reference/gbuffer.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/scene/framing.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/mipmap.hpp>
#include <set>
#include "support/assets.hpp"
#include "support/gpu.hpp"

namespace {

using namespace pellucid;

const char* const models[] = {"AlphaBlendModeTest/AlphaBlendModeTest.glb",
                              "Avocado/Avocado.gltf",
                              "BoxVertexColors/BoxVertexColors.glb",
                              "Cube/Cube.gltf",
                              "EmissiveStrengthTest/EmissiveStrengthTest.glb",
                              "NegativeScaleTest/NegativeScaleTest.glb",
                              "NormalTangentMirrorTest/NormalTangentMirrorTest.glb",
                              "OrientationTest/OrientationTest.glb",
                              "Suzanne/Suzanne.gltf",
                              "TextureEncodingTest/TextureEncodingTest.glb",
                              "TextureSettingsTest/TextureSettingsTest.glb",
                              "TextureTransformTest/TextureTransformTest.gltf",
                              "VertexColorTest/VertexColorTest.glb"};

/// [degree] between two stored normals.
double angle_between(std::uint32_t a, std::uint32_t b) {
    const glm::dvec3 u = reference::direction_from_oct32<double>(a), v = reference::direction_from_oct32<double>(b);
    return glm::degrees(std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)));
}

/// [degree] the largest angle between neighbouring texels of a normal map, over all its levels.
double texel_contrast(const Image8& map) {
    double contrast = 0;
    for (const Image8& level : make_mipmaps(map, MipContent::data)) {
        auto normal = [&](std::uint32_t x, std::uint32_t y) {
            const std::uint8_t* t = level.texel(x % level.width, y % level.height);
            return glm::normalize(glm::dvec3(t[0], t[1], t[2]) / 127.5 - 1.0);
        };
        for (std::uint32_t y = 0; y < level.height; ++y)
            for (std::uint32_t x = 0; x < level.width; ++x)
                for (const glm::dvec3& other : {normal(x + 1, y), normal(x, y + 1)})
                    contrast = std::max(contrast, std::acos(std::min(glm::dot(normal(x, y), other), 1.0)));
    }
    return glm::degrees(contrast);
}

/// [degree] what a normal may be off by: one code each way (neighbouring octahedral codes are at most 0.0075 degrees
/// apart); 2/256 of the largest step to a neighbouring pixel, as the rasteriser snaps vertices to 1/256 pixel; and
/// 3/256 of the largest step between texels of a normal map, as the sampler's three weights (u, v, level) have 8 bits
/// (inferred; 2/256 left one pixel of one model over).
double normal_tolerance(const Image<std::uint32_t>& normal, const Image<float>& depth, std::uint32_t x, std::uint32_t y,
                        double contrast) {
    double step = 0;
    auto look = [&](std::uint32_t u, std::uint32_t v) {
        if (u >= normal.width || v >= normal.height || *depth.texel(u, v) == 0) return;
        step = std::max(step, angle_between(*normal.texel(x, y), *normal.texel(u, v)));
    };
    look(x - 1, y), look(x + 1, y), look(x, y - 1), look(x, y + 1);
    return 0.0075 + step * 2 / 256 + contrast * 3 / 256;
}

/// How far a rebuilt texel may be from the stored one.
struct Differences {
    std::size_t pixels = 0;
    std::size_t beyond = 0;  ///< pixels where any channel is off by more than its quantisation
    double worst_angle = 0;  ///< [degree]
    int worst_base = 0;      ///< [1/255]
    std::set<std::uint32_t> materials;
};

/// Draws the opaque part of `scene` twice: into a G-buffer and into primitive ids; rebuilds; compares.
template <rhi::Backend B>
Differences rebuild(typename B::Device& device, Scene scene) {
    using D = typename B::Device;
    const RenderSettings settings{.size = {192, 192}, .transparency = Transparency::none, .exact = true};
    const Extent2D size = settings.size;
    const Camera camera = scene.cameras.empty() ? frame_scene(scene, size) : scene.cameras.front();
    const SceneNeeds needs = scene_needs(scene, settings);
    auto gpu = test::must(GpuScene<B>::create(device, scene, settings));

    using enum rhi::TextureUsage;
    std::vector<rhi::Unique<D, rhi::Texture>> owned;
    auto target = [&](rhi::Format format) {
        owned.push_back(test::own(
            device,
            device.make_texture({.size = size, .format = format, .usage = attachment | sampled | copy_source})));
        return owned.back().get();
    };
    GBufferTargets targets{.depth = target(rhi::Format::d32_float), .size = size};
    for (const rhi::Format f : gbuffer_formats(GBufferLayout::compact, needs.emissive_target))
        targets.colors.push_back(target(f));
    const rhi::Texture ids = target(rhi::Format::r32_uint), id_depth = target(rhi::Format::d32_float);
    const auto pass = test::must(GBufferPass<B>::create(
        device, {.emissive = needs.emissive_target, .needs = needs.mask, .culls = gpu.opaque_culls()}));
    CullVariants<B> id_pipelines;
    const rhi::SpecConstant constants[] = {{0, needs.mask}};
    test::must(id_pipelines.create(device,
                                   {.vertex = &shaders::scene_vert,
                                    .fragment = &shaders::test_primitive_id_frag,
                                    .constants = constants,
                                    .scene_group = scene_group_layout(),
                                    .colors = {{.format = rhi::Format::r32_uint}},
                                    .depth = {.format = rhi::Format::d32_float,
                                              .test = true,
                                              .write = true,
                                              .compare = rhi::Compare::greater_equal},
                                    .debug_name = "primitive ids"},
                                   gpu.opaque_culls()));
    const std::uint64_t bytes = std::uint64_t{size.width} * size.height * sizeof(gpu::GBufferTexel);
    const auto texels =
        test::own(device, device.make_buffer({.size = bytes,
                                              .usage = rhi::BufferUsage::storage | rhi::BufferUsage::copy_source,
                                              .debug_name = "rebuilt"}));
    const auto sampler = test::own(
        device, device.make_sampler({.min = rhi::Filter::nearest, .mag = rhi::Filter::nearest, .mipmapped = false}));
    const rhi::GroupLayout layout{{{12, rhi::BindingKind::sampled_texture}, {13, rhi::BindingKind::storage_buffer}}};
    const auto group =
        test::own(device, device.make_group({.layout = layout,
                                             .bindings = {{.binding = 12, .texture = ids, .sampler = sampler},
                                                          {.binding = 13, .buffer = texels}}}));
    const auto rebuild_pipeline =
        test::own(device, device.make_pipeline(rhi::ComputePipelineDesc{.compute = &shaders::test_rebuild_comp,
                                                                        .constants = constants,
                                                                        .pass_group = layout,
                                                                        .scene_group = scene_group_layout(),
                                                                        .push_bytes = 16}));
    test::run(device, [&](auto& cmd) {
        test::must(gpu.begin_frame(cmd, camera, settings));
        const SceneBinding& scene_binding = gpu.binding();
        pass.record(cmd, targets, scene_binding, gpu.opaque());
        rhi::RenderPassDesc id_pass{.colors = {{.texture = ids, .clear_uint = {PELLUCID_NO_PRIMITIVE, 0, 0, 0}}},
                                    .depth = {.texture = id_depth},
                                    .uses = scene_binding.uses,
                                    .size = size,
                                    .name = "ids"};
        id_pass.uses.push_back(rhi::use(scene_binding.indices, rhi::Access::index_read));
        cmd.begin_render(id_pass);
        draw_items<B>(cmd, id_pipelines, scene_binding, gpu.opaque());
        cmd.end_render();
        rhi::Uses uses = scene_binding.uses;
        uses.push_back(rhi::use(ids, rhi::Access::sampled));
        uses.push_back(rhi::use(texels.get(), rhi::Access::storage_write));
        cmd.begin_compute({.uses = uses, .name = "rebuild"});
        cmd.bind_pipeline(rebuild_pipeline);
        cmd.bind_frame(scene_binding.frame, scene_binding.records);
        cmd.bind_group(group);
        cmd.bind_group(scene_binding.group);
        const gpu::uvec4 first{scene_binding.records.first, 0, 0, 0};
        cmd.push(rhi::bytes_of(first));
        cmd.dispatch((size.width + 7) / 8, (size.height + 7) / 8, 1);
        cmd.end_compute();
    });
    const auto rebuilt = test::read<gpu::GBufferTexel>(device, texels.get(), std::size_t{size.width} * size.height);
    const auto depth = test::read<float>(device, targets.depth, size, 1);
    const auto id = test::read<std::uint32_t>(device, ids, size, 1);
    const auto normal = test::read<std::uint32_t>(device, targets.colors[0], size, 1);
    const auto base = test::read<std::uint8_t>(device, targets.colors[1], size, 4);
    const auto material = test::read<std::uint32_t>(device, targets.colors[2], size, 1);

    std::vector<std::uint32_t> ends, owners;  // primitive ranges of the drawn instances
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (scene.materials[mesh.material].alpha_mode == AlphaMode::blend || mesh.indices.empty()) continue;
        ends.push_back((ends.empty() ? 0 : ends.back()) + static_cast<std::uint32_t>(mesh.indices.size() / 3));
        owners.push_back(mesh.material);
    }
    std::vector<double> contrasts;
    for (const Material& m : scene.materials)
        contrasts.push_back(m.normal_texture.used()
                                ? texel_contrast(scene.images[scene.textures[m.normal_texture.texture].image].pixels)
                                : 0.0);
    Differences out;
    for (std::size_t i = 0; i < rebuilt.size(); ++i) {
        REQUIRE((depth.data[i] != 0) == (id.data[i] != PELLUCID_NO_PRIMITIVE));
        if (depth.data[i] == 0) continue;
        ++out.pixels;
        const auto owner = std::upper_bound(ends.begin(), ends.end(), id.data[i]) - ends.begin();
        const std::uint32_t material_of = owners[static_cast<std::size_t>(owner)];
        out.materials.insert(material_of);
        const double angle = angle_between(normal.data[i], rebuilt[i].normal);
        int base_off = 0;
        for (std::size_t c = 0; c < 4; ++c)
            base_off =
                std::max(base_off, std::abs(int(base.data[4 * i + c]) - int(rebuilt[i].base >> (8 * c) & 0xFFu)));
        const int rough_off = std::abs(int(material.data[i] & 0xFFFFu) - int(rebuilt[i].material & 0xFFFFu));
        const int metal_off = std::abs(int(material.data[i] >> 16 & 0xFFu) - int(rebuilt[i].material >> 16 & 0xFFu));
        CHECK(material.data[i] >> 24 == rebuilt[i].material >> 24);
        out.worst_angle = std::max(out.worst_angle, angle);
        out.worst_base = std::max(out.worst_base, base_off);
        const auto x = static_cast<std::uint32_t>(i % size.width), y = static_cast<std::uint32_t>(i / size.width);
        out.beyond += angle > normal_tolerance(normal, depth, x, y, contrasts[material_of]) || base_off > 1 ||
                      metal_off > 1 || rough_off > 257;
    }
    return out;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("primitive: compute rebuilds every surface of real models from primitive ids", "[gpu]",
                        test::Backends) {
    const auto assets = test::assets();
    if (!assets) return;
    auto device = test::make_device<TestType>();
    if (!device) return;
    for (const char* model : models) {
        INFO(model);
        const Differences d = rebuild<TestType>(*device, test::must(load_gltf((*assets / "models" / model).string())));
        std::printf("%s, %s: %zu pixels of %zu materials, %zu beyond quantisation, worst %.4f degrees, %d/255\n",
                    TestType::name, model, d.pixels, d.materials.size(), d.beyond, d.worst_angle, d.worst_base);
        CHECK(d.pixels > 0);
        CHECK(d.beyond == 0);
    }
}
