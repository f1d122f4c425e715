// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The list of what a backend's library instantiates, so that programs need not.
#include <pellucid/renderer/renderer-inl.hpp>

/// `how` is `extern` to declare, empty to define.  Use it inside namespace pellucid.
#define PELLUCID_RENDERER_INSTANCES(how, B)    \
    how template class measure::GpuTimer<B>;   \
    how template class Graph<B>;               \
    how template class GBufferPass<B>;         \
    how template class LightListsPass<B>;      \
    how template class LightingPass<B>;        \
    how template class LightVolumesPass<B>;    \
    how template class ShadowMapPass<B>;       \
    how template class SortedForwardPass<B>;   \
    how template class LayerCountPass<B>;      \
    how template class AbufferPass<B>;         \
    how template class PeelPass<B>;            \
    how template class PeelSeedPass<B>;        \
    how template class DualPeelPass<B>;        \
    how template class InterleavedPass<B>;     \
    how template class InterleavedSkyxPass<B>; \
    how template class TonemapPass<B>;         \
    how template class DfgPass<B>;             \
    how template class EnvironmentPass<B>;     \
    how template class GpuEnvironment<B>;      \
    how template class GpuLights<B>;           \
    how template class GpuShadows<B>;          \
    how template class GpuScene<B>;            \
    how template class Opaque<B>;              \
    how template class Translucent<B>;         \
    how template class Renderer<B>;
