#!/usr/bin/env python3
"""Checks the include rule: a room includes only the rooms that stand before it in this list.

    base, numeric, model, hybrid, closed_form, general, question, input, output, picture, thesis

hybrid knows nothing of gears: it includes only base and numeric. closed_form and general do not
know each other. No room includes thesis. Nothing before input prints, reads files or looks at
clocks, so that the numerics compile for any machine (WebAssembly too) and give the same answer
wherever they are called from. Public headers, in include/gearlash, include no room at all.

The faces (apps, python, web) are clients: they include public headers alone, but for the verbs of the
thesis and for what inner_headers_of_faces.txt lists. Nothing is added to that list, and what no face
includes any more is removed from it.

Usage: include_rule.py ROOT       prints every fault as file:line: reason; exit status 1 if any
"""

import pathlib
import re
import sys

NUMERICS = ("base", "numeric", "model", "hybrid", "closed_form", "general", "question")
MODEL = {"base", "numeric", "model"}

# Room -> the other rooms that it may include.
PERMITTED_ROOMS = {
    "base": set(),
    "numeric": {"base"},
    "model": {"base", "numeric"},
    "hybrid": {"base", "numeric"},
    "closed_form": MODEL,
    "general": MODEL | {"hybrid"},
    "question": MODEL | {"hybrid", "closed_form", "general"},
    "input": set(NUMERICS),
    "output": set(NUMERICS) | {"input"},
    "picture": set(NUMERICS) | {"input", "output"},
    "thesis": set(NUMERICS) | {"input", "output", "picture"},
}

# Room of the numerics -> the libraries that it may include. Eigen's decompositions are compiled once,
# in numeric; other rooms take them from numeric/linear_algebra.hpp.
EIGEN = ("Eigen/", "unsupported/Eigen/MatrixFunctions")
MATRICES = "Eigen/Core"
PERMITTED_LIBRARIES = {
    "base": ("boost/math/", "tbb/"),
    "numeric": ("boost/math/", "nlopt.h", *EIGEN),
    "model": ("boost/math/", "boost/multiprecision/"),
    "hybrid": ("boost/math/", MATRICES),
    "closed_form": ("boost/math/", "boost/multiprecision/", MATRICES,
                    "unsupported/Eigen/AutoDiff", "xsimd/"),
    "general": ("boost/math/", "boost/multiprecision/", MATRICES),
    "question": ("boost/math/", "boost/multiprecision/", "boost/random/", MATRICES, "tbb/"),
}

PRINTS_OR_READS = {
    "iostream", "istream", "ostream", "fstream", "syncstream", "print", "cstdio", "stdio.h",
    "filesystem", "unistd.h", "fcntl.h", "dirent.h",
}
LOOKS_AT_CLOCKS = {"chrono", "ctime", "time.h", "sys/time.h"}
# The standard library of Emscripten's clang 14 lacks these.
NOT_IN_WEB_ASSEMBLY = {"format", "ranges", "source_location", "stop_token"}

FACES = ("apps", "python", "web")
LIST_OF_FACES = pathlib.Path("tests/architecture/inner_headers_of_faces.txt")

