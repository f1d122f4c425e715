// SPDX-License-Identifier: MIT
#include <pellucid/measure/hdr_flip-inl.hpp>
