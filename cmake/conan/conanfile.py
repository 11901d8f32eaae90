"""Core and plugin as a Conan 2 package. In a clone of the repository: conan create cmake/conan.

Untried beyond its build steps.
"""

import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class OctoBlisk(ConanFile):
    name = "octoblisk"
    version = "0.1.0"
    license = "Zlib"
    description = "An exact, movable concave collision shape for Bullet"
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"fPIC": [True, False]}
    default_options = {"fPIC": True}
    requires = "eigen/[>=3.4 <4]", "highway/[>=1.0 <2]", "bullet3/[>=3.24 <4]"

    def config_options(self):
        if self.settings.os == "Windows":
            del self.options.fPIC

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in "CMakeLists.txt", "CHANGELOG.md", "LICENSE", "cmake/*", "core/*", "plugin/*":
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def is_float64(self):
        return bool(self.dependencies["bullet3"].options.get_safe("double_precision", False))

    def generate(self):
        toolchain = CMakeToolchain(self)
        for option in "DEMOS", "TESTS":
            toolchain.cache_variables["OCTOBLISK_BUILD_" + option] = False
        toolchain.cache_variables["OCTOBLISK_BUILD_BULLET"] = not self.is_float64()
        toolchain.cache_variables["OCTOBLISK_BUILD_BULLET_FLOAT64"] = self.is_float64()
        toolchain.generate()
        dependencies = CMakeDeps(self)  # with the names that the build and Highway's own package use
        dependencies.set_property("highway", "cmake_file_name", "hwy")
        dependencies.set_property("highway::hwy", "cmake_target_name", "hwy::hwy")
        dependencies.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        plugin = "bullet_float64" if self.is_float64() else "bullet"
        self.cpp_info.set_property("cmake_file_name", "OctoBlisk")
        core = self.cpp_info.components["core"]
        core.set_property("cmake_target_name", "OctoBlisk::core")
        core.libs = ["octoblisk-core"]
        core.requires = ["eigen::eigen", "highway::hwy"]
        if self.settings.os in ("Linux", "FreeBSD"):
            core.system_libs = ["pthread", "m"]
        component = self.cpp_info.components[plugin]
        component.set_property("cmake_target_name", "OctoBlisk::" + plugin)
        component.libs = ["octoblisk-" + plugin.replace("_", "-")]
        component.requires = ["core", "bullet3::bullet3"]
        if self.is_float64():
            component.defines = ["BT_USE_DOUBLE_PRECISION"]
