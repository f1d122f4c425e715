// SPDX-License-Identifier: MIT
// Counting thunks in epoxy's function pointers.  epoxy resolves a function at its first call and then overwrites the
// pointer; resolving first, and by EGL itself, keeps its resolver from ever running behind a thunk.
#include "pellucid/opengl/calls.hpp"

#include <epoxy/egl.h>

#include <mutex>

#include "functions.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

/// The thunk of the function behind epoxy's pointer variable `*slot`.
template <auto slot, class Signature = std::remove_pointer_t<std::remove_pointer_t<decltype(slot)>>>
struct Thunk;
template <auto slot, class R, class... Args>
struct Thunk<slot, R(Args...)> {
    using Function = R (*)(Args...);
    static inline Function real = nullptr;

    static R call(Args... args) {
        if (call_counter) ++*call_counter;
        return real(args...);
    }
    static void install(const char* name) {
        if (!real) real = reinterpret_cast<Function>(eglGetProcAddress(name));
        if (real) *slot = &call;
    }
    static void remove() {
        if (real) *slot = real;
    }
};

std::mutex mutex;
int installations = 0;

}  // namespace

void install_call_counting() {
    const std::lock_guard lock(mutex);
    if (installations++ != 0) return;
#define PELLUCID_INSTALL(name) Thunk<&epoxy_gl##name>::install("gl" #name);
    PELLUCID_OPENGL_FUNCTIONS(PELLUCID_INSTALL)
#undef PELLUCID_INSTALL
}

void remove_call_counting() {
    const std::lock_guard lock(mutex);
    if (--installations != 0) return;
#define PELLUCID_REMOVE(name) Thunk<&epoxy_gl##name>::remove();
    PELLUCID_OPENGL_FUNCTIONS(PELLUCID_REMOVE)
#undef PELLUCID_REMOVE
}

}  // namespace pellucid::inline v0_1::opengl
