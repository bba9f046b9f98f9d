"""What gearlash writes in NetCDF opens in xarray and in ncdump, and says what limit-cycle says.

xarray reads it by NetCDF's own library and by SciPy.
"""

import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

import xarray

TOOL = sys.argv.pop(1)
SEED = 1960
INPUTS = ["damping", "inertia_ratio", "friction_ratio", "backlash", "restitution"]
QUANTITIES = ["growth_at_rest", "amplitude", "motor_amplitude", "period", "frequency", "multiplier",
              "impact_speed", "mesh_torque", "engaged_time", "separated_time",
              "motor_friction_loss", "load_friction_loss", "impact_loss", "residual"]
SWEEP = """
[sweep]
axes = ["friction-ratio=0.05:0.95:7", "damping = 0.1, 0.2, 0.5", "inertia-ratio=1/9:9:11:log"]
[servo]
backlash = "12 arcmin"
[contact]
restitution = 0
"""


def run(*arguments):
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{arguments}: {done.stderr}")
    return done.stdout


def single_call(point):
    options = [text for name in INPUTS
               for text in ("--" + name.replace("_", "-"), repr(float(point[name])))]
    return json.loads(run(TOOL, "limit-cycle", *options, "--format", "json"))


class ReadBack(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return str(pathlib.Path(self.folder.name) / name)

    def written(self, *arguments):
        run(TOOL, *arguments, "--output", self.path("out.nc"))
        data, by_scipy = (xarray.load_dataset(self.path("out.nc"), engine=engine)
                          for engine in ("netcdf4", "scipy"))
        xarray.testing.assert_identical(data, by_scipy)
        return data

    def swept(self):
        pathlib.Path(self.path("sweep.toml")).write_text(SWEEP, encoding="utf-8")
        return self.written("sweep", self.path("sweep.toml"))

    def assert_points_are_single_calls(self, data, count=20):
        names = data["verdict"].dims
        chooser = random.Random(SEED)
        for _ in range(count):
            place = {name: chooser.randrange(data.sizes[name]) for name in names}
            point = data.isel(place)
            single = single_call(point)
            message = f"seed {SEED}, {place}"
            words = point["verdict"].attrs["flag_meanings"].split()
            verdict = words[int(point["verdict"])].replace("_", " ")
            self.assertEqual(verdict, single["verdict"], message)
            growth = float(single["growth_at_rest"])  # or "inf"
            self.assertAlmostEqual(float(point["growth_at_rest"]), growth, delta=1e-12 * growth,
                                   msg=message)
            if verdict == "cannot hunt":
                self.assertEqual(float(point["amplitude"]), 0.0, message)
                self.assertTrue(math.isnan(float(point["period"])), message)
                continue
            cycle = single["cycles"][0]
            for quantity in ("amplitude", "period", "frequency", "multiplier", "impact_speed"):
                self.assertAlmostEqual(float(point[quantity]), cycle[quantity],
                                       delta=1e-11 * abs(cycle[quantity]), msg=message)

    def test_a_sweep_has_its_axes_as_dimensions(self):
        data = self.swept()
        self.assertEqual(data["amplitude"].dims, ("friction_ratio", "damping", "inertia_ratio"))
        self.assertEqual(data["amplitude"].shape, (7, 3, 11))
        self.assertEqual(list(data["damping"].values), [0.1, 0.2, 0.5])
        self.assertEqual(float(data["inertia_ratio"][-1]), 9.0)
        self.assertAlmostEqual(float(data["backlash"]), math.radians(0.2), places=17)
        self.assertIn("backlash", data.coords)
        self.assertEqual(set(data.data_vars), {"verdict", *QUANTITIES})
        self.assert_points_are_single_calls(data)

    def test_a_chart_of_one_curve_and_of_many(self):
        one = self.written("chart", "--x", "inertia-ratio=1/9:9:21:log", "--friction-ratio", "0.1",
                           "--damping", "0.1", "--backlash", "0.3")
        self.assertEqual(one["amplitude"].dims, ("inertia_ratio",))
        self.assert_points_are_single_calls(one)
        many = self.written("chart", "--x", "friction-ratio=0:1:21", "--curves", "damping=0.1,0.6",
                            "--inertia-ratio", "1")
        self.assertEqual(many["amplitude"].dims, ("damping", "friction_ratio"))
        self.assert_points_are_single_calls(many)

    def test_a_map_with_its_boundary(self):
        arguments = ["map", "--x", "inertia-ratio=0.1:10:21:log", "--y", "damping=0.05:1:20",
                     "--friction-ratio", "0.3"]
        data = self.written(*arguments)
        self.assertEqual(data["amplitude"].dims, ("damping", "inertia_ratio"))
        self.assert_points_are_single_calls(data)
        run(TOOL, *arguments, "--output", self.path("map.json"))
        curves = json.loads(pathlib.Path(self.path("map.json")).read_text())["hunting_boundary"]
        points = [[point["x"], point["y"]] for curve in curves for point in curve]
        x = data["hunting_boundary_inertia_ratio"].values
        y = data["hunting_boundary_damping"].values
        self.assertGreater(len(points), 20)
        self.assertEqual([[float(a), float(b)] for a, b in zip(x, y) if not math.isnan(a)], points)
        self.assertEqual(sum(map(math.isnan, x)), len(curves) - 1)
        inertia_ratio, damping = points[len(points) // 2]
        for factor, growing in ((0.999, True), (1.001, False)):
            single = single_call({"damping": factor * damping, "inertia_ratio": inertia_ratio,
                                  "friction_ratio": 0.3, "backlash": 1.0, "restitution": 0.0})
            self.assertEqual(single["growth_at_rest"] > 1.0, growing)

    def test_a_map_with_a_target(self):
        data = self.written("map", "--x", "inertia-ratio=0.1:10:5:log", "--y", "damping=0.05:1:4",
                            "--friction-ratio", "0.3", "--target", "no-hunting")
        target = data["target"]
        self.assertEqual(target.dims, ("damping", "inertia_ratio"))
        words = target.attrs["flag_meanings"].split()
        self.assertEqual(words, ["not_known", "missed", "met"])
        met = target.values == words.index("met")
        self.assertTrue((met == (data["growth_at_rest"].values <= 1.0)).all())
        self.assertTrue(met.any() and not met.all())

    def test_its_values_are_those_of_the_table(self):
        arguments = ["map", "--x", "inertia-ratio=0.1:10:9:log", "--y", "damping=0.05:1:7",
                     "--friction-ratio", "0.3", "--target", "no-hunting"]
        data = self.written(*arguments).drop_dims("hunting_boundary_point")
        run(TOOL, *arguments, "--output", self.path("out.csv"))
        table = data.to_dataframe().reset_index()
        with open(self.path("out.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(table))
        for column in rows[0]:
            name = next(name for name in sorted(table, reverse=True)
                        if f"{column}_".startswith(f"{name}_"))
            unit = data[name].attrs.get("units", "1")
            self.assertEqual(column, name if unit == "1" else
                             f"{name}_{unit.replace('/', '_per_').replace(' ', '_')}")
            words = data[name].attrs.get("flag_meanings", "").split()
            for row, value in zip(rows, table[name]):
                if words:
                    self.assertEqual(row[column].replace(" ", "_"), words[int(value)], name)
                elif row[column]:
                    self.assertEqual(float(row[column]), value, name)
                else:
                    self.assertTrue(math.isnan(value), name)

    def test_a_map_without_a_boundary(self):
        data = self.written("map", "--x", "inertia-ratio=1:2:3", "--y", "damping=0.1:0.2:3",
                            "--friction-ratio", "0.1")
        self.assertNotIn("hunting_boundary_point", data.dims)
        self.assertTrue((data["growth_at_rest"] > 1.0).all())

    def test_every_variable_is_described(self):
        data = self.swept()
        for name, variable in data.variables.items():
            self.assertIn("long_name", variable.attrs, name)
            if name != "verdict":
                self.assertIn(variable.attrs["units"], ["1", "rad", "s", "Hz", "rad/s", "N m", "J"], name)
        self.assertEqual(data.attrs["sweep"], SWEEP)
        self.assertRegex(data.attrs["source"], r"^gearlash \d+\.\d+\.\d+$")
        self.assertEqual(data.attrs["history"], "gearlash sweep " + self.path("sweep.toml") +
                         " --output " + self.path("out.nc"))

    def test_a_drive_with_its_words(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        data = self.written("chart", str(root / "examples/elinco-fd162.toml"), "--x",
                            "sensor.position=load,motor")
        self.assertEqual(data["amplitude"].dims, ("sensor_position",))
        self.assertEqual(data["sensor_position"].attrs["words"], "load motor both")
        self.assertEqual(list(data["sensor_position"].values), [0.0, 1.0])
        self.assertIn("gearbox_ratio", data.coords)
        self.assertNotIn("sensor.position", json.loads(data.attrs["drive"]))
        self.assertIn("static_error", data)

    def test_ncdump_reads_it(self):
        self.swept()
        self.assertEqual(run("ncdump", "-k", self.path("out.nc")), "64-bit offset\n")
        header = run("ncdump", "-h", self.path("out.nc"))
        self.assertIn("\tinertia_ratio = 11 ;", header)
        self.assertIn("\tdouble amplitude(friction_ratio, damping, inertia_ratio) ;", header)
        self.assertIn('\t\tamplitude:units = "rad" ;', header)
        values = run("ncdump", "-v", "damping", self.path("out.nc"))
        self.assertIn(" damping = 0.1, 0.2, 0.5 ;", values)


if __name__ == "__main__":
    unittest.main()
