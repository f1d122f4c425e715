// SPDX-License-Identifier: MIT
#include "text.hpp"

#include <cstdarg>
#include <cstdio>

namespace pellucid::inline v0_1::opengl {

std::string text(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    va_list again;
    va_copy(again, arguments);
    const int length = std::vsnprintf(nullptr, 0, format, arguments);
    va_end(arguments);
    std::string out(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
    std::vsnprintf(out.data(), out.size() + 1, format, again);
    va_end(again);
    return out;
}

}  // namespace pellucid::inline v0_1::opengl
