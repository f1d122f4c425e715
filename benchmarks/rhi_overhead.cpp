// SPDX-License-Identifier: MIT
// What the RHI costs: the same frame of many draws through Pellucid and through hand-written API calls, in turn, in one
// process.  Timed: recording (with the wait for a free command list), submission and the wait for the GPU.  Not timed:
// making devices, pipelines and matrices, and checking the picture, which is done for every frame.
//
//     rhi_overhead [--backend vulkan|opengl|both] [--device N|name] [--draws N] [--rounds N] [--frames N] [--json FILE]
//
// Exit status: 0 measured; 1 a picture was wrong or a device failed; 2 usage; 4 no device.
#include <cstdio>
#include "rhi_overhead/measure.hpp"
#include "rhi_overhead/muted.hpp"
#include "rhi_overhead/ours.hpp"
#include "rhi_overhead/raw_opengl.hpp"
#include "rhi_overhead/raw_vulkan.hpp"
#include "support/options.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

/// Two devices of one kind, each with a loop: ours and the raw one.
template <rhi::Backend B>
struct Pair {
    std::unique_ptr<rhi::DeviceFor<B>> our_device, raw_device;
    std::unique_ptr<Loop> ours, raw;

    template <class MakeRaw>
    static Result<Pair> make(const rhi::DeviceDesc& desc, MakeRaw make_raw) {
        Pair out;
        PELLUCID_TRY(out.our_device, B::create(desc));
        PELLUCID_TRY(out.ours, OurLoop<B>::make(*out.our_device));
        PELLUCID_TRY(out.raw_device, B::create(desc));
        PELLUCID_TRY(out.raw, make_raw(*out.raw_device));
        return out;
    }
};

template <rhi::Backend B, class Muted, class MakeRaw>
Result<ApiResult> run(const std::string& device, const Settings& settings, double target, MakeRaw make_raw) {
    ApiResult out{.device = {}, .total_target = target, .variants = {}};
    rhi::DeviceDesc desc{.device = device, .frames_in_flight = frames_in_flight};
    {
        PELLUCID_TRY(const auto pair, Pair<B>::make(desc, make_raw));
        out.device = pair.our_device->info();
        PELLUCID_TRY(out.variants, measure(*pair.ours, *pair.raw, settings));
        const Muted ours(*pair.our_device), raw(*pair.raw_device);
        PELLUCID_CHECK(measure_muted(*pair.ours, *pair.raw, settings, out.variants));
    }
    desc.count_api_calls = true;
    PELLUCID_TRY(const auto pair, Pair<B>::make(desc, make_raw));
    PELLUCID_CHECK(count_calls(*pair.ours, *pair.raw, settings, out.variants));
    return out;
}

int fail(const Error& error) {
    std::fprintf(stderr, "rhi_overhead: %s\n", error.message.c_str());
    return error.code == Errc::invalid_argument ? 2 : error.code == Errc::no_device ? 4 : 1;
}

Result<void> run_all(int argc, char** argv) {
    Options options(
        {{"backend", "both"}, {"device", ""}, {"draws", "10000"}, {"rounds", "31"}, {"frames", "5"}, {"json", ""}});
    PELLUCID_CHECK(options.parse(argc, argv));
    Settings settings;
    PELLUCID_TRY(settings.draws, options.number("draws", 1, 1000000));
    PELLUCID_TRY(settings.rounds, options.number("rounds", 1, 10000));
    PELLUCID_TRY(settings.frames, options.number("frames", 1, 1000));
    const std::string& backend = options.text("backend");
    const std::string& device = options.text("device");
    if (backend != "vulkan" && backend != "opengl" && backend != "both")
        return Error{Errc::invalid_argument, "--backend is '" + backend + "' but must be vulkan, opengl or both"};

    // One API's devices are gone before the other's are made: on some drivers destroying a Vulkan device breaks OpenGL.
    // What one API measured is reported even where the other fails.
    std::vector<ApiResult> results;
    Result<void> status;
    const auto keep = [&](Result<ApiResult> result) {
        if (result) {
            results.push_back(std::move(*result));
        } else {
            const std::string before = status ? "" : status.error().message + "; ";
            status = Error{result.error().code, before + result.error().message};
        }
    };
    if (backend != "opengl") keep(run<Vulkan, MutedVulkan>(device, settings, 1.05, make_raw_vulkan));
    if (backend != "vulkan") keep(run<OpenGL, MutedOpenGL>(device, settings, 1.10, make_raw_opengl));
    if (results.empty()) return status;
    const Machine machine = describe_machine();
    std::fputs(to_markdown(results, settings, machine).c_str(), stdout);
    if (!options.text("json").empty())
        PELLUCID_CHECK(write_file(options.text("json"), to_json(results, settings, machine)));
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    const auto done = run_all(argc, argv);
    return done ? 0 : fail(done.error());
}
