// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A pass of transparency driven by itself: a scene on the GPU, a picture and a depth buffer, and frames in which the
/// test records what it likes.
#include <cstring>
#include <functional>
#include <optional>
#include <pellucid/core/half.hpp>
#include <pellucid/passes/fragment_desc.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/rhi/readback.hpp>
#include "support/devices.hpp"

namespace pellucid::test {

template <rhi::Backend B>
class PassStage {
public:
    using Device = typename B::Device;
    struct Setup {
        Extent2D size = {};
        Transparency method = Transparency::abuffer;  ///< what the scene is laid out for
        glm::vec3 background{0, 0, 0};
        float opaque_depth = 0;  ///< of something opaque over the whole picture, in the background's colour; 0: nothing
        bool exact = false;
    };

    PassStage(Device& device, const Scene& scene, const Setup& setup) : device_(&device), setup_(setup) {
        settings_.size = setup.size;
        settings_.transparency = setup.method;
        settings_.lighting = LightAssignment::loop;  // no pass makes lists here
        settings_.default_light = false;
        settings_.exact = setup.exact;
        needs_ = scene_needs(scene, settings_);
        scene_.emplace(must(GpuScene<B>::create(device, scene, settings_)));
        using enum rhi::TextureUsage;
        hdr_ = target(rhi::Format::rgba16_float, attachment | storage | sampled | copy_source, "hdr");
        depth_ = target(rhi::Format::d32_float, attachment | sampled | copy_source, "depth");
    }

    /// A texture of the picture's size.
    [[nodiscard]] rhi::Unique<Device, rhi::Texture> target(rhi::Format format, rhi::TextureUsage usage,
                                                           const char* name) {
        return {
            *device_,
            must(device_->make_texture({.size = setup_.size, .format = format, .usage = usage, .debug_name = name}))};
    }

    /// One frame over background and opaque depth: `record(frame) -> Result<void>`; waits.  Errors fail the test.
    template <class F>
    void frame(const Camera& camera, F&& record) {
        StageFrame f(*device_, *scene_, camera, settings_);
        must(f.open());
        const glm::vec3 b = setup_.background;
        f.commands().begin_render({.colors = {{.texture = hdr_, .clear = {b.x, b.y, b.z, 1}}},
                                   .depth = {.texture = depth_, .clear = setup_.opaque_depth},
                                   .size = setup_.size,
                                   .name = "stage"});
        f.commands().end_render();
        must(record(static_cast<Frame<B>&>(f)));
        must(device_->wait(must(f.close())));
    }

    /// Values of one channel, or of `channels`.
    template <class T>
    [[nodiscard]] Image<T> read(rhi::Texture texture, rhi::Format format, std::uint32_t channels = 1) {
        const rhi::Texels texels = must(rhi::download<B>(*device_, texture, {.size = setup_.size, .format = format}));
        Image<T> out(setup_.size.width, setup_.size.height, channels);
        REQUIRE(texels.bytes.size() == out.data.size() * sizeof(T));
        std::memcpy(out.data.data(), texels.bytes.data(), texels.bytes.size());
        return out;
    }
    [[nodiscard]] ImageF hdr() {
        const auto halves = read<std::uint16_t>(hdr_, rhi::Format::rgba16_float, 4);
        ImageF out(halves.width, halves.height, 4);
        for (std::size_t i = 0; i < out.data.size(); ++i) out.data[i] = half_to_float(halves.data[i]);
        return out;
    }

    [[nodiscard]] FragmentDesc fragments() const {
        return {.size = setup_.size, .needs = needs_.mask, .culls = scene_->translucent_culls(), .exact = setup_.exact};
    }
    [[nodiscard]] const GpuScene<B>& scene() const { return *scene_; }
    [[nodiscard]] rhi::Texture hdr_target() const { return hdr_; }
    [[nodiscard]] rhi::Texture depth() const { return depth_; }

private:
    class StageFrame final : public Frame<B> {
    public:
        StageFrame(Device& device, GpuScene<B>& scene, const Camera& camera, const RenderSettings& settings)
            : Frame<B>(device), scene_(&scene), camera_(&camera), settings_(&settings) {}

    private:
        Result<void> opened(typename B::Commands& cmd) override {
            return scene_->begin_frame(cmd, *camera_, *settings_);
        }
        GpuScene<B>* scene_;
        const Camera* camera_;
        const RenderSettings* settings_;
    };

    Device* device_;
    Setup setup_;
    RenderSettings settings_;
    SceneNeeds needs_;
    std::optional<GpuScene<B>> scene_;
    rhi::Unique<Device, rhi::Texture> hdr_, depth_;
};

}  // namespace pellucid::test
