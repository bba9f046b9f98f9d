import copy
import math
import pickle

import numpy as np
import pytest

import gearlash
from gearlash import Drive, InvalidInput

EXAMPLES = ["elinco-fd162.toml", "robot-joint.toml", "telescope-axis.toml", "normalized.toml",
            "antenna-field-controlled.toml", "instrument-two-phase.toml", "dynamixel-joint.toml",
            "toleranced-joint.toml"]


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_example_survives_repr_pickle_and_toml(example, name):
    drive = Drive.from_toml(example(name))
    assert eval(repr(drive), vars(gearlash)) == drive
    assert copy.deepcopy(drive) == copy.copy(drive) == pickle.loads(pickle.dumps(drive)) == drive
    nominal = drive.with_tolerances([])
    assert (nominal == drive) == (not drive.tolerances)
    assert Drive.from_toml(drive.to_toml()) == Drive(**drive.sections()) == drive
    assert hash(Drive(**drive.sections())) == hash(drive)
    assert all(path in drive for path in drive) and "no.such" not in drive


def test_numbers_are_in_si_and_texts_have_units(pd_drive):
    assert pd_drive["gearbox.backlash"] == 2e-3
    assert pd_drive["motor.inertia"] == pytest.approx(2e-6, rel=1e-15)
    assert pd_drive.controller.proportional == 20.0
    assert pd_drive["controller.kind"] == "PD"
    assert pd_drive["controller.kp"] == 20.0
    assert dict(pd_drive.gearbox)["ratio"] == 20.0
    assert {info.path for info in pd_drive.parameters()} >= set(pd_drive.to_dict())


def test_with_changes_numbers_words_and_sections(pd_drive):
    changed = pd_drive.with_({"controller.proportional": 30.0, "gearbox.backlash": np.float64(1e-3)})
    assert changed["controller.proportional"] == 30.0 and changed["gearbox.backlash"] == 1e-3
    assert pd_drive["controller.proportional"] == 20.0
    mixed = pd_drive.with_({"sensor.position": "motor", "gearbox.backlash": "6 arcmin",
                            "controller.proportional": 31})
    assert mixed["sensor.position"] == "motor" and mixed["controller.proportional"] == 31.0
    assert mixed["gearbox.backlash"] == pytest.approx(math.radians(0.1), rel=1e-15)
    sampled = pd_drive.with_({"sampling.period": "1 ms"})
    assert sampled["sampling.period"] == 1e-3
    assert sampled.with_({"sampling": None}) == pd_drive


def test_tolerances_are_part_of_a_drive(pd_drive, tmp_path):
    varied = (gearlash.ParameterTolerance("gearbox.backlash", gearlash.UniformBetween(1e-3, 3e-3)),
              gearlash.ParameterTolerance("load.inertia", gearlash.Normal(5e-3, 1e-4)))
    drive = pd_drive.with_tolerances(varied)
    assert drive.tolerances == varied and drive != pd_drive
    assert drive.with_tolerances([]) == pd_drive
    assert drive.gearbox.backlash == pd_drive.gearbox.backlash
    drive.save(tmp_path / "drive.toml")
    assert Drive.from_toml(tmp_path / "drive.toml") == drive
    # What is set has no tolerance, as with --set; what is not keeps its own.
    for changes in ({"gearbox.backlash": 2e-3}, {"gearbox.backlash": "2 mrad"},
                    {"gearbox.backlash": 2e-3, "sensor.position": "motor"}):
        assert [one.path for one in drive.with_(changes).tolerances] == ["load.inertia"]
    shared = pd_drive.with_({"gearbox.backlash": "2 mrad ± 10 %"})
    assert shared == pd_drive.with_({"gearbox.backlash": {"value": 2e-3, "tolerance": "10 %"}})
    assert shared.tolerances[0].distribution == gearlash.UniformAbout(2e-3, 2e-4)
    for bad in (gearlash.ParameterTolerance("no.such", gearlash.Normal(1, 1)),
                gearlash.ParameterTolerance("gearbox.backlash", gearlash.UniformBetween(-1, 1))):
        with pytest.raises(InvalidInput, match=bad.path):
            pd_drive.with_tolerances([bad])


def test_what_follows_another_parameter_still_does_in_copies(pd_drive):
    drive = pd_drive.with_({"motor.coulomb": 1e-4, "motor.friction": "1e-5 N m s/rad"})
    for copied in (drive, pickle.loads(pickle.dumps(drive)), Drive(**drive.sections()),
                   eval(repr(drive), {"Drive": Drive}), drive.with_tolerances([])):
        for coulomb in (2e-4, "0.2 mN m"):
            assert copied.with_({"motor.coulomb": coulomb})["motor.breakaway"] == 2e-4
        assert copied["motor.breakaway"] == copied.motor.breakaway == 1e-4


def test_a_drive_never_changes(pd_drive):
    with pytest.raises(AttributeError, match="with_"):
        pd_drive.controller = 3
    with pytest.raises(AttributeError, match="deleted"):
        del pd_drive._core


