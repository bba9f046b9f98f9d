"""The questions put to a tool: a seeded set for each verb, for some minutes on two cores.

A question is a verb, the text of a drive's file or none, options by the names that version 0.2 has,
and the form of the answer. Adapters translate it for other versions.
"""
import random

from .drives import (BASES, EXAMPLES, PROVED, data_sheet, example, extreme_normal_form, joint,
                     log_uniform, normal_form, number, toml, variation)

SEED = 1960


def question(verb, drive=None, form="json", **options):
    return {"verb": verb, "drive": drive, "form": form,
            "with": {name.replace("_", "-"): value for name, value in options.items()}}


def about(verb, servo, form="json", **options):
    """Of a servo that options give instead of a file."""
    asked = question(verb, None, form, **options)
    return asked | {"with": servo | asked["with"]}


def restitution(rng):
    return round(rng.uniform(0.05, 0.9), 3)


# ---- what a drive ends in -----------------------------------------------------------------------
def servos(rng):
    for _ in range(600):
        yield about("limit-cycle", extreme_normal_form(rng))
    for _ in range(150):
        bounces = rng.uniform(0.02, 0.95) if rng.random() < 0.25 else 0
        yield question("limit-cycle", data_sheet(rng, bounces))


def drives(rng):
    for path in sorted([*EXAMPLES.glob("*.toml"), *EXAMPLES.glob("*/*.toml")]):
        if "[sweep]" not in path.read_text(encoding="utf-8"):
            yield question("limit-cycle", path.read_text(encoding="utf-8"))
    for name, (count, *_) in BASES.items():
        for _ in range(count):
            yield question("limit-cycle", variation(rng, name))
    for _ in range(40):
        yield question("limit-cycle", joint(rng))


def ceilings(rng):
    """And the widest backlash that provably keeps a specification."""
    for text in PROVED:
        yield question("limit-cycle", text)
    for _ in range(20):
        yield question("limit-cycle", joint(rng), specification=f"{number(rng, 0.005, 0.5)} rad")
    for name in ("telescope-axis", "robot-joint", "antenna-field-controlled", "camera-head"):
        yield question("limit-cycle", example(name), specification=f"{number(rng, 1, 60)} arcmin")
    for _ in range(10):
        yield about("limit-cycle", normal_form(rng), specification=f"{number(rng, 0.01, 1)} rad")


def margins(rng):
    for _ in range(40):
        yield about("limit-cycle", normal_form(rng), margins=True, sensitivities=True)
    for _ in range(20):
        yield question("limit-cycle", data_sheet(rng), margins=True, sensitivities=True)
    for _ in range(4):
        servo = normal_form(rng, round(rng.uniform(0.05, 0.4), 3))
        yield about("limit-cycle", servo, margins=True, parameters="servo.damping=0.05:0.5:5")
    for name in ("elinco-fd162", "instrument-two-phase", "first-servo", "normalized"):
        yield question("limit-cycle", example(name), margins=True, sensitivities=True)
    for _ in range(24):
        yield question("limit-cycle", joint(rng), margins=True, parameters=rng.choice([
            "gearbox.backlash=0.001 rad:0.2 rad:6:log", "sensor.position",
            "controller.proportional=20 N m/rad:500 N m/rad:7:log",
            "controller.derivative=0.5 N m s/rad:20 N m s/rad:6,load.inertia"]))
    for _ in range(16):
        yield question("limit-cycle", joint(rng), sensitivities=True)


# ---- what must change ---------------------------------------------------------------------------
def target_of(rng, backlash):
    amplitude = f"amplitude <= {number(rng, 0.2, 2) * backlash:.4g}"
    growth = f"growth-at-rest <= {rng.choice([0.5, 0.9, 1, 2])}"
    several = f"amplitude <= {number(rng, 0.5, 2) * backlash:.4g} and growth-at-rest <= 5"
    return rng.choice(["no-hunting", "no-hunting-if-disturbed", amplitude, growth, several])


