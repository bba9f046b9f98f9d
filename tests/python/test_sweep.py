import json

import numpy as np
import pandas
import pytest
import xarray

import gearlash


def test_axes_give_the_grid(servo):
    data = gearlash.sweep(servo, {"servo.damping": "0.1:0.4:4", "servo.inertia_ratio": [1.0, 2.0]},
                          ["amplitude", "period", "growth_at_rest"])
    assert isinstance(data, xarray.Dataset)
    assert data["amplitude"].dims == ("damping", "inertia_ratio")
    one = gearlash.analyse(servo.with_({"servo.damping": 0.1, "servo.inertia_ratio": 2.0}))
    point = data.sel(damping=0.1, inertia_ratio=2.0)
    assert float(point["amplitude"]) == pytest.approx(one.value("amplitude"), rel=1e-12)
    assert data["amplitude"].attrs["units"] == "rad"
    assert gearlash.verdict_words(data)[0, 1] == "hunts"


def test_a_decimal_that_is_no_double_is_rounded_as_on_the_axes_of_the_tool(tool, tmp_path):
    edge = gearlash.Drive.normal_form(0.5, 2, 0.5, 0.3)
    for values in ("0.19", [0.19], "0.1:0.4:4", ["0.19", "1/4"]):
        assert gearlash._sweep.grid_of(edge, {"servo.damping": values})[0] == edge
    for values in ("0.1900000000000000000001,0.2", ["0.1900000000000000000001"], "1/3"):
        varied, axes = gearlash._sweep.grid_of(edge, {"damping": values})
        assert "rounded-numbers" in [note.code for note in gearlash.analyse(varied).notes]
        assert [one.path for one in axes] == ["servo.damping"]
    # Only without any friction of the motor it is a theorem that it hunts.
    words = {}
    for end in ("1", "0.99999999999999999999"):
        data = gearlash.sweep(edge, {"servo.friction_ratio": f"0.5,{end}"}, proved=True)
        words[end] = gearlash.verdict_words(data).tolist()
        tool("chart", "--damping", "0.5", "--inertia-ratio", "2", "--backlash", "0.3", "--x",
             f"friction_ratio=0.5,{end}", "--proved", "--output", tmp_path / "chart.csv")
        told = pandas.read_csv(tmp_path / "chart.csv", comment="#")["verdict"].tolist()
        assert told == words[end]
    assert words["1"][1] == "hunts" and words["0.99999999999999999999"][1] == "undecided"


def test_arrays_are_broadcast_and_equal_the_grid_to_the_bit(servo):
    dampings, ratios = np.linspace(0.05, 0.6, 40), np.geomspace(0.1, 10, 30)
    grid = gearlash.sweep(servo, {"servo.damping": dampings, "servo.inertia_ratio": ratios},
                          ["amplitude", "multiplier"])
    same = gearlash.sweep(servo, arrays={"servo.damping": dampings[:, None],
                                         "servo.inertia_ratio": ratios},
                          quantities=["amplitude", "multiplier"])
    for name in ("amplitude", "multiplier", "verdict"):
        assert np.array_equal(grid[name].values, same[name].values, equal_nan=True), name
    zipped = gearlash.sweep(servo, arrays={"servo.damping": dampings[:30],
                                           "servo.inertia_ratio": ratios})
    assert zipped["amplitude"].shape == (30,)
    assert np.array_equal(zipped["amplitude"].values, np.diag(grid["amplitude"].values[:30]),
                          equal_nan=True)


def test_columns_are_memory_of_cpp(servo):
    _, columns = gearlash._core.evaluate_grid(
        servo, [gearlash.linear("servo.damping", 0.1, 0.5, 1000)], ["amplitude"], False, None)
    column = columns["amplitude"]
    assert not column.flags.owndata
    del columns
    assert np.isfinite(column).all()


def test_a_searched_drive_and_words(pd_drive, tool, tmp_path):
    axes = {"sensor.position": ["load", "motor"], "gearbox.backlash": "1 mrad, 2 mrad"}
    data = gearlash.sweep(pd_drive, axes, ["amplitude", "motor_amplitude"])
    assert data["sensor_position"].values.tolist() == ["load", "motor"]
    one = gearlash.analyse(pd_drive.with_({"sensor.position": "motor", "gearbox.backlash": 2e-3}))
    assert float(data["motor_amplitude"].sel(sensor_position="motor",
                                             gearbox_backlash=2e-3)) == pytest.approx(
        one.value("motor_amplitude"), rel=1e-6)
    listed = gearlash.sweep(pd_drive, arrays={"gearbox.backlash": [1e-3, 2e-3]},
                            quantities=["amplitude"])
    assert listed["amplitude"].values == pytest.approx(data["amplitude"].values[0], rel=1e-6)


