// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How the definitions in `*-inl.hpp` are compiled: once, into the library, or inline wherever they are included.

/// Stands before every definition in a `*-inl.hpp`.
#ifdef PELLUCID_HEADER_ONLY
#define PELLUCID_INLINE inline
#else
#define PELLUCID_INLINE
#endif