def design(rng):
    for _ in range(24):
        servo = normal_form(rng)
        names = rng.choice(["backlash,gearbox.ratio", "controller.proportional,load.friction",
                            "controller.motor_speed_feedback,load.inertia",
                            "motor.friction,motor.inertia"])
        yield about("design", servo, target=target_of(rng, servo["backlash"]), parameters=names)
    for _ in range(6):
        servo = normal_form(rng, restitution(rng))
        yield about("design", servo, target=rng.choice([
            "no-hunting", f"amplitude <= {0.5 * servo['backlash']:.4g}"]),
            parameters=rng.choice(["backlash", "servo.damping", "load.friction"]))
    for _ in range(20):
        sheet = data_sheet(rng)
        yield question("design", sheet, target=rng.choice([
            "no-hunting", "amplitude <= 1 deg", "amplitude <= 10 arcmin", "growth-at-rest <= 0.9",
            "frequency >= 5 Hz", "period <= 0.2 s", "no-hunting and growth-at-rest <= 0.5"]),
            parameters=rng.choice(["gearbox.backlash,gearbox.ratio",
                                   "load.friction,controller.motor_speed_feedback",
                                   "controller.proportional,load.inertia"]))
    for name in ("elinco-fd162", "instrument-two-phase", "antenna-field-controlled"):
        yield question("design", example(name), target="no-hunting")
        yield question("design", example(name), target="amplitude <= 0.1 deg",
                       parameters="gearbox.backlash,controller.motor_speed_feedback")
    yield from searched_design(rng)


def searched_design(rng):
    values = ["controller.proportional=20 N m/rad:500 N m/rad:6:log", "sensor.position",
              "controller.derivative=0.5 N m s/rad:20 N m s/rad:6:log",
              "gearbox.backlash=0.001 rad:0.1 rad:5:log",
              "load.coulomb=0 N m:0.2 N m:5,sensor.position"]
    for _ in range(24):
        yield question("design", joint(rng), parameters=rng.choice(values), target=rng.choice([
            "no-hunting and no-hunting-if-disturbed", "amplitude <= 0.01 rad", "no-runaway",
            "no-hunting and bandwidth >= 1.5 Hz", "static-error <= 0.005 rad",
            "phase-margin >= 20 deg", "overshoot <= 40 %", "settling-time <= 1.5 s"]))
    for _ in range(16):  # proved, and the widest backlash among them
        yield question("design", joint(rng), target=f"ceiling <= {number(rng, 0.01, 0.2)} rad",
                       parameters=rng.choice([values[0], values[3]]))
    yield question("design", example("telescope-axis"), target="ceiling <= 6.3 arcmin",
                   parameters="gearbox.backlash=5 arcmin:20 arcmin:2")


def regions(rng):
    """Where two parameters together meet a target. Only a picture has it."""
    for vary in ("load.friction,gearbox.ratio", "backlash,controller.proportional",
                 "controller.motor_speed_feedback,load.inertia"):
        servo = normal_form(rng)
        yield about("design", servo, "svg", target=target_of(rng, servo["backlash"]), vary=vary)
    for vary, cost in (("gearbox.backlash,controller.proportional", "bandwidth"),
                       ("load.friction,gearbox.ratio", "stiffness"),
                       ("motor.inertia,load.inertia", "damping")):
        yield question("design", example("elinco-fd162"), "svg", target="amplitude <= 2 deg",
                       vary=vary, cost=cost)


def tune(rng):
    for _ in range(8):
        yield question("tune", data_sheet(rng), target="no-hunting", phase_margin="10 deg", units=4,
                       parameters="controller.proportional")
    for target in ("no-hunting", "amplitude <= 1 deg", "growth-at-rest <= 0.8"):
        yield question("tune", example("toleranced"), target=target, units=8,
                       parameters="load.friction=0.03 ozf in/(rad/s):0.3 ozf in/(rad/s)")
        yield question("tune", example("elinco-fd162"), target=target, phase_margin="0 deg")
    for aim in ("bandwidth", "settling", "static-error") * 5:
        options = {"for": aim} | ({"share": "75 %"} if rng.random() < 0.3 else {})
        yield question("tune", joint(rng, rng.choice([(), ("load.inertia",)])), units=2,
                       target=rng.choice(["no-hunting", "amplitude <= 0.02 rad"]),
                       parameters="controller.proportional=20 N m/rad:300 N m/rad", **options)