def test_the_tool_maps_the_same(example, tool, tmp_path):
    file = tmp_path / "map.csv"
    tool("map", example("elinco-fd162.toml"), "--x", "gearbox.backlash=1 arcmin:1 deg:7",
         "--y", "controller.proportional=50 V/rad:300 V/rad:5", "--output", file)
    drive = gearlash.Drive.from_toml(example("elinco-fd162.toml"))
    data = gearlash.sweep(drive, {"gearbox.backlash": "1 arcmin:1 deg:7",
                                  "controller.proportional": "50 V/rad:300 V/rad:5"}, ["amplitude"])
    table = pandas.read_csv(file, float_precision="round_trip")
    told = {(row.gearbox_backlash_rad, row.controller_proportional_V_per_rad): row.amplitude_rad
            for row in table.itertuples()}
    for point, amplitude in data["amplitude"].stack(point=data["amplitude"].dims).to_series().items():
        assert told[point] == amplitude


@pytest.mark.parametrize("name", ["camera-head.toml", "first-servo.toml"])
def test_a_quantity_is_wherever_quantities_are(name, example, tool, tmp_path):
    """The mesh torque, in closed form and of a drive that is searched."""
    file = example(name)
    one = json.loads(tool("limit-cycle", file, "--format", "json"))["cycles"][0]["mesh_torque"]
    drive = gearlash.Drive.from_toml(file)
    assert gearlash.analyse(drive).value("mesh_torque") == one > 0.0
    backlash = drive["gearbox.backlash"]
    axis = f"gearbox.backlash={0.9 * backlash!r} rad:{1.1 * backlash!r} rad:3"
    inertia = drive["load.inertia"]
    axes = ["--x", axis, "--y", f"load.inertia={inertia!r} kg m2,{1.01 * inertia!r} kg m2"]
    tool("map", file, *axes, "--quantity", "mesh_torque", "--output", tmp_path / "map.csv",
         "--plot", f"map={tmp_path / 'map.svg'}")
    table = pandas.read_csv(tmp_path / "map.csv", float_precision="round_trip")
    told = table[table["load_inertia_kg_m2"] == inertia]["mesh_torque_N_m"].to_numpy()
    assert told[1] == pytest.approx(one, rel=1e-6)
    assert told[0] < told[1] < told[2]
    assert "torque between the faces" in (tmp_path / "map.svg").read_text()
    tool("map", file, *axes, "--output", tmp_path / "map.nc")
    with xarray.open_dataset(tmp_path / "map.nc") as data:
        assert data["mesh_torque"].attrs["units"] == "N m"
        assert np.sort(data["mesh_torque"].values.ravel()) == pytest.approx(
            np.sort(table["mesh_torque_N_m"]), rel=1e-12)
    found = gearlash.design(drive, f"mesh-torque <= {one} N m", [axis])["gearbox.backlash"]
    assert found.intervals[-1].high == pytest.approx(backlash, rel=1e-3)


def test_the_data_are_named_as_in_the_files_of_the_tool(pd_drive, tool, tmp_path):
    axes = {"gearbox.backlash": "1 mrad:4 mrad:4:log", "sensor.position": "load,motor"}
    text = "".join(line for line in pd_drive.to_toml().splitlines(keepends=True)
                   if not line.startswith(("backlash", "position")))
    (tmp_path / "sweep.toml").write_text(
        f'[sweep]\naxes = {[f"{path} = {values}" for path, values in axes.items()]}\n'
        f'quantities = ["amplitude", "frequency"]\n{text}')
    tool("sweep", tmp_path / "sweep.toml", "--output", tmp_path / "map.nc")
    data = gearlash.sweep(pd_drive, axes, ["amplitude", "frequency"])
    with xarray.open_dataset(tmp_path / "map.nc") as told:
        assert set(told.variables) == set(data.variables)
        assert dict(told.sizes) == dict(data.sizes)
        assert {*told.coords} == {*data.coords}
        for name in told.variables:
            assert data[name].dims == told[name].dims, name
            if name != "sensor_position":  # words are text, and numbers in the file
                assert data[name].dtype == told[name].dtype, name
                assert np.array_equal(data[name], told[name], equal_nan=True), name
            for key, value in told[name].attrs.items():
                if (name, key) not in {("sensor_position", "words")}:
                    assert np.array_equal(data[name].attrs[key], value), (name, key)
        words = told["sensor_position"].attrs["words"].split()
        assert [words[int(at)] for at in told["sensor_position"]] == [*data["sensor_position"].values]
        assert {key: value for key, value in told.attrs.items() if key not in ("history", "sweep")
                } == {key: value for key, value in data.attrs.items() if key != "history"}


