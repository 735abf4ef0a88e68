import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

required_conan_version = ">=2.0"

# The recipe lies in Supple's own sources and takes these along.
SOURCES = ("CMakeLists.txt", "LICENSE", "base/*", "cage/*", "cmake/*", "cpu/*", "docs/*.md", "docs/*.json", "gpu/*", "runtime/*",
           "shaders/*", "skinning/*", "surface/*")


class SuppleConan(ConanFile):
    name = "supple"
    description = "Animated control cages to smooth surfaces on Vulkan compute"
    license = "MIT"
    topics = ("vulkan", "animation", "subdivision", "gltf")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {
        "shared": [True, False],
        "fPIC": [True, False],
        "with_cpu": [True, False],
        "with_draco": [True, False],
        "with_meshopt": [True, False],
    }
    default_options = {
        "shared": False,
        "fPIC": True,
        "with_cpu": True,
        "with_draco": True,
        "with_meshopt": True,
    }
    implements = ["auto_shared_fpic"]

    @property
    def _sources(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        lists = load(self, os.path.join(self._sources, "CMakeLists.txt"))
        self.version = re.search(r"project\(supple VERSION ([0-9.]+)", lists).group(1)

    def export_sources(self):
        for pattern in SOURCES:
            copy(self, pattern, self._sources, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        # supple.h includes the headers of Vulkan.
        self.requires("vulkan-headers/[>=1.3.239 <2]", transitive_headers=True)
        self.requires("glm/[>=0.9.9.8]")
        self.requires("nlohmann_json/[>=3.11 <4]")
        self.requires("xxhash/[>=0.8.1 <0.9]")
        if self.options.with_draco:
            self.requires("draco/[>=1.5 <2]")
        if self.options.with_meshopt:
            self.requires("meshoptimizer/[>=0.15 <1]")

    def build_requirements(self):
        # Shaders are compiled on the machine that builds.
        self.tool_requires("cmake/[>=3.25]")
        self.tool_requires("glslang/[>=1.3.239 <2]")
        self.tool_requires("spirv-tools/[>=1.3.239 <2]")

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SUPPLE_BUILD_SHARED"] = bool(self.options.shared)
        toolchain.cache_variables["SUPPLE_BUILD_BOTH"] = False
        toolchain.cache_variables["SUPPLE_BUILD_TOOLS"] = False
        toolchain.cache_variables["SUPPLE_BUILD_TESTS"] = False
        toolchain.cache_variables["SUPPLE_INSTALL"] = True
        toolchain.cache_variables["SUPPLE_WITH_CPU"] = bool(self.options.with_cpu)
        toolchain.cache_variables["SUPPLE_WITH_DRACO"] = bool(self.options.with_draco)
        toolchain.cache_variables["SUPPLE_WITH_MESHOPT"] = bool(self.options.with_meshopt)
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        rmdir(self, os.path.join(self.package_folder, "share", "doc"))

    def package_info(self):
        # Supple's own suppleConfig.cmake is taken: it knows supple_SHADER_DIR.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "supple")]
        self.cpp_info.set_property("pkg_config_name", "supple")
        self.cpp_info.libs = ["supple"]
        if self.options.shared:
            self.cpp_info.defines = ["SUPPLE_SHARED"]
