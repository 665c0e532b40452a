"""Do the manifests say what is so, by the rules of those that read them? Each rule has a copy that breaks it.

manifests.py ROOT: prints what is wrong; the exit code is 1 if anything is.
"""
import json
import re
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import yaml

ROOT = Path(sys.argv[1])
HEADER = "single_include/shortshot.hpp"


def properties(text):
    """Arduino's format: one name=value a line."""
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return dict(line.split("=", 1) for line in lines)


READERS = {
    "CITATION.cff": yaml.safe_load,
    "colcon.pkg": json.loads,
    "idf_component.yml": yaml.safe_load,
    "library.json": json.loads,
    "package.xml": xml.fromstring,
    "packaging/arduino/library.properties": properties,
    "packaging/vcpkg/shortshot/vcpkg.json": json.loads,
    "zephyr/module.yml": yaml.safe_load,
}


def strings(value):
    """A string, or a list of them, as many fields may be; empty if it is neither."""
    values = value if isinstance(value, list) else [value]
    return values if all(isinstance(v, str) for v in values) else []


def check_fields(where, rules, known=()):
    """Each field of `rules` is there and all its strings match; nothing has a name that nobody knows."""
    for key, pattern in rules.items():
        values = strings(where.get(key))
        if not values or not all(re.fullmatch(pattern, v) for v in values):
            yield f"bad {key}"
    for key in where:
        if key not in rules and key not in known:
            yield f"unknown key {key}"


def there(path):
    if not (ROOT / path).exists():
        yield f"no file {path}"


def check_citation(cff):
    yield from check_fields(cff, {
        "cff-version": r"1\.2\.0", "message": ".+", "type": "software", "title": ".+", "version": ".+",
        "license": "BSD-3-Clause", "keywords": ".+"}, ["authors"])
    if not cff.get("authors") or not all("name" in a or "family-names" in a for a in cff["authors"]):
        yield "bad authors"


def check_colcon(package):
    yield from check_fields(package, {"cmake-args": "-D[A-Z_]+=OFF"})
    options = re.findall(r"option\((\w+)", (ROOT / "CMakeLists.txt").read_text())
    for argument in strings(package.get("cmake-args")):
        if re.sub("^-D|=.*", "", argument) not in options:
            yield f"no option {argument}"


def check_idf(component):
    yield from check_fields(component, {
        "version": r"\d+\.\d+\.\d+", "description": ".{1,255}", "license": "BSD-3-Clause", "tags": "[a-z-]{3,32}"},
        ["dependencies", "files"])
    if "idf" not in component.get("dependencies", {}):
        yield "bad dependencies"
    for pattern in strings(component.get("files", {}).get("exclude")):
        folder = pattern.removesuffix("/**/*")
        if folder == "single_include" or not (ROOT / folder).is_dir():
            yield f"bad exclude {pattern}"


def check_platformio(library):
    yield from check_fields(library, {
        "name": "[^:;/,@<>]{1,100}", "version": r"\d+\.\d+\.\d+", "description": ".{1,255}",
        "keywords": r"[a-z\d_+. -]{1,50}", "license": "BSD-3-Clause", "frameworks": r"\*|[a-z\d_-]+",
        "platforms": r"\*|[a-z\d_-]+", "headers": r"[\w./]+\.(h|hpp)"},
        ["homepage", "repository", "authors", "examples", "dependencies", "export", "scripts", "build"])
    build, exported = library.get("build"), library.get("export")
    if not isinstance(build, dict) or not isinstance(exported, dict):
        yield "build or export is no object"
        return
    yield from check_fields(build, {"includeDir": "[a-z_]+", "srcFilter": "-<\\*>"})  # or bench/ is compiled
    yield from check_fields(exported, {"include": ".+"}, ["exclude"])
    packed = strings(exported.get("include"))
    if len(packed) < 2:  # one folder alone would become the package's root
        yield "bad export"
    for file in packed:
        yield from there(file)
    for header in strings(library.get("headers")):
        if f"{build.get('includeDir')}/{header}" not in packed:
            yield f"not exported: {header}"
        yield from there(f"{build.get('includeDir')}/{header}")


def check_ros(package):
    def one(tag, pattern):
        found = [e.text or "" for e in package.iter(tag)]
        if len(found) != 1 or not re.fullmatch(pattern, found[0]):
            yield f"bad {tag}"
    if package.tag != "package" or package.get("format") != "3":
        yield "not of format 3"
    for tag, pattern in {"name": "shortshot", "version": r"\d+\.\d+\.\d+", "description": ".+", "maintainer": ".+",
                         "license": "BSD-3-Clause", "buildtool_depend": "cmake", "build_type": "cmake"}.items():
        yield from one(tag, pattern)
    if not re.fullmatch(r"\S+@\S+\.\S+", package.find("maintainer").get("email", "")):
        yield "bad email"
    yield from there(package.find("license").get("file", "license's file"))


def check_arduino(library):
    yield from check_fields(library, {
        "name": "[A-Za-z0-9][A-Za-z0-9_. -]{0,62}", "version": r"\d+\.\d+\.\d+", "author": ".+",
        "maintainer": ".+<.+@.+>", "license": "BSD-3-Clause", "sentence": ".+", "paragraph": ".+",
        "category": "Data Processing", "url": "https://.+", "architectures": r"[a-z\d]+(,[a-z\d]+)*",
        "includes": r"\w+\.h"})
    yield from there("packaging/arduino/src/" + library.get("includes", "includes"))


