"""run_conanfile.py CONANFILE DIRECTORY VERSION [CMAKE OPTION...]: what `conan create` does with a recipe, its steps in
their order with real cmake, by stand-ins for the parts of Conan 2 that the recipe uses. Conan itself is not needed.

The package is in DIRECTORY/package then.
"""
import fnmatch
import importlib.util
import shutil
import subprocess
import sys
import types
from pathlib import Path

CONANFILE, DIRECTORY = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
OPTIONS = sys.argv[4:]


class ConanFile:
    def __init__(self):
        self.recipe_folder = str(CONANFILE.parent)
        self.export_sources_folder = self.source_folder = str(DIRECTORY / "sources")
        self.build_folder = str(DIRECTORY / "build")
        self.package_folder = str(DIRECTORY / "package")
        self.info = types.SimpleNamespace(clear=lambda: None)
        self.properties = {}
        self.cpp_info = types.SimpleNamespace(
            bindirs=["bin"], libdirs=["lib"], includedirs=["include"], set_property=self.properties.__setitem__)


class CMakeToolchain:
    def __init__(self, conanfile):
        self.conanfile = conanfile
        self.cache_variables = {}

    def generate(self):
        self.conanfile.variables = self.cache_variables


class CMake:
    def __init__(self, conanfile):
        self.conanfile = conanfile

    def configure(self):
        variables = [f"-D{key}={'ON' if value is True else 'OFF' if value is False else value}"
                     for key, value in self.conanfile.variables.items()]
        subprocess.run(["cmake", "-S", self.conanfile.source_folder, "-B", self.conanfile.build_folder, *variables,
                        *OPTIONS], check=True, stdout=subprocess.DEVNULL)

    def install(self):
        subprocess.run(["cmake", "--install", self.conanfile.build_folder, "--prefix", self.conanfile.package_folder],
                       check=True, stdout=subprocess.DEVNULL)


def copy(_, pattern, src, dst):
    """Files whose path below src fits; Conan's, too, keeps that path and is silent if there are none."""
    files = [Path(src, pattern)] if Path(src, pattern).is_file() else Path(src).rglob("*")
    for file in files:
        place = file.relative_to(src)
        if file.is_file() and fnmatch.fnmatch(str(place), pattern):
            (dst / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(file, dst / place)


def module(name, **contents):
    sys.modules[name] = types.ModuleType(name)
    vars(sys.modules[name]).update(contents)


module("conan", ConanFile=ConanFile)
module("conan.tools")
module("conan.tools.cmake", CMake=CMake, CMakeToolchain=CMakeToolchain, cmake_layout=lambda conanfile: None)
module("conan.tools.files", copy=copy, load=lambda _, path: Path(path).read_text())


def main():
    shutil.rmtree(DIRECTORY, ignore_errors=True)
    sys.dont_write_bytecode = True
    spec = importlib.util.spec_from_file_location("recipe", CONANFILE)
    recipe_module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(recipe_module)
    (recipe_class,) = [c for c in vars(recipe_module).values()
                       if isinstance(c, type) and issubclass(c, ConanFile) and c is not ConanFile]
    recipe = recipe_class()
    recipe.set_version()
    assert recipe.version == sys.argv[3], f"the recipe's version is {recipe.version}"
    recipe.export_sources()
    recipe.recipe_folder = str(DIRECTORY / "recipe")  # in Conan's cache: the clone is out of sight from here on
    for step in ("layout", "generate", "build", "package", "package_id", "package_info"):
        getattr(recipe, step)()
    package = Path(recipe.package_folder)
    for folder in recipe.cpp_info.includedirs + recipe.cpp_info.libdirs + recipe.cpp_info.builddirs:
        assert (package / folder).is_dir(), f"package_info() names {folder}, which is not there"
    assert (package / "licenses" / "LICENSE").is_file(), "the license is not in the package"
    if recipe.properties.get("cmake_find_mode") == "none":
        config = [p for d in recipe.cpp_info.builddirs for p in (package / d).glob("shortshotConfig.cmake")]
        assert config, "nothing for find_package(), and Conan is told to write nothing"


if __name__ == "__main__":
    main()
