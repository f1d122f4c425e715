// SPDX-License-Identifier: MIT
// pellucid-viewer: scenes in a window, and what each method of transparency costs and how wrong it is.
#include "../support/messages.hpp"
#include "headless.hpp"
#include "instances.hpp"
#include "options.hpp"
#include <pellucid/pellucid.hpp>
#include <cstdio>

namespace {

using namespace pellucid;
using namespace pellucid::samples;
using namespace pellucid::samples::viewer;

int report(const Error& error) {
    std::fprintf(stderr, "pellucid-viewer: %s\n", error.message.c_str());
    return static_cast<int>(exit_status(error.code));
}

}  // namespace

int main(int argc, char** argv) {
    const auto [options, finished] = parse_options(argc, argv);
    if (finished) return *finished;
    State state;
    Messages messages{.program = "pellucid-viewer"};
    if (const Result<void> ready = prepare(options, state); !ready) return report(ready.error());
    const Result<Result<void>> done = rhi::with_backend(
        Backends{}, options.backend, [&, &options = options]<rhi::Backend B>(std::type_identity<B>) -> Result<void> {
            return run_headless<B>(options, state,
                                   {.device = options.device,
                                    .validation = options.validate,
                                    .pipeline_cache = options.pipeline_cache,
                                    .log = messages.sink()});
        });
    if (!done) return report(done.error());
    if (!*done) return report(done->error());
    if (options.validate && messages.errors != 0)
        return report({Errc::internal, std::to_string(messages.errors) + " validation messages"});
    return static_cast<int>(Exit::done);
}
