// SPDX-License-Identifier: MIT
// pellucid-viewer: scenes in a window, and what each method of transparency costs and how wrong it is.
#include "../support/messages.hpp"
#include "headless.hpp"
#include "instances.hpp"
#include "options.hpp"
#include "window_loop.hpp"
#include <cstdio>
#if defined(PELLUCID_HAS_VULKAN)
#include <pellucid/vulkan/surface.hpp>
#endif
#if defined(PELLUCID_HAS_OPENGL)
#include <pellucid/opengl/surface.hpp>
#endif

namespace {

using namespace pellucid;
using namespace pellucid::samples;
using namespace pellucid::samples::viewer;

template <rhi::Backend... Bs>
std::vector<std::string> names(rhi::BackendList<Bs...>) {
    return {Bs::name...};
}

Result<void> run_without_window(const Options& options, State& state, const rhi::DeviceDesc& desc) {
    PELLUCID_TRY(const Result<void> done,
                 rhi::with_backend(Backends{}, options.backend, [&]<rhi::Backend B>(std::type_identity<B>) {
                     return run_headless<B>(options, state, desc);
                 }));
    return done;
}

/// One backend after another in the same window.  One that cannot be had leaves the one before it.
Result<void> run_in_window(const Options& options, State& state, rhi::DeviceDesc desc) {
    StartTimes times;
    PELLUCID_TRY(const std::unique_ptr<Window> window, Window::open({.title = "Pellucid", .size = options.size}));
    desc.display = window->display();
    state.facts.backends = names(Backends{});
    if (options.scene.empty()) {
        PELLUCID_TRY(Loaded demo, load_scene(""));
        state.show(std::move(demo), options.size);
    } else {
        state.show({.scene = std::make_shared<const Scene>(), .name = options.scene}, options.size);
        state.open(options.scene);
    }
    std::string backend = options.backend, before;
    for (;;) {
        PELLUCID_TRY(const Result<std::optional<std::string>> next,
                     rhi::with_backend(Backends{}, backend, [&]<rhi::Backend B>(std::type_identity<B>) {
                         desc.pipeline_cache = cache_file(options, B::name, times.device > 0);
                         backend = B::name;
                         return WindowLoop<B>(options, state, *window, desc).run(times);
                     }));
        if (!next && !before.empty() && backend != before) {
            state.say(next.error().message, true);
            backend = before;
            continue;
        }
        // A device that is usable, and yet cannot show anything in this window.
        const std::string& last = state.facts.backends.back();
        if (!next && options.backend == "auto" && before.empty() && backend != last &&
            (next.error().code == Errc::no_device || next.error().code == Errc::unsupported)) {
            std::fprintf(stderr, "pellucid-viewer: %s is passed over: %s\n", backend.c_str(),
                         next.error().message.c_str());
            backend = last;
            continue;
        }
        if (!next) return next.error();
        if (!*next) return {};
        before = backend;
        backend = **next;
    }
}

int report(const Error& error) {
    std::fprintf(stderr, "pellucid-viewer: %s\n", error.message.c_str());
    return static_cast<int>(exit_status(error.code));
}

}  // namespace

int main(int argc, char** argv) {
    const auto [options, finished] = parse_options(argc, argv);
    if (finished) return *finished;
    Messages messages{.program = "pellucid-viewer"};
    State state;
    if (const Result<void> ready = prepare(options, state); !ready) return report(ready.error());
    const rhi::DeviceDesc desc{.device = options.device,
                               .validation = options.validate,
                               .pipeline_cache = options.pipeline_cache,
                               .log = messages.sink()};
    const Result<void> done =
        options.headless ? run_without_window(options, state, desc) : run_in_window(options, state, desc);
    if (!done) return report(done.error());
    if (options.validate && messages.errors != 0)
        return report({Errc::internal, std::to_string(messages.errors) + " validation messages"});
    return static_cast<int>(Exit::done);
}
