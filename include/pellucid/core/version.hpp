// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The version, for the preprocessor and for people.  While it is 0.x, a minor version may change any interface: what
/// is declared is therefore in the inline namespace v0_1, and objects built with another minor version do not link.
#define PELLUCID_VERSION_MAJOR 0
#define PELLUCID_VERSION_MINOR 1
#define PELLUCID_VERSION_PATCH 0
/// MAJOR · 10000 + MINOR · 100 + PATCH
#define PELLUCID_VERSION (PELLUCID_VERSION_MAJOR * 10000 + PELLUCID_VERSION_MINOR * 100 + PELLUCID_VERSION_PATCH)
#define PELLUCID_VERSION_STRING "0.1.0"
