"""Reads what C++ headers declare: structs with their members, enumerations, variants.

The headers are written in one style. A member is declared on lines of its own, its comment stands
above it (///) or behind it (///<). A function without arguments that has a comment behind it is a
member too, which is computed: `[[nodiscard]] double frequency() const { return 1.0 / period; }  ///< Hz`.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Member:
    name: str
    type: str
    default: str
    comment: str
    is_computed: bool = False

    @property
    def unit(self) -> str:
        """With which its comment begins; empty without."""
        found = re.match(r"(rad/s|rad|s|Hz|N m|N|J|kg m²|kg|m)(?![\w/ ²])", self.comment)
        return found[1] if found else ""

    def is_opened(self, struct: "Struct") -> bool:
        """Whether its own members stand in its place: what a document says of a drive, and how it
        was made."""
        return bool(struct.document) and self.name in ("answer", "provenance")


@dataclass
class Struct:
    header: Path
    name: str
    namespace: str
    comment: str
    body: str

    @property
    def members(self) -> list[Member]:
        return [member for member in self.all_members if not member.is_computed]

    @property
    def all_members(self) -> list[Member]:
        """The computed ones too."""
        return [member for declaration in join_declarations(self.body)
                for member in members_of(*declaration, self.name)]

    @property
    def document(self) -> str | None:
        """ "gearlash/design/3" of a struct whose comment names the document that it is."""
        found = re.search(r'"(gearlash/[\w-]+/\d+)"', self.comment)
        return found[1] if found else None


@dataclass
class Enumeration:
    header: Path
    name: str
    namespace: str
    members: list[str]
    words: list[str]  # what name_of() gives
    is_named: bool = False  # it has name_of()


@dataclass
class Variant:
    header: Path
    namespace: str
    kinds: list[str]


@dataclass
class Source:
    """What the headers declare. Names are without their namespaces."""

    structs: dict[str, Struct] = field(default_factory=dict)
    enumerations: dict[str, Enumeration] = field(default_factory=dict)
    variants: dict[str, Variant] = field(default_factory=dict)
    aliases: dict[str, str] = field(default_factory=dict)
    ambiguous: set[str] = field(default_factory=set)

    def all_types(self) -> dict[str, "Struct | Enumeration | Variant"]:
        return {**self.structs, **self.enumerations, **self.variants}

    def add(self, to: dict, name: str, of: "Struct | Enumeration | Variant") -> None:
        """Types of one name in two namespaces cannot be told apart."""
        if name in to and to[name].namespace != of.namespace:
            self.ambiguous.add(name)
        to[name] = of


def plain(name: str) -> str:
    """A type without namespace: "drive::DescribedPart" is DescribedPart."""
    return name.split("<")[0].rsplit("::", 1)[-1] if not name.startswith("std::") else name


def inner_types(name: str) -> tuple[str, list[str]]:
    """The template and its arguments: std::optional<double> is ("optional", ["double"])."""
    found = re.fullmatch(r"(?:std::)?(\w+)<(.*)>", name)
    if not found:
        return "", []
    return found[1], [argument.strip().removeprefix("const ") for argument in split(found[2])]


def may_be_null(member: Member) -> bool:
    """A number by "NaN" in its comment, a text by "empty", or one that says why something is not."""
    if member.type.startswith("std::string"):
        return "empty" in member.comment.lower() or member.comment.startswith("why ")
    return member.type == "double" and "NaN" in member.comment + member.default


def comment_of(lines: list[str]) -> str:
    return " ".join(line.strip().lstrip("/").lstrip("<").strip() for line in lines).strip()


def join_declarations(body: str) -> list[tuple[str, str, str]]:
    """Declarations of a struct's body, each with its comment and what of it stands behind it."""
    found: list[tuple[str, str, str]] = []
    above: list[str] = []
    pending = behind = ""
    depth = 0
    for line in body.splitlines():
        code, mark, note = line.partition("///")
        code, _, _ = code.partition("//")
        code = code.strip()
        if mark and note.startswith("<"):
            if code:
                pending = f"{pending} {code}".strip()
                above.append(note)
                behind = comment_of([note])
            elif found and not pending:
                more = comment_of([note])
                declaration, comment, last = found[-1]
                found[-1] = (declaration, f"{comment} {more}".strip(), f"{last} {more}".strip())
            else:
                above.append(note)
        elif mark and not code:
            if not pending and not depth:
                above.append(note)
        else:
            pending = f"{pending} {code}".strip()
        depth = pending.count("{") - pending.count("}")
        if depth == 0 and pending.endswith((";", "}")):
            found.append((pending.rstrip(";").strip(), comment_of(above), behind))
            pending, above, behind = "", [], ""
        elif not code and not mark:
            above = []
    return found


