#!/usr/bin/env python3
"""Checks the include rule: a layer includes only the layers that stand to its left.

    base <- servo <- motion <- cycle <- chart <- design <- io <- apps
              hybrid <- drive /             heritage uses all; no layer uses it

Nothing left of io prints, reads files or looks at clocks, so that the numerics compile for any
machine (WebAssembly too) and give the same answer wherever they are called from.

Usage: include_rule.py ROOT       prints every violation as file:line: reason; exit status 1 if any
"""

import pathlib
import re
import sys

# Layer -> the other layers that it may include.
PERMITTED_LAYERS = {
    "base": set(),
    "servo": {"base"},
    "motion": {"base", "servo"},
    "cycle": {"base", "servo", "motion"},
    "chart": {"base", "servo", "motion", "cycle"},
    "design": {"base", "servo", "motion", "cycle", "chart"},
    "hybrid": set(),
    "drive": {"base", "servo", "motion", "cycle", "hybrid"},
    "io": {"base", "servo", "motion", "cycle", "chart", "design", "hybrid", "drive"},
    "heritage": {"base", "servo", "motion", "cycle", "chart", "design", "hybrid", "drive", "io"},
}

# Layer left of io -> the libraries that its .cpp files and private headers may include.
PERMITTED_LIBRARIES = {
    "base": (),
    "servo": (),
    "motion": ("boost/math/",),
    "cycle": ("boost/math/", "boost/multiprecision/", "Eigen/",
              "unsupported/Eigen/AutoDiff"),
    "chart": ("boost/math/", "Eigen/", "xsimd/", "tbb/", "oneapi/tbb"),
    "design": ("boost/math/", "boost/random/", "Eigen/", "tbb/", "oneapi/tbb"),
    "hybrid": ("boost/math/", "Eigen/", "unsupported/Eigen/MatrixFunctions"),
    "drive": ("boost/math/", "boost/multiprecision/", "Eigen/",
              "unsupported/Eigen/MatrixFunctions"),
}

# What the public headers of the numerics may include: users of an installed Gearlash then need that
# package too, and gearlashConfig.cmake must find it.
PERMITTED_IN_PUBLIC_HEADERS = {"base": (), "servo": (), "motion": (), "cycle": ("Eigen/",),
                               "chart": ("Eigen/",)}

PRINTS_OR_READS = {
    "iostream", "istream", "ostream", "fstream", "syncstream", "print", "cstdio", "stdio.h",
    "filesystem", "unistd.h", "fcntl.h", "dirent.h",
}
LOOKS_AT_CLOCKS = {"chrono", "ctime", "time.h", "sys/time.h"}
# The standard library of Emscripten's clang 14 lacks these.
NOT_IN_WEB_ASSEMBLY = {"format", "ranges", "source_location", "stop_token"}

FORBIDDEN_NAMES = {"utils", "util", "common", "helpers", "helper", "misc"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
CPP_SUFFIXES = {".hpp", ".cpp", ".h"}


def reason_against_layer(layer, name):
    """Why `layer` may not include the project header `name` ("gearlash/cycle/..."), or None."""
    parts = name.split("/")
    if len(parts) == 2:  # gearlash/version.hpp stands left of every layer
        return None
    other = parts[1]
    if other not in PERMITTED_LAYERS:
        return f"includes {name}: {other} is no layer of the include rule"
    if other != layer and other not in PERMITTED_LAYERS[layer]:
        permitted = ", ".join(sorted(PERMITTED_LAYERS[layer])) or "no other layer"
        return f"{layer} includes {name}: it may include {permitted}"
    return None


def reason_against_outside_header(layer, name, public):
    """Why `layer`, left of io, may not include the header `name` of another project, or None."""
    if name in PRINTS_OR_READS:
        return f"{layer} includes <{name}>: nothing left of io prints or reads files"
    if name in LOOKS_AT_CLOCKS:
        return f"{layer} includes <{name}>: nothing left of io looks at clocks"
    if name in NOT_IN_WEB_ASSEMBLY:
        return f"{layer} includes <{name}>: it must also compile for WebAssembly with clang 14"
    if "/" not in name and "." not in name:  # the rest of the standard library
        return None
    libraries = PERMITTED_LIBRARIES[layer]
    what = layer
    if public:
        libraries = PERMITTED_IN_PUBLIC_HEADERS.get(layer, libraries)
        what = f"public header of {layer}"
    if name.startswith(libraries):
        return None
    permitted = ", ".join(libraries) or "the standard library alone"
    return f"{what} includes <{name}>: it may include {permitted}"


def reasons_against(layer, file, public):
    """(line, reason) for each include of `file` that breaks the rule."""
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quoted, name = match.group(1) == '"', match.group(2)
        reason = None
        if name.startswith("gearlash/"):
            reason = reason_against_layer(layer, name)
        elif quoted and not (file.parent / name).is_file():
            reason = f"includes \"{name}\", which is not beside it: write gearlash/<layer>/<file>"
        elif ".." in name.split("/"):
            reason = f"includes \"{name}\": a path may not climb out of its layer"
        elif not quoted and layer in PERMITTED_LIBRARIES:
            reason = reason_against_outside_header(layer, name, public)
        if reason:
            yield number, reason


def forbidden_names(root):
    """Files and folders whose name says nothing of what they hold."""
    for top in ("include", "src", "apps", "tests", "benchmarks", "python", "web", "scripts"):
        for path in sorted((root / top).rglob("*")):
            if path.stem in FORBIDDEN_NAMES and "node_modules" not in path.parts:
                yield f"{path.relative_to(root)}: a name that says nothing of what it holds"


def violations(root):
    """Every violation below `root`, as "file:line: reason"."""
    found = list(forbidden_names(root))
    for top, public in ((root / "include" / "gearlash", True), (root / "src", False)):
        for folder in sorted(path for path in top.glob("*") if path.is_dir()):
            if folder.name not in PERMITTED_LAYERS:
                found.append(f"{folder.relative_to(root)}: no layer of the include rule")
                continue
            for file in sorted(folder.rglob("*")):
                if file.suffix in CPP_SUFFIXES:
                    where = file.relative_to(root)
                    for line, reason in reasons_against(folder.name, file, public):
                        found.append(f"{where}:{line}: {reason}")
    return found


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[0])
    if not (root / "include" / "gearlash").is_dir():
        print(f"ROOT = {root}: must hold include/gearlash", file=sys.stderr)
        return 2
    found = violations(root)
    for violation in found:
        print(violation)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