def tolerance(rng):
    text = example("toleranced")
    for seed in range(4):
        yield question("tolerance", text, samples=512, seed=seed)
    for target in ("amplitude <= 1 deg", "amplitude <= 3 deg and frequency >= 1 Hz", "no-hunting"):
        yield question("tolerance", text, samples=1024, target=target)
    for share in ("80 %", "95 %"):
        yield question("tolerance", text, samples=512, target="amplitude <= 2 deg",
                       **{"yield": share})
    yield question("tolerance", text, samples=256, amplitude="motor")
    for _ in range(12):
        paths = rng.choice([("load.inertia",), ("gearbox.backlash",), ("load.friction",)])
        asked = {}
        if rng.random() < 0.5:
            asked = {"target": f"amplitude <= {number(rng, 0.005, 0.05)} rad"}
        yield question("tolerance", joint(rng, paths), samples=32, **asked)


# ---- grids --------------------------------------------------------------------------------------
AXES = ["damping=0.05:0.6:{}", "inertia-ratio=1/9:9:{}:log", "friction-ratio=0.05:0.95:{}",
        "backlash=0.1,0.2,0.5"]


def axes_of_servo(rng, *counts):
    """Axes, and options for what is on none of them."""
    chosen = rng.sample(AXES, len(counts))
    servo = {name: value for name, value in normal_form(rng).items()
             if not any(axis.startswith(f"{name}=") for axis in chosen)}
    return [axis.format(count) for axis, count in zip(chosen, counts)], servo


JOINT_AXES = [("controller.proportional=50 N m/rad:200 N m/rad:{}:log"),
              ("load.coulomb=0 N m:0.1 N m:{}"), ("gearbox.backlash=0.01 rad:0.05 rad:{}")]


def chart(rng):
    for i in range(16):
        (x, curves), servo = axes_of_servo(rng, 7, 2)
        servo |= {"proved": True} if i % 4 == 1 else {}
        yield about("chart", servo, ["json", "csv", "nc"][i % 3], x=x, curves=curves)
    for _ in range(6):
        (x,), servo = axes_of_servo(rng, 6)
        yield about("chart", servo | {"restitution": restitution(rng)}, x=x)
    yield question("chart", example("elinco-fd162"), x="sensor.position=load,motor")
    yield question("chart", example("elinco-fd162"), "csv", x="gearbox.ratio=0.5:20:6:log")
    for i in range(12):
        quantities = {"quantity": rng.choice(["overshoot", "settling_time"])} if i % 3 == 0 else {}
        yield question("chart", joint(rng), ["json", "nc"][i % 2],
                       x=rng.choice(JOINT_AXES).format(5), **quantities)


def map_(rng):
    for i in range(14):
        (x, y), servo = axes_of_servo(rng, 5, 5)
        yield about("map", servo, ["json", "json", "nc", "csv"][i % 4], x=x, y=y)
    for _ in range(3):
        (x, y), servo = axes_of_servo(rng, 4, 3)
        yield about("map", servo | {"restitution": restitution(rng)}, x=x, y=y)
    yield question("map", example("elinco-fd162"), x="gearbox.ratio=10,20",
                   y="sampling.period=1 ms,10 ms")
    for _ in range(8):
        x, y = rng.sample(JOINT_AXES, 2)
        yield question("map", joint(rng), x=x.format(3), y=y.format(3))


