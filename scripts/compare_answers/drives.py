"""Random servos and drives, as texts of drive files or as options: what the questions are about."""
import json
import math
import pathlib
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def number(rng, low, high):
    """With four digits, as a person would type it."""
    return float(f"{log_uniform(rng, low, high):.4g}")


def toml(sections):  # JSON writes numbers and texts as TOML does
    return "".join(f"[{name}]\n" + "".join(f"{k} = {json.dumps(v)}\n" for k, v in keys.items())
                   for name, keys in sections.items())


def example(name):
    return (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")


def normal_form(rng, restitution=0):
    """The options of a servo of ordinary size, of which about half hunt."""
    return {"damping": number(rng, 0.03, 0.6), "inertia-ratio": number(rng, 0.1, 10),
            "friction-ratio": round(rng.uniform(0.05, 0.95), 3),
            "backlash": number(rng, 0.01, 0.5), "restitution": restitution}


def extreme_normal_form(rng):
    """The whole permitted range, its ends included."""
    def mostly(value, share, special):
        return rng.choice(special) if rng.random() < share else value
    return {"damping": mostly(log_uniform(rng, 0.005, 5), 0.05, [0, 1]),
            "inertia-ratio": mostly(log_uniform(rng, 1e-3, 1e3), 0.04, [0, math.inf]),
            "friction-ratio": mostly(rng.random(), 0.06, [0, 1]),
            "backlash": log_uniform(rng, 1e-4, 1),
            "restitution": rng.uniform(0.02, 0.95) if rng.random() < 0.25 else 0}


UNITS = {"inertia": {"kg m2": 1, "g cm2": 1e-7, "oz in2": 1.829e-5},
         "friction": {"N m s/rad": 1, "ozf in/(rad/s)": 7.0616e-3, "mN m/krpm": 9.5493e-6},
         "angle": {"rad": 1, "deg": math.pi / 180, "arcmin": math.pi / 10800}}


def data_sheet(rng, restitution=0):
    """A data sheet, made backwards from a normal form so that many of them hunt."""
    def quantity(kind, value):
        unit, size = rng.choice(list(UNITS[kind].items()))
        return f"{value / size:.8g} {unit}"
    damping, ratio, share = log_uniform(rng, 0.02, 2), log_uniform(rng, 0.01, 100), rng.random()
    frequency, turns = log_uniform(rng, 3, 300), rng.choice([1, 12.5, 100])
    inertia, resistance = log_uniform(rng, 1e-5, 10), log_uniform(rng, 0.5, 500)
    constant, friction = log_uniform(rng, 0.01, 1), 2 * damping * frequency * inertia
    gain = inertia * frequency**2 * resistance / (constant * turns)
    electric = 0.9 * (1 - share) * friction / turns**2
    return toml({
        "motor": {"kind": "armature-controlled", "friction": quantity("friction", electric / 9),
                  "inertia": quantity("inertia", inertia / (1 + ratio) / turns**2),
                  "back_emf_constant": f"{electric * resistance / constant} V/(rad/s)",
                  "torque_constant": f"{constant} N m/A", "resistance": f"{resistance} ohm"},
        "gearbox": {"ratio": turns, "backlash": quantity("angle", log_uniform(rng, 1e-4, 1))},
        "load": {"inertia": quantity("inertia", inertia * ratio / (1 + ratio)),
                 "friction": quantity("friction", share * friction)},
        "loop": {"error_gain": f"{gain} V/rad"}, "contact": {"restitution": restitution}})


# For each example: the number of variations, larger for quick ones, and the values that a variation
# adds: dry friction of motor and load, sample period, contact stiffness.
BASES = {"telescope-axis": (36, "60 mN m", "0.1 N m", "2 ms", "2e5 N m/rad"),
         "robot-joint": (15, "1 mN m", "20 mN m", "5 ms", "200 N m/rad"),
         "elinco-fd162": (24, "0.05 mN m", "0.05 mN m", "10 ms", "0.5 N m/rad"),
         "instrument-two-phase": (11, "0.02 mN m", "1 mN m", "1 ms", "200 N m/rad"),
         "antenna-field-controlled": (7, "0.05 mN m", "2 mN m", "20 ms", "500 N m/rad")}
SCALED = ("gearbox.backlash loop.error_gain load.coulomb load.friction load.inertia motor.coulomb "
          "motor.voltage_limit motor.torque_limit controller.proportional controller.integral "
          "controller.derivative controller.filter sampling.period").split()
SIGNALS = [{"kind": "ramp", "rate": "0.5 deg/s"}, {"kind": "constant", "value": "0 rad"},
           {"kind": "sine", "amplitude": "1 deg", "frequency": "0.5 Hz"}]


def variation(rng, name):
    """An example with other numbers, and often with other parts."""
    drive = tomllib.loads(example(name))
    _, motor_coulomb, load_coulomb, period, stiffness = BASES[name]
    for section, key in (path.split(".") for path in SCALED):
        if key in drive.get(section, {}):
            value, unit = drive[section][key].split(maxsplit=1)
            drive[section][key] = f"{float(value) * 2 ** rng.uniform(-1, 1):.6g} {unit}"
    drive.get("loop", {}).pop("sensor", None)  # [sensor] gives it
    for share, section, key, value in [
            (0.4, "sensor", "position", rng.choice(["motor", "both", "load"])),
            (0.3, "sensor", "counts_per_turn", rng.choice([None, 500, 2000, 16384])),
            (0.2, "sampling", None, {}), (0.3, "sampling", "period", period),
            (0.3, "motor", "coulomb", rng.choice([None, motor_coulomb])),
            (0.3, "load", "coulomb", rng.choice([None, load_coulomb])),
            (0.3, "motor", "breakaway", None), (0.3, "contact", None, {}),
            (0.3, "contact", None, {"restitution": round(rng.uniform(0.1, 0.8), 3)}),
            (0.1, "contact", None, {"stiffness": stiffness}),
            (0.2, "reference", None, rng.choice(SIGNALS))]:
        if rng.random() < share:
            drive |= {section: (drive.get(section, {}) | {key: value}) if key else value}
    return toml({section: {key: value for key, value in keys.items() if value is not None}
                 for section, keys in drive.items() if keys})


def joint(rng, tolerances=()):
    """A PD loop that is searched within milliseconds: 1 kg m2 and 10 rad/s, give or take. Each path
    in `tolerances` gets one."""
    def quantity(path, value, unit):
        tolerance = f" ± {rng.choice([5, 10, 20])} %" if path in tolerances else ""
        return f"{value:.4g} {unit}{tolerance}"
    share, damping = rng.uniform(0.2, 0.8), log_uniform(rng, 0.1, 0.7)
    stiffness = log_uniform(rng, 50, 200)
    drive = {"motor": {"kind": "torque-controlled",
                       "inertia": quantity("motor.inertia", 1 - share, "kg m2"),
                       "friction": quantity("motor.friction", rng.uniform(0.1, 1), "N m s/rad")},
             "gearbox": {"ratio": 1, "backlash": quantity(
                 "gearbox.backlash", log_uniform(rng, 0.005, 0.05), "rad")},
             "load": {"inertia": quantity("load.inertia", share, "kg m2"),
                      "friction": quantity("load.friction", rng.uniform(0.05, 1), "N m s/rad")},
             "sensor": {"position": rng.choice(["load", "load", "both", "motor"])},
             "controller": {"kind": "PD", "shaft": "load",
                            "proportional": f"{stiffness:.4g} N m/rad",
                            "derivative": f"{2 * damping * stiffness**0.5:.4g} N m s/rad",
                            "filter": "5 ms"}}
    if rng.random() < 0.3:
        drive["load"]["coulomb"] = quantity("load.coulomb", log_uniform(rng, 0.01, 0.1), "N m")
    if rng.random() < 0.3:
        drive["motor"]["coulomb"] = f"{log_uniform(rng, 0.01, 0.1):.4g} N m"
    if rng.random() < 0.3:
        drive["motor"]["torque_limit"] = f"{log_uniform(rng, 2, 50):.4g} N m"
    if rng.random() < 0.25:
        drive["contact"] = {"restitution": round(rng.uniform(0.1, 0.7), 3)}
    return toml(drive)


# Drives at the edges of what is proved.
PROVED = [(ROOT / f"tests/regression/data/{name}.toml").read_text(encoding="utf-8")
          for name in ("hanging-load", "compliant-faces", "sampled-tachometer")]