def check_vcpkg(port):
    yield from check_fields(port, {
        "name": "[a-z0-9]+(-[a-z0-9]+)*", "version": r"\d+(\.\d+)*", "description": ".+", "license": "BSD-3-Clause"},
        ["dependencies", "homepage"])
    yield from there(f"packaging/vcpkg/{port.get('name')}/portfile.cmake")


def check_zephyr(module):
    yield from check_fields(module, {"name": "[a-z]+"}, ["build"])
    build = module.get("build", {})
    yield from check_fields(build, {"cmake": "[a-z/]+", "kconfig": "[A-Za-z/]+"})
    yield from there(f"{build.get('cmake')}/CMakeLists.txt")
    yield from there(str(build.get("kconfig")))


CHECKS = {
    "CITATION.cff": check_citation, "colcon.pkg": check_colcon, "idf_component.yml": check_idf,
    "library.json": check_platformio, "package.xml": check_ros, "packaging/arduino/library.properties": check_arduino,
    "packaging/vcpkg/shortshot/vcpkg.json": check_vcpkg, "zephyr/module.yml": check_zephyr}

VERSION = ".".join(re.findall(r"VERSION_(?:MAJOR|MINOR|PATCH) (\d+)\n",
                              (ROOT / "include/shortshot/version.hpp").read_text()))


def faults(file, text):
    try:
        manifest = READERS[file](text)
        found = list(CHECKS[file](manifest))
        version = manifest.findtext("version") if isinstance(manifest, xml.Element) else manifest.get("version")
        name = manifest.findtext("name") if isinstance(manifest, xml.Element) else manifest.get("name", "shortshot")
    except (ValueError, AttributeError, yaml.YAMLError, xml.ParseError) as error:
        return [f"cannot be read: {error}"]
    if version != VERSION and file not in ("colcon.pkg", "zephyr/module.yml"):
        found.append(f"version is {version}, not {VERSION}")
    return found + (["name is not shortshot"] if name != "shortshot" else [])


# (file, a piece of it, what takes its place, what is to be found)
BROKEN = [(file, r"(?s)\A.*", "", "") for file in CHECKS] + [
    (file, re.escape(VERSION), "9.9.9", "version is 9.9.9") for file in CHECKS
    if file not in ("colcon.pkg", "zephyr/module.yml")] + [
    (file, "BSD-3-Clause", "MIT", "bad license") for file in CHECKS
    if file not in ("colcon.pkg", "zephyr/module.yml")] + [
    ("CITATION.cff", "  - name:", "  - nam:", "bad authors"),
    ("CITATION.cff", "message:", "mesage:", "bad message"),
    ("colcon.pkg", "BUILD_BENCH", "BUILD_BENCHES", "no option -DSHORTSHOT_BUILD_BENCHES"),
    ("colcon.pkg", "=OFF", "=ON", "bad cmake-args"),
    ("idf_component.yml", "bench/", "bank/", "bad exclude bank"),
    ("idf_component.yml", '"include/', '"single_include/', "bad exclude single_include"),
    ("idf_component.yml", "idf:", "esp:", "bad dependencies"),
    ("library.json", r"}\s*\Z", ",}", "cannot be read"),
    ("library.json", '"name": "shortshot"', '"name": "short/shot"', "bad name"),
    ("library.json", '"point cloud"', '"Point Cloud"', "bad keywords"),
    ("library.json", '"platforms"', '"plattforms"', "unknown key plattforms"),
    ("library.json", '"shortshot.hpp"', '"shot.hpp"', "not exported: shot.hpp"),
    ("library.json", '"-<\\*>"', '"+<*>"', "bad srcFilter"),
    ("library.json", '"includeDir"', '"includedir"', "bad includeDir"),
    ("library.json", '"README.md"', '"READ.me"', "no file READ.me"),
    ("library.json", r'"build": {', '"build": 1, "built": {', "build or export is no object"),
    ("package.xml", 'format="3"', 'format="2"', "not of format 3"),
    ("package.xml", "<build_type>cmake", "<build_type>ament_cmake", "bad build_type"),
    ("package.xml", 'email="', 'email=" ', "bad email"),
    ("package.xml", "</export>", "</exports>", "cannot be read"),
    ("packaging/arduino/library.properties", "shortshot\\.h", "shot.h", "no file packaging/arduino/src/shot.h"),
    ("packaging/arduino/library.properties", "category=D", "category=d", "bad category"),
    ("packaging/vcpkg/shortshot/vcpkg.json", '"shortshot"', '"Shortshot"', "bad name"),
    ("zephyr/module.yml", "cmake: zephyr", "cmake: zephir", "no file zephir/CMakeLists.txt"),
    ("zephyr/module.yml", "kconfig:", "kconfigs:", "unknown key kconfigs"),
]


def main():
    texts = {file: (ROOT / file).read_text() for file in CHECKS}
    wrong = [f"{file}: {fault}" for file, text in texts.items() for fault in faults(file, text)]
    if not (ROOT / "LICENSE").read_text().startswith("BSD 3-Clause License\n"):
        wrong.append("LICENSE is not BSD-3-Clause")
    for file, piece, other, expected in BROKEN:
        broken = re.sub(piece, lambda _: other, texts[file], count=1)
        found = faults(file, broken)
        if broken == texts[file] or not any(expected in fault for fault in found):
            wrong.append(f"{file} with {other!r} for {piece!r}: '{expected}' is not found, but {found}")
    print("\n".join(wrong) or f"{len(texts)} manifests, {len(BROKEN)} broken copies")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