def sweep(rng):
    def file_of(axes, drive, **more):
        return toml({"sweep": {"axes": axes} | more}) + drive
    for i in range(5):
        axes, servo = axes_of_servo(rng, 4, 3, 5)
        named = {"backlash": "backlash", "inertia-ratio": "inertia_ratio", "damping": "damping",
                 "friction-ratio": "friction_ratio"}
        rest = {named[name]: f"{value} rad" if name == "backlash" else value
                for name, value in servo.items() if name in named}
        drive = toml({"servo": rest} if rest else {})
        more = [{}, {"quantities": ["amplitude", "period"]}, {"verdicts": "proved"}][i % 3]
        yield question("sweep", file_of(axes, drive, **more), "nc")
    drive = example("elinco-fd162").replace("ratio = 1 ", "#").replace('sensor = "load"', "")
    drive = drive.replace('friction = "0.002', '# "')
    yield question("sweep", file_of(["gearbox.ratio=1,5", "sensor.position=load,motor",
                                     "load.friction=1e-5:1e-4:3:log"], drive), "nc")
    for _ in range(3):
        drive = joint(rng).replace("proportional =", "#")
        yield question("sweep", file_of([JOINT_AXES[0].format(6)], drive), "nc")


# ---- motions, describing functions, places of the sensor -----------------------------------------
def simulate(rng):
    forms = ["json", "json", "csv", "events"]
    for i in range(16):
        servo = normal_form(rng, restitution(rng) if i % 2 else 0)
        yield about("simulate", servo, forms[i % 4], until=f"{rng.uniform(5, 30):.3g}", every="1")
    for i in range(6):
        yield about("simulate", normal_form(rng), forms[i % 4], until="15", every="1",
                    initial_position=f"{number(rng, 0.01, 1)}", initial_gap_speed="-0.1",
                    initial_speed=f"{number(rng, 0.01, 1)}", initial_gap="0", reference="0")
    for i in range(24):
        yield question("simulate", joint(rng), forms[i % 4], until="3 s", every="0.2 s")
    for i, name in enumerate(list(BASES) * 4):
        yield question("simulate", variation(rng, name), forms[i % 4], until="0.5 s", every="50 ms")


def describe(rng):
    for _ in range(20):
        yield about("describe", normal_form(rng))
    for _ in range(10):
        yield question("describe", data_sheet(rng))
    for _ in range(24):
        yield question("describe", joint(rng))
    for name in (*list(BASES) * 2, "camera-head", "first-servo", "dynamixel-joint"):
        text = variation(rng, name) if name in BASES else example(name)
        yield question("describe", text)


def compare(rng):
    for _ in range(10):
        yield question("compare", data_sheet(rng))
    for _ in range(20):
        yield question("compare", joint(rng))
    for name in list(BASES) * 2:
        yield question("compare", variation(rng, name), sensor="load,motor", step="2 deg")


# ---- 1960 ---------------------------------------------------------------------------------------
def thesis(rng):
    tables = ["table-2", "table-2 --arithmetic 1604", "table-2 --properties", "machine",
              "machine --rules", "machine --listing", "machine --trace 100", "run --causes",
              "run input.toml", "run input.toml --machine", "chart-reading input.toml", "run --all"]
    for _ in range(8):
        servo = (f"--damping {rng.uniform(0.1, 0.6):.3f} --inertia-ratio "
                 f"{log_uniform(rng, 0.12, 8):.3f} --friction-ratio {rng.uniform(0.05, 0.95):.3f}")
        tables += [f"run {servo}", f"chart-reading {servo} --backlash 0.2"]
    for table in tables:
        yield question(f"thesis {table}", example("elinco-fd162"), "text")


KINDS = {"servos": servos, "drives": drives, "ceilings": ceilings, "margins": margins,
         "design": design, "regions": regions, "tune": tune, "tolerance": tolerance, "chart": chart,
         "map": map_, "sweep": sweep, "simulate": simulate, "describe": describe,
         "compare": compare, "thesis": thesis}


def all_questions():
    """Each kind is drawn by itself, so that a change to one leaves the others."""
    for kind, make in KINDS.items():
        for i, asked in enumerate(make(random.Random(f"{SEED} {kind}"))):
            yield {"kind": kind, "name": f"{kind} {i}"} | asked