FORBIDDEN_NAMES = {"utils", "util", "common", "helpers", "helper", "misc"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
CPP_SUFFIXES = {".hpp", ".cpp", ".h"}


def reason_against_room(room, name):
    """Why `room` may not include the header `name` ("closed_form/..."), or None."""
    other = name.split("/")[0]
    if other == "gearlash":  # the public interface stands before every room
        return None
    if other not in PERMITTED_ROOMS:
        return f'includes "{name}": {other} is no room of the include rule'
    if other != room and other not in PERMITTED_ROOMS[room]:
        permitted = ", ".join(sorted(PERMITTED_ROOMS[room])) or "no other room"
        return f"{room} includes {name}: it may include {permitted}"
    return None


def reason_against_outside_header(room, name):
    """Why `room`, of the numerics, may not include the header `name` of another project, or None."""
    if name in PRINTS_OR_READS:
        return f"{room} includes <{name}>: nothing before input prints or reads files"
    if name in LOOKS_AT_CLOCKS:
        return f"{room} includes <{name}>: nothing before input looks at clocks"
    if name in NOT_IN_WEB_ASSEMBLY:
        return f"{room} includes <{name}>: it must also compile for WebAssembly with clang 14"
    if "/" not in name and "." not in name:  # the rest of the standard library
        return None
    libraries = PERMITTED_LIBRARIES[room]
    if name.startswith(libraries):
        return None
    return f"{room} includes <{name}>: it may include {', '.join(libraries)}"


def reason_against_public_include(quoted, name):
    """Why a public header may not include `name`, or None."""
    if name.startswith("gearlash/") or (not quoted and "/" not in name and "." not in name):
        return None
    return f"public header includes {name}: it may include gearlash/ and the standard library"


def reasons_against(room, file):
    """(line, reason) for each include of `file` that breaks the rule; no room: a public header."""
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quoted, name = match.group(1) == '"', match.group(2)
        reason = None
        if room is None:
            reason = reason_against_public_include(quoted, name)
        elif ".." in name.split("/"):
            reason = f'includes "{name}": write the whole path, <room>/<file>'
        elif name.split("/")[0] in PERMITTED_ROOMS or name.startswith("gearlash/"):
            reason = reason_against_room(room, name)
        elif quoted:
            reason = f'includes "{name}": write the whole path, <room>/<file>'
        elif room in PERMITTED_LIBRARIES:
            reason = reason_against_outside_header(room, name)
        if reason:
            yield number, reason


def forbidden_names(root):
    """Files and folders whose name says nothing of what they hold."""
    for top in ("include", "src", "apps", "tests", "benchmarks", "python", "web", "scripts"):
        for path in sorted((root / top).rglob("*")):
            if path.stem in FORBIDDEN_NAMES and "node_modules" not in path.parts:
                yield f"{path.relative_to(root)}: a name that says nothing of what it holds"


def cpp_files(folder):
    return [file for file in sorted(folder.rglob("*")) if file.suffix in CPP_SUFFIXES]


def inner_headers(face):
    """(file, line, header) for each header of a room that the face includes outside the thesis."""
    for file in cpp_files(face):
        if file.name.startswith("thesis") and face.name == "apps":
            continue
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
            match = INCLUDE.match(line)
            if match and match.group(2).split("/")[0] in PERMITTED_ROOMS:
                yield file, number, match.group(2)


def faults_of_faces(root):
    """What a face includes beyond public headers and the list, and what the list has in vain."""
    listed = root / LIST_OF_FACES
    permitted = set(listed.read_text(encoding="utf-8").split("\n")) - {""} if listed.exists() else set()
    used = set()
    for face in FACES:
        for file, line, header in inner_headers(root / face):
            used.add(f"{face} {header}")
            if f"{face} {header}" not in permitted:
                yield (f"{file.relative_to(root)}:{line}: {face} includes {header}: "
                       "a face includes public headers, gearlash/, alone")
    for entry in sorted(permitted - used):
        yield f"{LIST_OF_FACES}: no longer needed: {entry}"


def faults(root):
    """Every fault below `root`, as "file:line: reason"."""
    found = [*forbidden_names(root), *faults_of_faces(root)]
    folders = [(None, root / "include" / "gearlash")]
    for folder in sorted(path for path in (root / "src").glob("*") if path.is_dir()):
        if folder.name in PERMITTED_ROOMS:
            folders.append((folder.name, folder))
        else:
            found.append(f"{folder.relative_to(root)}: no room of the include rule")
    for room, folder in folders:
        for file in cpp_files(folder):
            where = file.relative_to(root)
            found += [f"{where}:{line}: {why}" for line, why in reasons_against(room, file)]
    return found


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[0])
    if not (root / "src").is_dir():
        print(f"ROOT = {root}: must hold src", file=sys.stderr)
        return 2
    found = faults(root)
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
