# SPDX-License-Identifier: MIT
"""Calls every method of Conan's recipe with a stand-in for Conan that writes down what it is asked for.

    python3 conan.py SOURCE_FOLDER
Conan itself is not needed, and what its registry has is not looked at.
"""
import importlib.util
import os
import re
import sys
import types

source = sys.argv[1]
problems = []


def check(truth, sentence):
    if not truth:
        problems.append(sentence)


class Options(dict):
    __getattr__ = dict.__getitem__

    def get_safe(self, name):
        return self.get(name)


class Component:
    def __init__(self):
        self.properties, self.requires, self.libs, self.defines, self.system_libs = {}, [], [], [], []

    def set_property(self, name, value):
        self.properties[name] = value


class Package(Component):
    def __init__(self):
        super().__init__()
        self.components = {}
        self.components = type("Components", (dict,), {"__missing__": lambda s, k: s.setdefault(k, Component())})()


class ConanFile:
    def __init__(self, folder):
        self.recipe_folder, self.source_folder = folder, source
        self.package_folder, self.export_sources_folder = "/package", "/export"
        self.options = Options(getattr(self, "default_options", {}))
        self.settings = types.SimpleNamespace(os="Linux")
        self.cpp_info = Package()
        self.cpp = types.SimpleNamespace(build=types.SimpleNamespace(bindir="."))
        self.tested_reference_str = "pellucid/0.1.0"
        self.required, self.tools, self.ran = [], [], []

    def requires(self, reference, **traits):
        self.required.append(reference)

    def tool_requires(self, reference):
        self.tools.append(reference)

    def run(self, command, env=None):
        self.ran.append(command)


class Generator:
    made = []

    def __init__(self, conanfile):
        self.cache_variables = {}

    def generate(self):
        Generator.made.append(self)


class CMakeToolchain(Generator):
    pass


class CMake:
    calls = []

    def __init__(self, conanfile):
        pass

    def __getattr__(self, name):
        return lambda *arguments, **named: CMake.calls.append((name, named))


copied = []
validated = []


def module(name, **members):
    sys.modules[name] = types.ModuleType(name)
    vars(sys.modules[name]).update(members)


module("conan", ConanFile=ConanFile)
module("conan.errors", ConanInvalidConfiguration=type("ConanInvalidConfiguration", (Exception,), {}))
module("conan.tools")
module("conan.tools.build", check_min_cppstd=lambda c, s: validated.append(s), can_run=lambda c: True)
module("conan.tools.cmake", CMake=CMake, CMakeDeps=type("CMakeDeps", (Generator,), {}), CMakeToolchain=CMakeToolchain,
       cmake_layout=lambda c: None)
module("conan.tools.files", copy=lambda c, pattern, src, dst: copied.append((pattern, src)))
module("conan.tools.gnu", PkgConfigDeps=type("PkgConfigDeps", (Generator,), {}))


def load(path, name):
    spec = importlib.util.spec_from_file_location("recipe", os.path.join(source, path, "conanfile.py"))
    recipe = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    spec.loader.exec_module(recipe)
    return getattr(recipe, name)(os.path.join(source, path))


with open(os.path.join(source, "CMakeLists.txt"), encoding="utf-8") as file:
    cmake = file.read()
options = set(re.findall(r"option\((PELLUCID_\w+)", cmake))
version = re.search(r"project\(pellucid VERSION ([0-9.]+)", cmake).group(1)

for everything in (False, True):
    Generator.made.clear()
    CMake.calls.clear()
    recipe = load("scripts/packaging/conan", "PellucidConan")
    check(recipe.version == version, f"the recipe is of version {recipe.version}, the project of {version}")
    for name in ("vulkan", "opengl", "reference", "tools"):
        check(name in recipe.options and recipe.options[name] in (True, False), f"the recipe has no option {name}")
        recipe.options[name] = everything
    for step in ("export_sources", "layout", "requirements", "build_requirements", "validate", "generate", "build",
                 "package", "package_info"):
        getattr(recipe, step)()
    variables = next(made for made in Generator.made if isinstance(made, CMakeToolchain)).cache_variables
    for name in variables:
        check(name in options or name.startswith("CMAKE_"), f"{name} is no option of CMakeLists.txt")
    for name in ("PELLUCID_VULKAN", "PELLUCID_OPENGL", "PELLUCID_REFERENCE", "PELLUCID_SAMPLES"):
        check(variables.get(name) is everything, f"{name} is {variables.get(name)} with all features {everything}")
    check(variables.get("PELLUCID_INSTALL") is True, "PELLUCID_INSTALL is not on")
    components = {"core", "vulkan", "opengl", "reference"} if everything else {"core"}
    check(set(recipe.cpp_info.components) == components, f"components: {sorted(recipe.cpp_info.components)}")
    # Conan refuses a package that is required and used by no component, and the reverse.
    used = {name.split("::")[0] for part in recipe.cpp_info.components.values() for name in part.requires if "::" in name}
    required = {reference.split("/")[0] for reference in recipe.required}
    check(used == required, f"components use {sorted(used)}, the recipe requires {sorted(required)}")
    check([name for name, _ in CMake.calls] == ["configure", "build", "install"], f"CMake was asked for {CMake.calls}")
for pattern, folder in copied:
    path = os.path.join(folder, pattern.removesuffix("/*"))
    check(os.path.exists(path), f"the recipe copies {path}, which is not there")
check(validated == [20, 20], "the recipe does not ask for C++20")

recipe = load("scripts/packaging/conan", "PellucidConan")
recipe.settings.os = "Windows"
try:
    recipe.validate()
    check(False, "the recipe accepts Windows")
except sys.modules["conan.errors"].ConanInvalidConfiguration:
    pass

CMake.calls.clear()
test = load("scripts/packaging/conan/test_package", "PellucidTestConan")
for step in ("requirements", "build_requirements", "layout", "build", "test"):
    getattr(test, step)()
folder = CMake.calls[0][1]["build_script_folder"]
check(os.path.exists(os.path.join(folder, "CMakeLists.txt")), f"{folder} holds no project")
check(len(test.ran) == 1 and "minimal" in test.ran[0], f"the test runs {test.ran}")

for sentence in problems:
    print(sentence, file=sys.stderr)
print(f"conan recipe: {len(problems)} problems")
sys.exit(1 if problems else 0)
