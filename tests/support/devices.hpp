// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Devices for tests: every backend this build has, validation on, and any warning or error of the driver, the
/// validation layer or the library fails the test.
#include <memory>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/validated.hpp>
#include <string>
#include <tuple>
#include <vector>
#include "support/skip.hpp"
#if defined(PELLUCID_HAS_VULKAN)
#include <pellucid/vulkan/vulkan.hpp>
#endif
#if defined(PELLUCID_HAS_OPENGL)
#include <pellucid/opengl/opengl.hpp>
#endif

namespace pellucid::test {

/// The backends of this build, for `TEMPLATE_LIST_TEST_CASE("…", "[gpu]", test::Backends)`.
#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
using Backends = std::tuple<Vulkan, OpenGL>;
#elif defined(PELLUCID_HAS_VULKAN)
using Backends = std::tuple<Vulkan>;
#elif defined(PELLUCID_HAS_OPENGL)
using Backends = std::tuple<OpenGL>;
#else
using Backends = std::tuple<>;
#endif

/// The same, each inside `Validated<B>`: the test is then also one of the rules, which must not cry wolf.
template <class List>
struct Wrap;
template <class... Bs>
struct Wrap<std::tuple<Bs...>> {
    using type = std::tuple<Validated<Bs>...>;
};
using ValidatedBackends = Wrap<Backends>::type;

/// Keeps what a device says.  A warning or an error fails the running test unless `expected` is set.
struct Log {
    std::vector<std::string> messages;  ///< of severity warning or error
    bool expected = false;              ///< true: messages are only kept

    rhi::DeviceDesc desc() {
        rhi::DeviceDesc out;
        out.validation = true;
        out.log = LogSink{[](void* user, Severity severity, const char* text) {
                              auto& log = *static_cast<Log*>(user);
                              if (severity == Severity::info) return;
                              log.messages.push_back(text);
                              if (!log.expected) FAIL_CHECK("the device says: " << text);
                          },
                          this};
        return out;
    }
};

/// A device and its log.  False where the machine has none.
template <rhi::Backend B>
struct TestDevice {
    std::unique_ptr<Log> log = std::make_unique<Log>();
    std::unique_ptr<typename B::Device> device = {};

    explicit operator bool() const { return device != nullptr; }
    typename B::Device& operator*() const { return *device; }
    typename B::Device* operator->() const { return device.get(); }
};

/// Makes a device with validation on; `adjust(desc)` may change what is asked for.  Where there is no device the test
/// is skipped with a sentence (`if (!device) return;`), or fails under PELLUCID_REQUIRE_DEVICES=1.
template <rhi::Backend B, class Adjust>
TestDevice<B> make_device(Adjust&& adjust) {
    TestDevice<B> out;
    rhi::DeviceDesc desc = out.log->desc();
    adjust(desc);
    auto made = B::create(desc);
    if (made) {
        out.device = std::move(*made);
    } else if (made.error().code == Errc::no_device) {
        skip(std::string(B::name) + ": " + made.error().message, "PELLUCID_REQUIRE_DEVICES");
    } else {
        FAIL(B::name << ": " << made.error().message);
    }
    return out;
}
template <rhi::Backend B>
TestDevice<B> make_device() {
    return make_device<B>([](rhi::DeviceDesc&) {});
}

/// The value of a `Result`, or a failed test with its sentence.
template <class T>
T must(Result<T> result) {
    if (!result) FAIL(name(result.error().code) << ": " << result.error().message);
    return std::move(*result);
}
inline void must(const Result<void>& result) {
    if (!result) FAIL(name(result.error().code) << ": " << result.error().message);
}

}  // namespace pellucid::test