def members_of(declaration: str, comment: str, behind: str, struct: str) -> list[Member]:
    """The members that one declaration declares; none for other functions and constants."""
    computed = re.match(r"\[\[nodiscard\]\] ([\w:<>, ]+) (\w+)\(\) const", declaration)
    if computed and behind:
        return [Member(computed[2], computed[1], "", behind, is_computed=True)]
    if declaration.startswith(("static", "[[nodiscard]]", "bool operator", "friend", "auto")):
        return []
    head = declaration.split("=")[0].split("{")[0]
    if "(" in head.split("<")[0]:
        return []
    match = re.match(r"((?:std::)?[\w:]+(?:<.*>)?)\s+(\w+\s*(?:[={,].*)?)$", declaration)
    if match is None:
        raise SystemExit(f"{struct}: cannot read the declaration: {declaration}")
    type_name, rest = match.groups()
    members = []
    for part in split(rest):
        name, _, default = part.partition("=")
        if "{" in name:
            name, default = name.split("{")[0], ""
        members.append(Member(name.strip(), type_name, default.strip(), comment))
    return members


def split(text: str) -> list[str]:
    """Splits at commas outside brackets."""
    parts, depth, part = [], 0, ""
    for character in text:
        depth += character in "({<["
        depth -= character in ")}>]"
        if character == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += character
    return parts + [part]


def namespace_at(header: str, place: int) -> str:
    opened = re.findall(r"^namespace ([\w:]+) {", header[:place], re.M)
    closed = re.findall(r"^}  // namespace ([\w:]+)", header[:place], re.M)
    return [name for name in opened if opened.count(name) > closed.count(name)][-1]


def read(path: Path, source: Source) -> None:
    header = path.read_text(encoding="utf-8")
    above = r"((?:^///[^\n]*\n)*)"
    for match in re.finditer(rf"{above}^struct (\w+) {{\n(.*?)^}};", header, re.M | re.S):
        comment, name, body = match.groups()
        source.add(source.structs, name, Struct(path, name, namespace_at(header, match.start()),
                                                comment_of(comment.splitlines()), body))
    for match in re.finditer(r"^enum class (\w+)[^{;]*\{([^}]*)\};", header, re.M):
        name, body = match.groups()
        members = re.findall(r"\w+", re.sub("//.*", "", body))
        source.add(source.enumerations, name,
                   Enumeration(path, name, namespace_at(header, match.start()), members,
                               list(members)))
    for match in re.finditer(r"^using (\w+) =\s+std::variant<([^;]*)>;", header, re.M):
        source.add(source.variants, match[1],
                   Variant(path, namespace_at(header, match.start()),
                           [kind.strip() for kind in split(match[2])]))
    for name, of in re.findall(r"^using (\w+) = (std::(?!variant)[^;]*);", header, re.M):
        source.aliases[name] = of
    for above, name in re.findall(rf"{above}[^\n]*name_of\((\w+) ", header, re.M):
        if enumeration := source.enumerations.get(name):
            enumeration.is_named = True
            enumeration.words = words_by(comment_of(above.splitlines()), enumeration.members)


def words_by(comment: str, members: list[str]) -> list[str]:
    """The words of an enumeration by the comment on its name_of(); none if that lists others."""
    quoted = re.findall('"([^"]+)"', comment)
    if len(quoted) == len(members):
        return quoted
    if "with spaces" in comment:
        return [name.replace("_", " ") for name in members]
    return members if "numerator's name" in comment else []


def needed(source: Source, roots: list[str]) -> set[str]:
    """The names of the types that the roots have in them."""
    found: set[str] = set()
    todo = list(roots)
    while todo:
        name = todo.pop()
        _, arguments = inner_types(name)
        if arguments:
            todo += arguments
            continue
        name = plain(name)
        if name in found or name == "Drive":  # which is written by its parameters
            continue
        if name in source.ambiguous:
            raise SystemExit(f"{name} is declared in two namespaces")
        found.add(name)
        if name in source.structs:
            todo += [member.type for member in source.structs[name].all_members]
        elif name in source.variants:
            todo += source.variants[name].kinds
        elif name in source.aliases:
            todo.append(source.aliases[name])
    return found


def part_of(source: Source, names: set[str]) -> Source:
    """What the source has of these names."""
    return Source(*({name: of for name, of in all_of.items() if name in names} for all_of in
                    (source.structs, source.enumerations, source.variants, source.aliases)))


PROJECT = Path(__file__).resolve().parent.parent


def is_public(header: Path) -> bool:
    return header.parent.name == "gearlash" and header.parent.parent.name == "include"


def read_all(headers: list[Path]) -> tuple[Source, list[Path]]:
    """What the headers and those that they include declare, and all that were read: a header stands
    after those that it includes."""
    read_ones: list[Path] = []

    def add(header: Path) -> None:
        if header in visited:
            return
        visited.add(header)
        for name in re.findall(r'^#include "([^"]+)"', header.read_text(encoding="utf-8"), re.M):
            for folder in (PROJECT / "include", PROJECT / "src"):
                if (folder / name).exists():
                    add(folder / name)
        read_ones.append(header)

    visited: set[Path] = set()
    for header in headers:
        add(header)
    source = Source()
    for header in read_ones:
        read(header, source)
    return source, read_ones


def write(path: Path, text: str) -> None:
    """Leaves a file alone that would not change."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
