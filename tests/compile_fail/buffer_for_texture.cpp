// SPDX-License-Identifier: MIT
// Handles of different kinds do not mix.
// expect: error: conversion from .*BufferTag.* to non-scalar type .*TextureTag
#include <pellucid/rhi/desc.hpp>

const pellucid::rhi::Buffer buffer = {};
const pellucid::rhi::Texture texture = buffer;
