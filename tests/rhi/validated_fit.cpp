// SPDX-License-Identifier: MIT
// The rules of Validated<B> about what must fit together: attachments, groups, pipelines, copies.
#include "support/validated_rig.hpp"

using namespace pellucid;
using namespace pellucid::rhi;
using test::rig::Rig;

TEST_CASE("attachments must fit the pass and the pipeline", "[cpu]") {
    Rig rig;
    auto begin = [&](const RenderPassDesc& desc) {
        rig.commands->begin_render(desc);
        rig.commands->draw({.vertex_count = 3});  // silent: the pass itself was refused
        rig.commands->end_render();
    };
    begin({.colors = {{.texture = rig.color}}, .size = {9, 8}, .name = "large"});
    rig.expect({"the render area is 9x8, the attachment 'hdr' only 8x8"}, "begin_render");
    begin({.colors = {{.texture = rig.color}}, .size = {0, 8}, .name = "empty"});
    rig.expect({"'empty'", "the render area is 0x8"}, "begin_render");
    begin({.colors = {{.texture = rig.picture}}, .size = {4, 4}});
    rig.expect({"'picture' lacks the usage attachment"}, "begin_render");
    begin({.colors = {{.texture = rig.depth}}, .size = {4, 4}});
    rig.expect({"'depth' of format d32_float cannot be a colour attachment"}, "begin_render");
    begin({.depth = {.texture = rig.color}, .size = {4, 4}});
    rig.expect({"'hdr' of format rgba8_unorm cannot be the depth attachment"}, "begin_render");
    begin({.colors = {{.texture = rig.color, .mip = 1}}, .size = {4, 4}});
    rig.expect({"level 1 and layer 0 of the texture 'hdr', which has 1 and 1"}, "begin_render");
    begin({.colors = {{.texture = rig.color}, {.texture = rig.color}}, .size = {4, 4}});
    rig.expect({"'hdr' is attached as colours 0 and 1"}, "begin_render");
    begin({.colors = {{.texture = rig.color}}, .uses = {use(rig.color, Access::sampled)}, .size = {4, 4}});
    rig.expect({"'hdr' is attached and declared as used"}, "begin_render");
    begin({.colors = {{.texture = rig.color}}, .uses = {use(rig.picture, Access::storage_read)}, .size = {4, 4}});
    rig.expect({"'picture' was not made for storage_read"}, "begin_render");
    begin({.colors = {{.texture = rig.color}}, .uses = {use(rig.plain, Access::indirect_read)}, .size = {4, 4}});
    rig.expect({"'plain' was not made for indirect_read"}, "begin_render");
    CHECK(rig.calls("draw") + rig.calls("end_render") == 0);

    rig.commands->begin_render(rig.pass());
    rig.commands->bind_pipeline(rig.depth_quads);
    rig.expect({"the depth format of the pipeline 'depth quads' is d32_float, the attachment's is undefined"},
               "bind_pipeline");
    rig.commands->end_render();
    rig.commands->begin_render({.depth = {.texture = rig.depth}, .size = {8, 8}});
    rig.commands->bind_pipeline(rig.quads);
    rig.expect({"'quads' writes 1 colours, the pass attaches 0"}, "bind_pipeline");
    rig.commands->end_render();
    rig.commands->begin_render({.colors = {{.texture = rig.color}},
                                .depth = {.texture = rig.depth, .load = Load::load, .read_only = true},
                                .size = {8, 8}});
    rig.commands->bind_pipeline(rig.depth_quads);
    rig.expect({"'depth quads' writes depth, but 'depth' is read-only"}, "bind_pipeline");
    rig.commands->end_render();
    const Texture hdr16 = *rig.device->make_texture(
        {.size = {8, 8}, .format = Format::rgba16_float, .usage = TextureUsage::attachment, .debug_name = "hdr16"});
    rig.commands->begin_render({.colors = {{.texture = hdr16}}, .size = {8, 8}});
    rig.commands->bind_pipeline(rig.quads);
    rig.expect({"colour 0 of the pipeline 'quads' is rgba8_unorm, the attachment is rgba16_float"}, "bind_pipeline");
    rig.commands->end_render();
    rig.device->destroy(hdr16);
}

TEST_CASE("groups must fit the pipeline and be declared by the pass", "[cpu]") {
    Rig rig;
    rig.commands->begin_render(rig.pass());
    rig.commands->bind_group(rig.texture_group);
    rig.expect({"no pipeline is bound; bind it before the group 'inputs'"}, "bind_group");
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->bind_group(rig.texture_group);
    rig.expect({"'inputs', binding 12", "does not declare its use of the texture 'picture'"}, "bind_group");
    rig.commands->bind_group(rig.scale_group);
    rig.expect({"'scaled' has 2 bindings of another layout than the 1 that the pipeline 'fetch' has in slot 1"},
               "bind_group");
    rig.commands->end_render();
    // A group over a texture that the same pass attaches.
    const GroupLayout layout{.bindings = {{12, BindingKind::sampled_texture}}};
    const Group loop =
        *rig.device->make_group({.layout = layout,
                                 .bindings = {{.binding = 12, .texture = rig.color, .sampler = rig.sampler}},
                                 .debug_name = "loop"});
    rig.commands->begin_render(rig.pass());
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->bind_group(loop);
    rig.expect({"'loop', binding 12: the texture 'hdr' is attached to the pass"}, "bind_group");
    rig.commands->end_render();
    rig.device->destroy(loop);
    // A storage buffer, undeclared.
    rig.commands->begin_compute({.uses = {use(rig.buffer, Access::uniform_read)}, .name = "scale it"});
    rig.commands->bind_pipeline(rig.scale);
    rig.commands->bind_group(rig.scale_group);
    rig.expect({"'scale it'", "'scaled', binding 13", "does not declare its use of the buffer 'values'"}, "bind_group");
    rig.commands->end_compute();
    // A group outlived by what it binds.
    rig.commands->begin_render(
        {.colors = {{.texture = rig.color}}, .uses = {use(rig.picture, Access::sampled)}, .size = {8, 8}});
    rig.device->destroy(rig.picture);
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->bind_group(rig.texture_group);
    rig.expect({"the texture 'picture' was destroyed"}, "bind_group");
    rig.commands->end_render();
}

