// SPDX-License-Identifier: MIT
#include <pellucid/rhi/validated/binding_checks-inl.hpp>
#include <pellucid/rhi/validated/copy_checks-inl.hpp>
#include <pellucid/rhi/validated/creation_checks-inl.hpp>
#include <pellucid/rhi/validated/pass_checks-inl.hpp>
