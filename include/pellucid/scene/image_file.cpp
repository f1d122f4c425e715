// SPDX-License-Identifier: MIT
#include <pellucid/scene/image_file-inl.hpp>
