// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The frame as a programmer would write it for OpenGL 4.5 alone.
#include <pellucid/opengl/opengl.hpp>
#include "rhi_overhead/loop.hpp"

namespace pellucid::bench {

/// `device` gives the context and nothing else; use one of its own, because the loop changes the context's state behind
/// the device's back.  It must outlive the loop.
Result<std::unique_ptr<Loop>> make_raw_opengl(opengl::Device& device);

}  // namespace pellucid::bench
