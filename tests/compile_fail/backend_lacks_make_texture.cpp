// SPDX-License-Identifier: MIT
// A backend whose device cannot make textures: the compiler names the concept and the function.
// expect: error: template constraint failure
// expect: CreatesTextures
// expect: required expression .*make_texture
#include <pellucid/rhi/null.hpp>

struct Device : pellucid::null::Device {
    void make_texture(int) {}  // hides the inherited one
};
struct Broken {
    static constexpr const char* name = "broken";
    using Device = ::Device;
    using Commands = pellucid::null::Commands;
    static pellucid::Result<std::unique_ptr<Device>> create(const pellucid::rhi::DeviceDesc&);
    static std::vector<pellucid::rhi::DeviceInfo> list();
};
template <pellucid::rhi::Backend B>
struct Pass {};
Pass<Broken> pass;
