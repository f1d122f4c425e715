// SPDX-License-Identifier: MIT
// The counting of API calls: the list of functions is complete, and a hand-written call is counted too.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <pellucid/opengl/opengl.hpp>
#include <set>
#include "../../../backends/opengl/functions.hpp"
#include "support/gpu.hpp"

namespace pellucid::inline v0_1 {
namespace {

/// Every word glXxx( of the backend's sources, without "gl".
std::set<std::string> called_functions() {
    std::set<std::string> out;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::string(PELLUCID_SOURCE_DIR) + "/backends/opengl")) {
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
        std::ifstream file(entry.path());
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        for (std::size_t at = text.find("gl"); at != std::string::npos; at = text.find("gl", at + 2)) {
            const bool starts =
                at == 0 || (!std::isalnum(static_cast<unsigned char>(text[at - 1])) && text[at - 1] != '_');
            std::size_t end = at + 2;
            while (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end]))) ++end;
            if (starts && end < text.size() && text[end] == '(' && end > at + 2 &&
                std::isupper(static_cast<unsigned char>(text[at + 2])))
                out.insert(text.substr(at + 2, end - at - 2));
        }
    }
    return out;
}

}  // namespace

TEST_CASE("the list of counted functions is what the sources call, no more and no less", "[cpu]") {
    const std::set<std::string> listed = {
#define PELLUCID_NAME(name) #name,
        PELLUCID_OPENGL_FUNCTIONS(PELLUCID_NAME)
#undef PELLUCID_NAME
    };
    const std::set<std::string> called = called_functions();
    REQUIRE(called.size() > 50);
    for (const std::string& name : called)
        if (listed.count(name) == 0) FAIL_CHECK(name << " is called and not listed");
    std::vector<std::string> unused;
    std::set_difference(listed.begin(), listed.end(), called.begin(), called.end(), std::back_inserter(unused));
    for (const std::string& name : unused) FAIL_CHECK(name << " is listed and never called");
}

TEST_CASE("calls are counted where that is asked for, by hand too, and nowhere else", "[gpu]") {
    const auto counted = test::make_device<OpenGL>([](rhi::DeviceDesc& desc) { desc.count_api_calls = true; });
    const auto plain = test::make_device<OpenGL>();
    if (!counted || !plain) return;
    CHECK(plain->api_calls() == 0);
    const auto target = test::make_target(*counted, {8, 8});
    const auto pipeline = test::own(*counted, counted->make_pipeline(test::quad_desc()));
    std::uint64_t calls = 0;
    test::run(*counted, [&](opengl::Commands& commands) {
        const test::Quad quads[3] = {};
        const auto records = test::upload(commands, std::span(quads));
        commands.begin_render({.colors = {{.texture = target}}, .size = {8, 8}});
        commands.bind_pipeline(pipeline);
        commands.bind_frame({}, records);
        commands.draw({.vertex_count = 6, .first_instance = records.first});
        calls = counted->api_calls();
        for (std::uint32_t i = 0; i < 3; ++i) {
            commands.bind_pipeline(pipeline);
            commands.bind_frame({}, records);
            commands.draw({.vertex_count = 6, .first_instance = records.first + i});
        }
        CHECK(counted->api_calls() == calls + 3);  // what is bound already costs no call
        calls = counted->api_calls();
        glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, 6, 1, records.first);
        CHECK(counted->api_calls() == calls + 1);
        commands.end_render();
    });
    REQUIRE(plain->make_current());
    calls = counted->api_calls();
    glFlush();
    CHECK(counted->api_calls() == calls);
    CHECK(plain->api_calls() == 0);
}

TEST_CASE("after OpenGL calls of one's own, reset_state brings everything back", "[gpu]") {
    const auto device = test::make_device<OpenGL>();
    if (!device) return;
    const auto target = test::make_target(*device, {8, 8});
    const auto pipeline = test::own(*device, device->make_pipeline(test::quad_desc()));
    const test::Quad white[] = {{}};
    auto draw = [&] {
        test::draw(*device, {.colors = {{.texture = target}}, .size = {8, 8}}, pipeline, white);
        return test::rgba(test::read<std::uint8_t>(*device, target, {8, 8}, 4), 4, 4);
    };
    CHECK(draw() == 0xFFFFFFFFu);
    REQUIRE(device->make_current());
    glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CW);
    glUseProgram(0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glViewport(0, 0, 1, 1);
    glScissor(0, 0, 1, 1);
    device->reset_state();
    CHECK(draw() == 0xFFFFFFFFu);
}

}  // namespace pellucid::inline v0_1
