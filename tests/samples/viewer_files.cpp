// SPDX-License-Identifier: MIT
// Files that are dropped into the viewer: read beside the frames, shown when they are there; broken ones change
// nothing.
#include <fstream>
#include <pellucid/scene/gltf_write.hpp>
#include "support/catch.hpp"
#include "support/viewer.hpp"

namespace pellucid::test {
namespace {

TEMPLATE_LIST_TEST_CASE("a scene that is dropped is shown, from its own camera", "[gpu]", Backends) {
    TestViewer<TestType> v(make_cyclic_triangles());
    if (!v) return;
    const TemporaryFolder folder;
    const Scene panes = make_intersecting_planes();
    must(write_gltf("panes.glb", panes));
    v.frame();
    v.frame({.seconds = 1, .dropped = {"panes.glb"}});
    v.settle();
    CHECK(v.state.facts.scene == "panes.glb");
    CHECK(v.state.loaded.scene->instances.size() == panes.instances.size());
    CHECK(equal(v.canvas(), v.expected(v.state.choices.render)));
    v.state.requests.camera = v.state.rig.names().size() - 1;  // the one that frames the scene
    v.frame();
    CHECK(equal(v.canvas(), v.expected(v.state.choices.render)));
}

TEMPLATE_LIST_TEST_CASE("a file that is broken, missing or of no kind keeps the scene", "[gpu]", Backends) {
    TestViewer<TestType> v(make_cyclic_triangles());
    if (!v) return;
    const TemporaryFolder folder;
    std::ofstream("broken.glb") << "glTF, it is not";
    std::ofstream("broken.hdr") << "#?RADIANCE";
    std::ofstream("letter.txt") << "Dear reader";
    v.frame();
    const Image8 before = v.canvas();
    for (const char* file : {"broken.glb", "missing.gltf", "broken.hdr", "letter.txt"}) {
        INFO(file);
        v.state.say("", false);
        v.frame({.seconds = 1, .dropped = {file}});
        v.settle();
        CHECK(v.state.facts.message.find(file) != std::string::npos);
        CHECK(v.state.facts.message_is_error);
        CHECK(v.state.facts.scene == "test scene");
        CHECK(equal(v.canvas(), before));
    }
}

TEMPLATE_LIST_TEST_CASE("a scene without anything in it is a background", "[gpu]", Backends) {
    TestViewer<TestType> v{Scene{}};
    if (!v) return;
    for (const viewer::View view :
         {viewer::View::picture, viewer::View::layers, viewer::View::error, viewer::View::overdraw}) {
        INFO(viewer::name(view));
        v.state.choices.view = view;
        CHECK(v.frame());
        CHECK(v.state.facts.left.problem.empty());
    }
}

}  // namespace
}  // namespace pellucid::test
