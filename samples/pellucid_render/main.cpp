// SPDX-License-Identifier: MIT
// pellucid-render: the command-line tool.  DESIGN.md has its contract.
#include "../support/environment_file.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "reference.hpp"
#include "run.hpp"
#include <pellucid/pellucid.hpp>
#include <cstdio>

namespace {

using namespace pellucid;

int report(const Error& error) {
    std::fprintf(stderr, "pellucid-render: %s\n", error.message.c_str());
    return static_cast<int>(exit_status(error.code));
}

template <rhi::Backend... Bs>
void list_devices(rhi::BackendList<Bs...>) {
    auto list = []<rhi::Backend B>(std::type_identity<B>) {
        unsigned index = 0;
        for (const rhi::DeviceInfo& d : B::list())
            std::printf("%s %u: %s (%s, %s)%s%s\n", B::name, index++, d.name.c_str(), d.api.c_str(), d.driver.c_str(),
                        d.missing.empty() ? "" : ": not usable, lacks ", d.missing.c_str());
        if (index == 0) std::printf("%s: no device\n", B::name);
    };
    (list(std::type_identity<Bs>{}), ...);
}

/// Reads the picture of the environment that was asked for.
Result<void> read_environment(Options& options) {
    if (options.environment.empty()) return {};
    PELLUCID_TRY(options.settings.environment.picture, samples::read_environment(options.environment));
    options.settings.environment.kind = EnvironmentKind::picture;
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    auto [options, finished] = parse_options(argc, argv);
    if (finished) return *finished;
    if (options.list_devices) {
        list_devices(Backends{});
        return static_cast<int>(Exit::done);
    }
    for (const OutputFile& file : output_files(options))
        if (const Result<void> writable = check_writable(file); !writable) {
            report(writable.error());
            return static_cast<int>(Exit::usage);
        }
    if (const Result<void> read = read_environment(options); !read) return report(read.error());
    const Result<Scene> scene = load_gltf(options.scene);
    if (!scene) return report(scene.error());
    const Result<Camera> camera = choose_camera(*scene, options);
    if (!camera) return report(camera.error());
    const Result<std::optional<Target>> target = read_target(options);
    if (!target) return report(target.error());
    if (options.reference) {
        const Result<int> status = run_reference(options, *scene, *camera, *target);
        return status ? *status : report(status.error());
    }
    const Result<Result<int>> status = rhi::with_backend(
        Backends{}, options.backend, [&, &options = options]<rhi::Backend B>(std::type_identity<B>) -> Result<int> {
            return run<B>(options, *scene, *camera, *target);
        });
    if (!status) return report(status.error());
    return *status ? **status : report(status->error());
}
