# SPDX-License-Identifier: MIT
"""Conan 2 recipe; it packages the source tree that it lies in: conan create scripts/packaging/conan"""
import os

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy
from conan.tools.gnu import PkgConfigDeps


class PellucidConan(ConanFile):
    name = "pellucid"
    version = "0.1.0"
    description = "Deferred rendering with transparency that is right, on Vulkan and OpenGL"
    license = "MIT"
    topics = ("rendering", "transparency", "vulkan", "opengl")
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"fPIC": [True, False], "vulkan": [True, False], "opengl": [True, False], "reference": [True, False],
               "tools": [True, False]}
    default_options = {"fPIC": True, "vulkan": True, "opengl": True, "reference": False, "tools": False}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md", "backends/*", "include/*",
                        "samples/*", "shaders/*"):
            copy(self, pattern, src=root, dst=self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("glm/0.9.9.8", transitive_headers=True)
        self.requires("libpng/[>=1.6 <2]")
        self.requires("libjpeg/9e")
        self.requires("tinyexr/1.0.7")
        self.requires("tinygltf/2.8.13")
        self.requires("nlohmann_json/3.11.3")
        if self.options.vulkan:
            self.requires("vulkan-headers/1.3.290.0", transitive_headers=True)
        if self.options.opengl:
            self.requires("libepoxy/1.5.10", transitive_headers=True)
        if self.options.reference:
            self.requires("onetbb/2021.12.0")
        if self.options.tools:
            self.requires("cli11/2.4.2")

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25]")
        self.tool_requires("glslang/1.3.290.0")
        if self.options.opengl:
            self.tool_requires("pkgconf/[>=2.2 <3]")

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("pellucid is built and tested on Linux only")

    def generate(self):
        toolchain = CMakeToolchain(self)
        for name, option in (("PELLUCID_VULKAN", "vulkan"), ("PELLUCID_OPENGL", "opengl"),
                             ("PELLUCID_REFERENCE", "reference"), ("PELLUCID_SAMPLES", "tools")):
            toolchain.cache_variables[name] = bool(self.options.get_safe(option))
        toolchain.cache_variables["PELLUCID_INSTALL"] = True
        toolchain.cache_variables["PELLUCID_TESTS"] = False
        toolchain.cache_variables["PELLUCID_BENCHMARKS"] = False
        toolchain.cache_variables["PELLUCID_WINDOWS"] = False
        toolchain.cache_variables["CMAKE_DEBUG_POSTFIX"] = ""  # package_info names the libraries without one
        toolchain.generate()
        CMakeDeps(self).generate()
        PkgConfigDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # The package's own pellucidConfig.cmake serves: it has pellucid_add_shader() too.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "pellucid")]
        core = self.cpp_info.components["core"]
        core.set_property("pkg_config_name", "pellucid")
        core.libs = ["pellucid"]
        core.defines = ["GLM_FORCE_DEPTH_ZERO_TO_ONE", "GLM_FORCE_EXPLICIT_CTOR", "GLM_ENABLE_EXPERIMENTAL"]
        core.requires = ["glm::glm", "libpng::libpng", "libjpeg::libjpeg", "tinyexr::tinyexr", "tinygltf::tinygltf",
                         "nlohmann_json::nlohmann_json"]
        if self.options.tools:
            core.requires.append("cli11::cli11")
        self._component("vulkan", ["vulkan-headers::vulkan-headers"], ["PELLUCID_HAS_VULKAN=1", "VK_NO_PROTOTYPES"],
                        ["dl"])
        self._component("opengl", ["libepoxy::libepoxy"], ["PELLUCID_HAS_OPENGL=1"], [])
        self._component("reference", ["onetbb::onetbb"], [], [])

    def _component(self, name, requires, defines, system_libs):
        if not self.options.get_safe(name):
            return
        component = self.cpp_info.components[name]
        component.set_property("pkg_config_name", "pellucid-" + name)
        component.libs = ["pellucid_" + name]
        component.defines = defines
        component.system_libs = system_libs
        component.requires = ["core"] + requires
