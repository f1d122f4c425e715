// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// OpenGL's functions, through libepoxy, and the counting of calls.  Whoever includes this and calls glX calls the same
/// function pointers as the backend, so a hand-written loop is counted by the same counter.
#include <epoxy/gl.h>

#include <cstdint>

namespace pellucid::inline v0_1::opengl {

/// Where this thread's calls are counted: the counter of the device whose context is current.  Null: nowhere.
inline constinit thread_local std::uint64_t* call_counter = nullptr;

/// Puts a counting thunk before every function this backend uses, for the whole process, until `remove_call_counting`
/// was called as often.  Precondition: a context is current.
void install_call_counting();
void remove_call_counting();

}  // namespace pellucid::inline v0_1::opengl
