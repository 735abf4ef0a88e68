#!/usr/bin/env python3
"""Runs the vcpkg port and the Conan recipe as their tools do, with stand-ins for what the recipes call: neither tool is a package
of Debian.
    recipes_test.py SOURCE VERSION GENERATED WORK [--build]
Without --build it ends once both builds are configured. With it, both build, install, and a host of either is built and run.
"""
import fnmatch
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import types

source, version, generated, work = (pathlib.Path(a) if i != 1 else a for i, a in enumerate(sys.argv[1:5]))
build = "--build" in sys.argv


def run(*command):
    """What a command said, which must end well and take all of its options."""
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode or "not used by the project" in done.stdout:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


def run_host(prefix, config, shared):
    """A host in C and C++ that finds the package below prefix."""
    at = work / "host"
    shutil.rmtree(at, ignore_errors=True)
    run("cmake", "-S", source / "tests/packaging/consumer", "-B", at, "-G", "Ninja", "-DHOW=package", "-DLANGUAGES=C;CXX",
        f"-DVERSION={version}", f"-Dsupple_DIR={prefix / config}")
    run("cmake", "--build", at)
    for program in ("consumer_c", "consumer_cpp"):
        print(f"{prefix.name}, {'shared' if shared else 'static'}: {run(at / program).strip()}", flush=True)


# ---- vcpkg

manifest = json.loads((source / "packaging/vcpkg/supple/vcpkg.json").read_text())
assert manifest["version"] == version, f"vcpkg.json has version {manifest['version']}"
for linkage, features in (("static", "cpu;draco;meshopt"), ("dynamic", "")):
    if linkage == "dynamic" and build:
        features = "cpu"  # which the host calls
    run("cmake", f"-DSOURCE={source}", f"-DWORK={work / 'vcpkg'}", f"-DGENERATED={generated}", f"-DLINKAGE={linkage}",
        f"-DFEATURES={features}", f"-DBUILD={'ON' if build else 'OFF'}", "-P", source / "tests/packaging/vcpkg_port.cmake")
    cache = (work / "vcpkg/build/CMakeCache.txt").read_text()
    for feature in manifest["features"]:
        wanted = "ON" if feature in features.split(";") else "OFF"
        assert f"SUPPLE_WITH_{feature.upper()}:BOOL={wanted}" in cache, f"{linkage}: {feature} is not {wanted}"
    if build:
        run_host(work / "vcpkg/packages", "share/supple", linkage == "dynamic")
print("vcpkg: configured, static with all features and shared without any" if not build else "vcpkg: built", flush=True)


# ---- Conan

class ConanFile:
    """What the recipe uses of Conan's class."""

    def __init__(self):
        self.options = types.SimpleNamespace(**self.default_options)
        self.settings = types.SimpleNamespace(os="Linux")
        self.cpp_info = types.SimpleNamespace(properties={})
        self.cpp_info.set_property = self.cpp_info.properties.__setitem__
        self.needs = []

    def requires(self, reference, **_):
        self.needs.append(reference)

    tool_requires = requires


class CMakeToolchain:
    def __init__(self, recipe):
        self.cache_variables = {}
        recipe.toolchain = self

    def generate(self):
        pass


class CMakeDeps(CMakeToolchain):
    def __init__(self, recipe):
        pass


class CMake:
    def __init__(self, recipe):
        self.recipe = recipe

    def configure(self):
        recipe = self.recipe
        run("cmake", "-S", recipe.source_folder, "-B", recipe.build_folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            f"-DCMAKE_INSTALL_PREFIX={recipe.package_folder}", "-DCMAKE_INSTALL_LIBDIR=lib", f"-DSUPPLE_COMPILED_SHADERS={generated}",
            *(f"-D{name}={'ON' if value else 'OFF'}" for name, value in recipe.toolchain.cache_variables.items()))

    def build(self):
        if build:
            run("cmake", "--build", self.recipe.build_folder)

    def install(self):
        if build:
            run("cmake", "--install", self.recipe.build_folder)


def copy(_, pattern, src, dst):
    """Conan's: the files below src whose paths from there match, to the same paths below dst."""
    copied = 0
    src = pathlib.Path(src)
    top = src / pattern.split("/")[0].split("*")[0]
    for path in [top] if top.is_file() else sorted(top.rglob("*")):
        name = str(path.relative_to(src))
        if path.is_file() and fnmatch.fnmatch(name, pattern):
            target = pathlib.Path(dst) / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, target)
            copied += 1
    assert copied, f"no file is {pattern}"


def module(name, **members):
    sys.modules[name] = types.ModuleType(name)
    vars(sys.modules[name]).update(members)


module("conan", ConanFile=ConanFile)
module("conan.tools")
module("conan.tools.build", check_min_cppstd=lambda recipe, standard: None)
module("conan.tools.cmake", CMake=CMake, CMakeDeps=CMakeDeps, CMakeToolchain=CMakeToolchain, cmake_layout=lambda recipe: None)
module("conan.tools.files", copy=copy, load=lambda recipe, path: pathlib.Path(path).read_text(),
       rmdir=lambda recipe, path: shutil.rmtree(path, ignore_errors=True))
spec = importlib.util.spec_from_file_location("recipe", source / "packaging/conan/conanfile.py")
recipe_module = importlib.util.module_from_spec(spec)
sys.dont_write_bytecode = True
spec.loader.exec_module(recipe_module)

for shared in (False, True):
    recipe = recipe_module.SuppleConan()
    at = work / "conan"
    shutil.rmtree(at, ignore_errors=True)
    recipe.recipe_folder = str(source / "packaging/conan")
    recipe.export_sources_folder = recipe.source_folder = str(at / "source")
    recipe.build_folder, recipe.package_folder = str(at / "build"), str(at / "packages")
    recipe.options.shared = shared
    recipe.options.with_draco = not shared
    recipe.set_version()
    assert recipe.version == version, f"the recipe has version {recipe.version}"
    for step in ("export_sources", "layout", "requirements", "build_requirements", "validate", "generate", "build", "package",
                 "package_info"):
        getattr(recipe, step)()
    assert any(need.startswith("draco/") for need in recipe.needs) == (not shared), recipe.needs
    assert recipe.cpp_info.properties["cmake_find_mode"] == "none"
    if build:
        run_host(at / "packages", recipe.cpp_info.builddirs[0], shared)

# What the library's build looks for must be something that the recipes bring.
brought = {re.sub(r"[-_]", "", need.split("/")[0]) for need in recipe.needs}
ported = {re.sub(r"[-_]", "", d if isinstance(d, str) else d["name"]) for d in manifest["dependencies"]} - {"vcpkgcmake",
                                                                                                          "vcpkgcmakeconfig"}
assert brought - {"cmake", "meshoptimizer"} == ported, f"Conan {sorted(brought)}, vcpkg {sorted(ported)}"
print("Conan: " + ("built" if build else "configured from the exported sources, static and shared"))
