// SPDX-License-Identifier: MIT
// The renderer for backends that have no library: what a program with a backend of its own has in one of its files.
#include <pellucid/renderer/renderer-inl.hpp>
#include <pellucid/rhi/null.hpp>
#include <pellucid/rhi/validated.hpp>

namespace pellucid::inline v0_1 {
template class Renderer<Null>;
template class Renderer<Validated<Null>>;
}  // namespace pellucid::inline v0_1
