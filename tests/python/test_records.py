"""Every record, made from the headers of C++, keeps what it holds on the way there and back."""

import ast
import dataclasses
import pickle
import re
import sys
from fractions import Fraction
from math import inf  # noqa: F401  repr of infinite bounds
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

import gearlash
from gearlash import _core, _records

NAMES = sorted(_core.default_records())


@pytest.mark.parametrize("name", NAMES)
def test_defaults_are_those_of_cpp(name):
    made = getattr(_records, name)()
    assert made == _core.default_records()[name]


@pytest.mark.parametrize("name", NAMES)
def test_a_record_survives_repr_pickle_and_cpp(name):
    record = getattr(_records, name)()
    if name in ("TolerancedDrive", "TunedDrive", "PictureQuestion"):  # of which an empty drive is no sound one
        member = "nominal" if name == "TolerancedDrive" else "drive"
        record = dataclasses.replace(record, **{member: gearlash.Drive.normal_form(1, 1, 1)})
    if name == "TuneTask":
        series = gearlash.TolerancedDrive(gearlash.Drive.normal_form(1, 1, 1))
        record = dataclasses.replace(record, series=series)
    assert eval(repr(record), vars(gearlash)) == record
    assert pickle.loads(pickle.dumps(record)) == record
    assert name in record._repr_html_() or name == "Answer"
    if not name.endswith("Info"):
        assert _core.there_and_back(record) == record


def test_an_answer_survives_as_a_whole(servo, pd_drive):
    for drive in (servo, pd_drive):
        answer = gearlash.analyse(drive, loop=True)
        space = {**vars(gearlash), "inf": inf}
        assert eval(repr(answer), space) == answer
        assert pickle.loads(pickle.dumps(answer)) == answer
        assert dataclasses.replace(_core.there_and_back(answer), drive=drive) == answer


def test_every_word_comes_back():
    for name, words in _core.words().items():
        assert len(set(words)) == len(words), name
        assert all(words)


def test_records_take_keywords_and_refuse_changes():
    start = gearlash.Start(load_position=0.1, gap_speed=2.0)
    assert start.load_speed == 0.0 and start.gap is None
    with pytest.raises(dataclasses.FrozenInstanceError):
        start.gap = 1.0
    with pytest.raises(TypeError):
        gearlash.Start(position=1.0)


def test_sequences_are_kept_as_tuples():
    axis = gearlash.Axis("gearbox.backlash", np.array([1e-3, 2e-3]))
    assert axis == gearlash.Axis("gearbox.backlash", [1e-3, 2e-3])
    assert axis.values == (1e-3, 2e-3) and hash(axis)
    with pytest.raises(TypeError, match="values"):
        gearlash.Axis("sensor.position", "load")
    with pytest.raises(TypeError, match="values"):
        gearlash.Axis("gearbox.backlash", 1e-3)


def test_reading_a_record_keeps_no_reference(servo):
    before = sys.getrefcount(gearlash.Start)
    for _ in range(100):
        gearlash.simulate(servo, 0.1, start=gearlash.Start(load_position=0.1))
    assert sys.getrefcount(gearlash.Start) < before + 10


def test_a_wrong_member_is_named(servo):
    for wrong in ("far", "0.5", b"0.5", True, [0.5], np.array([0.5])):
        with pytest.raises(TypeError, match="load_position"):
            gearlash.simulate(servo, 1.0, start=gearlash.Start(load_position=wrong))
    for right in (1, np.float32(0.5), np.array(0.5), Fraction(1, 2)):
        gearlash.simulate(servo, 1.0, start=gearlash.Start(load_position=right))
    with pytest.raises(gearlash.InvalidInput, match="hunts if disturbed"):
        _core.there_and_back(gearlash.Answer(verdict="perhaps"))


def declared_in_the_stub():
    """Functions and methods of _core.pyi, with the numbers of their parameters; None for any."""
    tree = ast.parse(Path(_core.__file__).with_name("_core.pyi").read_text(encoding="utf-8"))
    counts = {}

    def take(prefix, body):
        for node in body:
            if isinstance(node, ast.FunctionDef):
                given = node.args
                count = len(given.posonlyargs) + len(given.args)
                is_property = any(isinstance(one, ast.Name) and one.id == "property"
                                  for one in node.decorator_list)
                counts[prefix + node.name] = None if given.vararg or is_property else count
            elif isinstance(node, ast.ClassDef):
                take(f"{node.name}.", node.body)

    take("", tree.body)
    return counts


def test_the_stub_declares_what_the_library_has():
    found = {}
    for name, value in vars(_core).items():
        members = {f"{name}.{key}": one for key, one in vars(value).items()
                   if not key.startswith("_") or key == "__init__"} if isinstance(value, type) else {
                   name: value}
        for path, one in members.items():
            if callable(one) or isinstance(one, property):
                found[path] = one
    stub = declared_in_the_stub()
    loader = {"__loader__"}
    constructed = {path for path in found if path.endswith(".__init__") and path not in stub}
    assert set(found) - loader - constructed == set(stub)
    for name, count in stub.items():
        if count is not None:
            head = found[name].__doc__.partition(") ->")[0]
            assert len(re.findall(r"\w+: ", head)) == count, head


def test_words_in_types_are_those_of_cpp():
    for name, words in _core.words().items():
        assert get_args(getattr(_records, name)) == words
