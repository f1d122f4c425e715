// SPDX-License-Identifier: MIT
// The table of directional albedo that the device makes, against the one in double.
#include <pellucid/core/half.hpp>
#include <pellucid/passes/dfg.hpp>
#include <pellucid/reference/dfg_table.hpp>
#include <pellucid/rhi/readback.hpp>
#include <array>
#include <cmath>
#include "support/devices.hpp"

using namespace pellucid;

TEMPLATE_LIST_TEST_CASE("every texel of the table is the integral, and its averages are those of what it holds",
                        "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    using Device = typename TestType::Device;
    const rhi::Unique<Device, rhi::Texture> table(*device,
                                                  test::must(device->make_texture(DfgPass<TestType>::table_desc())));
    const auto pass = test::must(DfgPass<TestType>::create(*device, table));
    auto* const cmd = test::must(device->begin_frame());
    pass.record(*cmd);
    test::must(device->wait(test::must(device->submit())));
    const rhi::Texels texels = test::must(rhi::download<TestType>(*device, table, DfgPass<TestType>::table_desc()));
    const reference::DfgTable exact = reference::DfgTable::make(PELLUCID_DFG_SIZE);
    double loss = 0, shift = 0, average = 0;
    for (std::uint32_t y = 0; y < PELLUCID_DFG_SIZE; ++y)
        for (std::uint32_t x = 0; x < PELLUCID_DFG_SIZE; ++x) {
            const auto halves = texels.template at<std::array<std::uint16_t, 4>>(x, y);
            const auto off = [&](std::size_t channel, double wanted) {
                const double got = half_to_float(halves[channel]);
                REQUIRE(std::isfinite(got));
                return std::abs(got - wanted);
            };
            const reference::DfgTexel& t = exact.texels()[std::size_t{y} * PELLUCID_DFG_SIZE + x];
            loss = std::max(loss, off(0, t.loss));
            shift = std::max(shift, off(1, t.shift));
            average = std::max({average, off(2, exact.averages()[y].loss), off(3, exact.averages()[y].bias)});
        }
    std::printf("%s: off by up to %.3g in loss, %.3g in shift, %.3g in averages\n", TestType::name, loss, shift,
                average);
    // Rounding to binary16 is up to 4.9e-4 (of values below 1), the rule of eight points 1.7e-4.
    CHECK(loss <= 7e-4);
    CHECK(shift <= 7e-4);
    CHECK(average <= 7e-4);
}