def test_a_signal_from_arrays_is_a_table(pd_drive):
    table = {"kind": "table", "times": np.array([0.0, 0.5, 1.0]), "values": [0.0, 0.1, 0.1]}
    drive = Drive(**{**pd_drive.sections(), "reference": table})
    assert drive["reference.times"] == [0.0, 0.5, 1.0]
    assert eval(repr(drive), {"Drive": Drive}) == drive
    assert pickle.loads(pickle.dumps(drive)) == drive
    motion = gearlash.simulate(drive, 0.9)
    assert motion.at([0.25]).reference[0] == pytest.approx(0.05)


def test_a_table_of_a_file_becomes_its_points(tmp_path, pd_drive):
    (tmp_path / "move.csv").write_text("time (s),position (deg)\n0,0\n1,90\n")
    text = pd_drive.to_toml() + '\n[reference]\nkind = "table"\nfile = "move.csv"\n'
    (tmp_path / "drive.toml").write_text(text)
    drive = Drive.from_toml(tmp_path / "drive.toml")
    assert drive["reference.values"] == pytest.approx([0.0, math.pi / 2])
    (tmp_path / "move.csv").unlink()
    assert Drive.from_toml(drive.to_toml()) == drive


def test_sections_can_be_copied(pd_drive):
    assert dict(copy.copy(pd_drive.motor)) == dict(pickle.loads(pickle.dumps(pd_drive.motor)))


def test_an_infinite_number_reads_back():
    massless = Drive.normal_form(0.19, math.inf, 0.1)
    assert eval(repr(massless), {"Drive": Drive}) == massless


def test_long_tables_can_be_sent(pd_drive):
    times = np.linspace(0.0, 10.0, 100_000)
    drive = Drive(**{**pd_drive.sections(),
                     "reference": {"kind": "table", "times": times, "values": np.sin(times)}})
    assert pickle.loads(pickle.dumps(drive)) == drive


def test_a_file_has_units_as_the_tool_demands(tmp_path):
    (tmp_path / "bare.toml").write_text("[motor]\nkind = \"torque-controlled\"\ninertia = 2e-6\n")
    with pytest.raises(InvalidInput, match="unit"):
        Drive.from_toml(tmp_path / "bare.toml")
    (tmp_path / "a=b.toml").write_text(Drive.normal_form(1, 1, 1).to_toml())
    assert Drive.from_toml(str(tmp_path / "a=b.toml")).is_normal_form


def test_all_faults_are_reported_at_once():
    with pytest.raises(InvalidInput) as caught:
        Drive(motor={"kind": "torque-controlled", "inertia": -1.0, "friction": "3 apples"},
              gearbox={"ratio": 0, "backlash": "2 mrad"}, load={"inertia": 1e-3, "frction": 1},
              controller={"kind": "P", "proportional": 1.0})
    faults = {fault.path: fault for fault in caught.value.faults}
    assert set(faults) >= {"motor.inertia", "motor.friction", "load.frction", "gearbox.ratio"}
    assert faults["motor.inertia"].permitted and faults["motor.inertia"].where == ""
    assert "motor.friction" in str(caught.value)
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.faults == caught.value.faults


def test_faults_of_a_file_have_their_place(tmp_path):
    (tmp_path / "bad.toml").write_text("[servo]\ndamping = -1\ninertia_ratio = 1\n"
                                       "friction_ratio = 0.1\nbacklash = 1\n")
    with pytest.raises(InvalidInput) as caught:
        Drive.from_toml(tmp_path / "bad.toml")
    assert caught.value.faults[0].where.endswith("bad.toml:2:11")


@pytest.mark.parametrize(("changes", "path"), [
    ({"controller.nonsense": 1.0}, "controller.nonsense"),
    ({"controller.nonsense": "1"}, "controller.nonsense"),
    ({"controller.nonsense": None}, "controller.nonsense"),
    ({"gearbox.backlash": -1.0}, "gearbox.backlash"),
    ({"gearbox.backlash": math.nan}, "gearbox.backlash"),
    ({"gearbox.backlash": "1 kg"}, "gearbox.backlash"),
    ({"sensor.position": "moon"}, "sensor.position")])
def test_bad_changes_name_the_path(pd_drive, changes, path):
    with pytest.raises(InvalidInput) as caught:
        pd_drive.with_(changes)
    assert caught.value.faults[0].path == path


def test_wrong_types_are_type_errors(pd_drive):
    with pytest.raises(TypeError):
        Drive(motor=3)
    with pytest.raises(TypeError, match="Drive"):
        gearlash.analyse("a drive")
    with pytest.raises(TypeError):
        Drive.normal_form("much", 2, 0.1)
    with pytest.raises(TypeError, match="text as keys"):
        pd_drive.with_({3: 1.0})
    with pytest.raises(OSError):
        Drive.from_toml("/nowhere/drive.toml")
    with pytest.raises(OSError, match="nowhere"):
        pd_drive.save("/nowhere/drive.toml")
    for odd in ("\x7f", "\U0001f600", '"]\n[x'):
        with pytest.raises(InvalidInput):
            Drive(motor={"kind": odd, odd: odd})
    with pytest.raises(AttributeError, match="sections"):
        _ = pd_drive.wheels


def test_a_notebook_shows_the_parameters(pd_drive):
    assert "gearbox.backlash" in pd_drive._repr_html_()
