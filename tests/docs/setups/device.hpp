// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// In scope: an open device.
#include <pellucid/pellucid.hpp>
#include <cstdio>

#define SETUP_PARAMETERS typename B::Device& device