def test_an_axis_may_have_another_name_of_its_parameter(pd_drive):
    data = gearlash.sweep(pd_drive, {"backlash": [1e-3, 2e-3]}, ["amplitude"])
    assert data["amplitude"].dims == ("gearbox_backlash",)
    listed = gearlash.sweep(pd_drive, arrays={"backlash": [1e-3, 2e-3]}, quantities=["amplitude"])
    assert np.array_equal(data["gearbox_backlash"], listed["gearbox_backlash"])


def test_a_table_where_xarray_is_missing(servo, monkeypatch):
    axes = {"servo.damping": [0.1, 0.2]}
    data = gearlash.sweep(servo, axes)
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    table = gearlash.sweep(servo, axes)
    assert isinstance(table, gearlash.Table) and table.dims == ("damping",)
    assert np.array_equal(table["amplitude"], data["amplitude"])
    assert table["verdict"].tolist() == gearlash.verdict_words(data).tolist() == ["hunts", "hunts"]
    assert table.coords["damping"].tolist() == [0.1, 0.2]


@pytest.mark.parametrize(("arrays", "error"), [
    ({"servo.damping": [0.1, np.nan]}, ValueError),
    ({"servo.damping": ["a", "b"]}, TypeError),
    ({"servo.damping": [0.1, 0.2], "servo.backlash": [0.1, 0.2, 0.3]}, ValueError),
    ({"servo.damping": []}, ValueError),
    ({"servo.damping": [-1.0]}, gearlash.InvalidInput),
    ({"servo.nonsense": [1.0]}, gearlash.InvalidInput),
    ({"servo.damping": np.array([1 + 2j])}, TypeError)])
def test_bad_arrays(servo, arrays, error):
    with pytest.raises(error):
        gearlash.sweep(servo, arrays=arrays)


def test_bad_axes(servo):
    with pytest.raises(gearlash.InvalidInput, match="amplitudo"):
        gearlash.sweep(servo, {"servo.damping": [0.1]}, ["amplitudo"])
    with pytest.raises(gearlash.InvalidInput):
        gearlash.sweep(servo, {"servo.damping": "0.1:0.4"})
    with pytest.raises(gearlash.InvalidInput, match="points"):
        gearlash.sweep(servo, [gearlash.linear(f"servo.{name}", 0.1, 0.5, 1_000_000)
                               for name in ("damping", "friction_ratio")])
    with pytest.raises(ValueError, match="dimension"):
        gearlash.sweep(servo, {"servo.damping": np.zeros((2, 2))})
    with pytest.raises(TypeError):
        gearlash.sweep(servo)


def test_coordinates_are_copies(servo):
    dampings = np.array([0.1, 0.2, 0.3])
    data = gearlash.sweep(servo, arrays={"servo.damping": dampings})
    dampings[:] = 9.0
    assert data["damping"].values.tolist() == [0.1, 0.2, 0.3]


def test_an_axis_has_the_path_that_it_is_given_for(servo):
    with pytest.raises(ValueError, match="servo.backlash"):
        gearlash.sweep(servo, {"servo.damping": gearlash.linear("servo.backlash", 0.1, 0.2, 2)})
    with pytest.raises(TypeError, match="masked"):
        gearlash.sweep(servo, arrays={"servo.damping": np.ma.masked_equal([0.1, 0.2], 0.1)})


def test_huge_shapes_are_refused_before_memory_is_taken(servo):
    huge = np.broadcast_to(np.float64(0.1), (10**6, 10**6))
    with pytest.raises(ValueError, match="1,000,000,000 drives"):
        gearlash.sweep(servo, arrays={"servo.damping": huge})
    with pytest.raises(ValueError, match="1,000,000,000 drives"):
        gearlash.sweep(servo, arrays={"servo.damping": np.full((10**5, 1), 0.1),
                                      "servo.backlash": np.full(10**5, 0.1)})


def test_non_contiguous_arrays_and_other_types(servo):
    base = np.linspace(0.1, 0.5, 20)
    plain = gearlash.sweep(servo, arrays={"servo.damping": base[::2].copy()})["amplitude"].values
    for array in (base[::2], base[::2].astype(">f8"), base.repeat(2)[::4]):
        assert np.array_equal(
            gearlash.sweep(servo, arrays={"servo.damping": array})["amplitude"].values, plain,
            equal_nan=True)
    ints = gearlash.sweep(servo, arrays={"servo.inertia_ratio": np.array([1, 2])})
    assert ints["amplitude"].shape == (2,)