TEST_CASE("a pipeline of another layout drops the bound groups", "[cpu]") {
    Rig rig;
    rig.commands->begin_render(
        {.colors = {{.texture = rig.color}}, .uses = {use(rig.picture, Access::sampled)}, .size = {8, 8}});
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->bind_group(rig.texture_group);
    rig.commands->bind_pipeline(rig.fetch);
    rig.commands->draw({.vertex_count = 3});  // the same layout: still bound
    CHECK(rig.said.empty());
    rig.commands->bind_pipeline(rig.push);
    rig.commands->bind_pipeline(rig.fetch);
    rig.device->backend().clear_calls();
    rig.commands->draw({.vertex_count = 3});
    rig.expect({"'fetch' needs a group"}, "draw");
}

TEST_CASE("what is made must fit: groups and pipelines", "[cpu]") {
    Rig rig;
    const GroupLayout uniform{.bindings = {{12, BindingKind::uniform_buffer}}};
    const GroupLayout storage{.bindings = {{0, BindingKind::storage_texture}}};
    CHECK_FALSE(rig.device->make_group({.slot = GroupSlot::frame, .debug_name = "frame"}));
    rig.expect({"group 'frame'", "group 0 is the device's"}, "make_group");
    CHECK_FALSE(rig.device->make_group({.layout = uniform, .bindings = {{12, rig.plain}}, .debug_name = "g"}));
    rig.expect({"group 'g', binding 12", "'plain' lacks the usage uniform"}, "make_group");
    CHECK_FALSE(rig.device->make_group({.layout = uniform, .bindings = {{13, rig.buffer}}, .debug_name = "g"}));
    rig.expect({"binding 13 is not in its layout"}, "make_group");
    CHECK_FALSE(rig.device->make_group({.layout = storage, .bindings = {{.binding = 0, .texture = rig.picture}}}));
    rig.expect({"'picture' lacks the usage storage"}, "make_group");
    GraphicsPipelineDesc desc;
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_fetch_frag;
    desc.debug_name = "forgetful";
    CHECK_FALSE(rig.device->make_pipeline(desc));
    rig.expect({"'forgetful'", "'test/fetch.frag' reads binding 12 of group 1"}, "make_graphics_pipeline");
}

TEST_CASE("copies stay in bounds, are declared and have their usages", "[cpu]") {
    Rig rig;
    rig.commands->begin_copy({.uses = {use(rig.buffer, Access::copy_read), use(rig.buffer, Access::copy_write),
                                       use(rig.readback, Access::copy_write), use(rig.color, Access::copy_read)},
                              .name = "copies"});
    rig.commands->copy(rig.buffer, rig.readback, BufferCopy{.source_offset = 224, .size = 64});
    rig.expect({"copy in the pass 'copies'", "64 bytes at 224 of the buffer 'values', which has 256"}, "copy");
    rig.commands->copy(rig.buffer, rig.readback, BufferCopy{.size = 65});
    rig.expect({"65 bytes at 0 of the buffer 'result', which has 64"}, "copy");
    rig.commands->copy(rig.buffer, rig.readback, BufferCopy{.size = 0});
    rig.expect({"0 bytes of the buffer 'values'"}, "copy");
    rig.commands->copy(rig.buffer, rig.buffer, BufferCopy{.destination_offset = 8, .size = 16});
    rig.expect({"overlap"}, "copy");
    rig.commands->copy(rig.readback, rig.buffer, BufferCopy{.size = 4});
    rig.expect({"'result' lacks the usage copy_source"}, "copy");
    rig.commands->update(rig.buffer, 250, std::vector<std::byte>(8));
    rig.expect({"update", "8 bytes at 250 of the buffer 'values'"}, "update");
    rig.commands->fill(rig.buffer, 2, 8, 0);
    rig.expect({"fill", "8 bytes at 2"}, "fill");
    rig.commands->copy(rig.color, rig.readback, TextureCopy{});
    rig.expect({"256 bytes at 0 of the buffer 'result', which has 64"}, "copy_texture_to_buffer");
    rig.commands->copy(rig.color, rig.buffer, TextureCopy{.mip = 3});
    rig.expect({"level 3 and layer 0 of the texture 'hdr'"}, "copy_texture_to_buffer");
    rig.commands->copy(rig.color, rig.buffer, TextureCopy{.buffer_offset = 8});
    rig.expect({"the offset 8 is no multiple of 16"}, "copy_texture_to_buffer");
    rig.commands->copy(rig.buffer, rig.picture, TextureCopy{});
    rig.expect({"'picture' lacks the usage copy_destination"}, "copy_buffer_to_texture");
    rig.commands->generate_mips(rig.picture);
    rig.expect({"generate_mips", "'picture' lacks the usage"}, "generate_mips");
    rig.commands->end_copy();
    rig.commands->begin_copy({.name = "undeclared"});
    rig.commands->update(rig.buffer, 0, bytes_of(1));
    rig.expect({"'undeclared': the pass does not declare copy_write of the buffer 'values'"}, "update");
}
