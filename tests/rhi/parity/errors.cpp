// SPDX-License-Identifier: MIT
// What cannot be made is refused with a kind and a sentence that names the object, and nothing of it stays.
#include <string>
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::rhi;

namespace {
/// The result is `invalid_argument` (or `code`) and its sentence names the object.
template <class T>
void refused(const Result<T>& made, const std::string& name, Errc code = Errc::invalid_argument) {
    INFO(name);
    REQUIRE_FALSE(made);
    CHECK(pellucid::name(made.error().code) == std::string(pellucid::name(code)));
    INFO("the sentence: " << made.error().message);
    CHECK(made.error().message.find(name) != std::string::npos);
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("descriptors outside their documented ranges are refused by name", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const std::byte bytes[16] = {};
    const auto limit = device->info().max_texture_size;
    refused(device->make_buffer({.size = 0, .debug_name = "no bytes"}), "no bytes");
    refused(device->make_buffer({.size = 8, .initial = bytes, .debug_name = "too much content"}), "too much content");
    refused(device->make_texture({.size = {0, 4}, .debug_name = "no width"}), "no width");
    refused(device->make_texture({.size = {limit + 1, 1}, .debug_name = "too wide"}), "too wide", Errc::unsupported);
    refused(device->make_texture({.size = {4, 4}, .mips = 4, .debug_name = "too many levels"}), "too many levels");
    refused(device->make_texture({.size = {4, 4}, .mips = 0, .debug_name = "no levels"}), "no levels");
    refused(device->make_texture({.size = {4, 4}, .layers = 0, .debug_name = "no layers"}), "no layers");
    refused(device->make_texture({.size = {4, 4}, .layers = 5, .kind = TextureKind::cube, .debug_name = "odd cube"}),
            "odd cube");
    refused(device->make_texture({.size = {4, 4}, .format = Format::undefined, .debug_name = "no format"}),
            "no format");
    refused(device->make_texture({.size = {4, 4}, .initial = bytes, .debug_name = "too few texels"}), "too few texels");
    refused(
        device->make_texture(
            {.size = {4, 4}, .format = Format::rgba8_srgb, .usage = TextureUsage::storage, .debug_name = "srgb image"}),
        "srgb image");
    refused(device->make_queries({.count = 0, .debug_name = "no queries"}), "no queries");
    refused(device->make_pipeline(GraphicsPipelineDesc{.debug_name = "no vertex shader"}), "no vertex shader");
    refused(device->make_pipeline(ComputePipelineDesc{.debug_name = "no compute shader"}), "no compute shader");
    auto desc = test::quad_desc();
    desc.push_bytes = 144;
    desc.debug_name = "too much push data";
    refused(device->make_pipeline(desc), "too much push data");
    const GroupLayout layout{.bindings = {{12, BindingKind::storage_buffer}}};
    refused(device->make_group({.layout = layout, .debug_name = "empty group"}), "empty group");
    refused(device->make_group({.layout = layout, .bindings = {{.binding = 12}}, .debug_name = "null buffer"}),
            "null buffer");
    CHECK(device->live_objects() == 0);
}

TEMPLATE_LIST_TEST_CASE("a device that is not there is refused with the list of those that are", "[gpu]",
                        test::Backends) {
    const auto listed = TestType::list();
    if (listed.empty()) return test::skip(std::string(TestType::name) + ": no device", "PELLUCID_REQUIRE_DEVICES");
    const auto made = TestType::create({.device = "no such device"});
    REQUIRE_FALSE(made);
    CHECK(made.error().code == Errc::no_device);
    CHECK(made.error().message.find("no such device") != std::string::npos);
    CHECK(made.error().message.find(listed[0].name) != std::string::npos);
    const auto device = test::make_device<TestType>();
    if (!device) return;
    CHECK(device->info().backend == TestType::name);
    CHECK_FALSE(device->info().name.empty());
    CHECK_FALSE(device->info().driver.empty());
    CHECK(device->info().missing.empty());
    CHECK(device->info().max_texture_size >= 4096);
    CHECK(device->info().max_array_layers >= 256);
    CHECK(device->info().max_storage_buffer_bytes >= std::uint64_t{1} << 27);
}

TEMPLATE_LIST_TEST_CASE("more memory than there is: a result, and the device goes on", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    device.log->expected = true;  // the driver may say so too
    const auto huge = device->make_buffer(
        {.size = std::uint64_t{1} << 44, .usage = BufferUsage::copy_destination, .debug_name = "16 TiB"});
    REQUIRE_FALSE(huge);
    INFO(huge.error().message);
    CHECK(huge.error().code == Errc::out_of_memory);
    CHECK(huge.error().message.find("16 TiB") != std::string::npos);
    device.log->expected = false;
    const std::uint32_t word = 42;
    const auto small = test::own(
        *device, device->make_buffer(
                     {.size = 4, .usage = BufferUsage::copy_source, .initial = bytes_of(word), .debug_name = "small"}));
    CHECK(test::read<std::uint32_t>(*device, small.get(), 1)[0] == 42);
}
