"""Tables of reference numbers: how they are drawn, written and read back."""

import dataclasses
import math
import pathlib
import random
from collections.abc import Callable, Sequence

from mpmath import mp, mpf

TESTS = pathlib.Path(__file__).resolve().parents[1]
ABSENT = "nan"


def short(number):
    """Seven digits, which take less room in a table; a double is as odd then as before."""
    return float(f"{number:.7g}")


class Draws(random.Random):
    """The distributions that the tests of C++ draw from, too."""

    def uniform(self, low, high):
        return short(super().uniform(low, high))

    def log_uniform(self, low, high):
        return short(math.exp(super().uniform(math.log(low), math.log(high))))

    def happens(self, probability):
        return self.random() < probability

    def either_sign(self, low, high):
        return self.choice((-1.0, 1.0)) * self.log_uniform(low, high)


@dataclasses.dataclass
class Family:
    """Inputs of one kind: some that are drawn, or those listed."""

    kind: str
    count: int = 0
    draw: Callable = None  # (Draws) -> inputs; drawn again where exact() says None
    listed: Sequence = ()


@dataclasses.dataclass
class Table:
    name: str  # room/table
    about: str  # what stands in it, by which formula
    inputs: str  # names of columns; numbers are exact doubles
    outputs: str
    exact: Callable  # (kind, *inputs) -> outputs, or None for inputs that do not belong here
    families: Sequence[Family]
    seed: int
    digits: int = 21
    sample: int = 8  # rows that a check repeats

    def path(self, folder=None):
        room, name = self.name.split("/")
        return (folder / room if folder else TESTS / room / "data") / (name + ".dat")

    def row(self, kind, inputs):
        outputs = self.exact(kind, *inputs)
        if outputs is None:
            return None
        return " ".join([kind, *map(repr, inputs), *(self.text(x) for x in outputs)])

    def text(self, number):
        if number is None or mp.isnan(number):
            return ABSENT
        return mp.nstr(mpf(number), self.digits, min_fixed=-4, max_fixed=6)

    def header(self):
        lines = [*self.about.splitlines(), "Written by tests/references/make, and checked by it."]
        return [f"# {line}" for line in lines] + [f"kind {self.inputs} {self.outputs}"]

    def write(self, folder=None, times=1):
        """`times` as many of those that are drawn, by another seed where it is not 1."""
        lines = self.header()
        draws = Draws(self.seed * times)
        for family in self.families:
            lines += [self.row(family.kind, inputs) for inputs in family.listed]
            last = len(lines) + family.count * times
            while len(lines) < last:
                row = self.row(family.kind, family.draw(draws))
                if row is not None:
                    lines.append(row)
        path = self.path(folder)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return len(lines) - len(self.header())

    def faults(self, sample):
        """What a sample of the rows, evenly spread, should say instead. All of them for None."""
        lines = self.path().read_text(encoding="utf-8").splitlines()
        header = self.header()
        if lines[: len(header)] != header:
            return [f"{self.path()}: its head is not that of its recipe"]
        rows = lines[len(header) :]
        count = len(rows) if sample is None else min(sample, len(rows))
        chosen = [rows[(2 * i + 1) * len(rows) // (2 * count)] for i in range(count)]
        width = 1 + len(self.inputs.split())
        found = []
        for row in chosen:
            kind, *inputs = row.split()[:width]
            again = self.row(kind, [float(x) for x in inputs])
            if again != row:
                found.append(f"{self.path()}: {row}\n  should be {again}")
        return found
