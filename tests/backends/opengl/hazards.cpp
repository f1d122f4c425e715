// SPDX-License-Identifier: MIT
// Which barriers a pass gets, without a context: pure logic.
#include <pellucid/opengl/hazards.hpp>
#include "support/catch.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

using rhi::Access;

/// One pass with one use of one resource.  \returns the bits it would issue.
GLbitfield pass(Hazards& hazards, Touch& touch, Access access, bool texture) {
    hazards.begin();
    hazards.need(touch, barrier_bits(access, texture), stores(access));
    const GLbitfield bits = hazards.finish();
    hazards.mark(touch, stores(access));
    return bits;
}

}  // namespace

TEST_CASE("a read after a shader's store gets the bit of the read, once", "[cpu]") {
    Hazards hazards;
    Touch image;
    CHECK(pass(hazards, image, Access::storage_write, true) == 0);
    CHECK(pass(hazards, image, Access::sampled, true) == GL_TEXTURE_FETCH_BARRIER_BIT);
    CHECK(pass(hazards, image, Access::sampled, true) == 0);
    CHECK(pass(hazards, image, Access::storage_read, true) == GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    CHECK(pass(hazards, image, Access::storage_read, true) == 0);
}

TEST_CASE("a bit that was not issued stays pending for every resource", "[cpu]") {
    Hazards hazards;
    Touch a, b;
    pass(hazards, a, Access::storage_write, false);
    pass(hazards, b, Access::storage_write, false);
    CHECK(pass(hazards, a, Access::indirect_read, false) == GL_COMMAND_BARRIER_BIT);
    CHECK(pass(hazards, b, Access::indirect_read, false) == 0);  // the same barrier covered it
    CHECK(pass(hazards, b, Access::index_read, false) == GL_ELEMENT_ARRAY_BARRIER_BIT);
    CHECK(pass(hazards, a, Access::uniform_read, false) == GL_UNIFORM_BARRIER_BIT);
    pass(hazards, a, Access::storage_write, false);
    CHECK(pass(hazards, a, Access::indirect_read, false) == GL_COMMAND_BARRIER_BIT);  // a new store, a new barrier
}

TEST_CASE("a store waits for earlier reads and stores, not for its own pass", "[cpu]") {
    Hazards hazards;
    Touch buffer;
    CHECK(pass(hazards, buffer, Access::copy_write, false) == 0);
    CHECK(pass(hazards, buffer, Access::storage_read_write, false) == GL_SHADER_STORAGE_BARRIER_BIT);
    CHECK(pass(hazards, buffer, Access::storage_read_write, false) == GL_SHADER_STORAGE_BARRIER_BIT);
    CHECK(pass(hazards, buffer, Access::copy_read, false) ==
          (GL_BUFFER_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT));
    CHECK(pass(hazards, buffer, Access::storage_write, false) == GL_SHADER_STORAGE_BARRIER_BIT);
}

TEST_CASE("what no shader stored to needs no barrier", "[cpu]") {
    Hazards hazards;
    Touch texture;
    for (const Access access : {Access::copy_write, Access::sampled, Access::copy_read, Access::storage_read})
        CHECK(pass(hazards, texture, access, true) == 0);
}

}  // namespace pellucid::inline v0_1::opengl
