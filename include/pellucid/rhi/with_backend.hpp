// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The one place where a backend is chosen at run time.
#include <pellucid/core/log.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/rhi/backend.hpp>
#include <string>
#include <string_view>
#include <type_traits>

namespace pellucid::inline v0_1::rhi {

/// The backends of a program, best first.
template <Backend... Bs>
struct BackendList {};

/// Calls `f(std::type_identity<B>{})` for the backend named `choice`, or, where `choice` is "auto", for the first of
/// the list that has a usable device; each one passed over is reported to `log` with its reason.  All instantiations of
/// `f` must return the same type.
/// \returns what `f` returned; `invalid_argument` for a name not in the list; `no_device` where auto finds none.
template <Backend First, Backend... Rest, class F>
auto with_backend(BackendList<First, Rest...>, std::string_view choice, F&& f, LogSink log = {})
    -> Result<std::invoke_result_t<F&, std::type_identity<First>>> {
    using R = Result<std::invoke_result_t<F&, std::type_identity<First>>>;
    std::string tried;
    auto attempt = [&]<Backend B>(std::type_identity<B> tag, R& out) {
        if (choice != "auto" && choice != B::name) return false;
        if (choice == "auto") {
            std::string reason = "no device was found";
            bool usable = false;
            for (const DeviceInfo& found : B::list()) {
                usable = usable || found.missing.empty();
                reason = found.name + " lacks " + found.missing;
            }
            if (!usable) {
                tried += std::string(tried.empty() ? "" : "; ") + B::name + ": " + reason;
                log(Severity::warning, (std::string(B::name) + " is passed over: " + reason).c_str());
                return false;
            }
        }
        if constexpr (std::is_void_v<std::invoke_result_t<F&, std::type_identity<First>>>) {
            f(tag);
            out = R{};
        } else {
            out = f(tag);
        }
        return true;
    };
    R out = Error{Errc::invalid_argument, "no backend is named '" + std::string(choice) + "'"};
    if (attempt(std::type_identity<First>{}, out) || (attempt(std::type_identity<Rest>{}, out) || ...)) return out;
    if (choice == "auto") return Error{Errc::no_device, "no backend has a usable device: " + tried};
    return out;
}

}  // namespace pellucid::inline v0_1::rhi
