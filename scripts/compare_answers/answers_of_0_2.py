"""The adapter of version 0.2: how to put a question, and what an answer means, in SI.

`ask` gives the words to type. `read` gives the answer as a record of plain meanings. Nothing else
knows this version's options, keys, columns and texts. None and what is left out are the same: not
known, or not applicable.
"""
import csv
import io
import json
import re

from . import documents, picture

INPUT, TABLE, PICTURE = "input.toml", "table", "region.svg"


# 0.2 had these names in designs and margins: of a normal form, multiples of the present value and
# shares of the total inertia and of the critical friction. They are now numbers of the drive that
# it stands for.
NAMES = {"gear_ratio": "gearbox.ratio", "error_gain": "controller.proportional",
         "load_inertia": "load.inertia", "motor_inertia": "motor.inertia",
         "load_friction": "load.friction", "motor_friction": "motor.friction",
         "tachometer": "controller.motor_speed_feedback"}


def name_in_0_2(path, drive):
    """The name, and the number that is now its unit."""
    is_form = any(name.startswith("servo.") for name in drive or {})
    for older, newer in NAMES.items():
        if newer != path or not (is_form or older == "tachometer"):
            continue
        frequency = (drive or {}).get("servo.natural_frequency") or 1.0
        critical = 2.0 * frequency if "friction" in newer or older == "tachometer" else 1.0
        return older, (critical if is_form else 1.0) * (
            frequency ** 2 if older == "error_gain" else 1.0)
    return path, 1.0


def divided(values, unit):
    """All numbers of a value, a range or lists of them."""
    if isinstance(values, dict):
        return {key: divided(one, unit) for key, one in values.items()}
    if isinstance(values, list):
        return [divided(one, unit) for one in values]
    return values / unit if isinstance(values, (int, float)) and unit != 1.0 else values


def ask(question):
    form, options = question["form"], dict(question["with"])
    options.pop("cost", None)  # of lines in the picture that are not compared
    for option in ("parameters", "vary"):
        if option in options:
            options[option] = ",".join(NAMES.get(name, name)
                                       for name in str(options[option]).split(","))
    words = question["verb"].split()
    if question["drive"] and INPUT not in words and words[0] != "thesis":
        words.append(INPUT)
    for name, value in options.items():
        words += [f"--{name}"] if value is True else [f"--{name}", str(value)]
    if words[0] in ("chart", "map", "sweep"):
        return [*words, "--output", f"{TABLE}.{form}"]
    if form == "svg":
        return [*words, "--plot", f"region={PICTURE}"]
    forms = {"text": [], "events": ["--events"]}
    return [*words, *forms.get(form, ["--format", form])]


def read(question, folder, printed):
    """From what was printed, and the files in the folder; None where there is no answer."""
    verb, form = question["verb"].split()[0], question["form"]
    table = folder / f"{TABLE}.{form}"
    if verb == "thesis":
        return {"numbers": numbers_in(printed)}
    if form == "svg":
        file = folder / PICTURE
        return picture.limits(file.read_text(encoding="utf-8")) if file.exists() else None
    if table.suffix == ".nc":
        return grid_of_netcdf(table) if table.exists() else None
    if table.exists():
        printed = table.read_text(encoding="utf-8")
    if not printed.strip():
        return None
    if form in ("csv", "events"):
        rows = list(csv.reader(io.StringIO(printed)))
        return {"csv": table_of_motion, "events": events_of_table}[form](rows) \
            if verb == "simulate" else grid_of_csv(rows)
    if printed.lstrip()[:1] != "{":
        return None
    answer = json.loads(printed.replace('"inf"', "Infinity").replace('"-inf"', "-Infinity"))
    if answer["schema"].endswith("/3"):
        answer = documents.in_shapes_of_0_2(answer)
    return READERS[verb](answer)


def chosen(source, keys):
    return {key: source.get(key) for key in keys.split()} if source else {}


def numbers_in(text):
    """As they stand, but for the year in titles."""
    return re.findall(r"(?<![\w.])[-−+±]?(?:\d+\.?\d*|\.\d+)", text.replace("1960", ""))


def parts(values):
    return [[part["from"], part["to"]] for part in values or []]


# What a reason says, by words of its text.
REASONS = {"not proved stable": "loop not stable", "faces with damping": "damping of the faces",
           "relay": "relay", "speed of the gap": "speed of the gap",
           "beyond the numbers": "overflow"}


def meaning(reason):
    for words, meant in REASONS.items():
        if reason and words in reason:
            return meant
    return re.sub(r"\d+", "", reason) if reason else None


# ---- a motion in the end ------------------------------------------------------------------------
def cycle(source, is_closed):
    events = "impacts per period" if is_closed else "events per period"
    keys = ("kind stability certainty amplitude motor_amplitude center period frequency multiplier "
            "impact_speed engaged_time separated_time residual settles mirror_image encoder_steps")
    return {**chosen(source, keys), events: source["events_per_period"],
            "energy": source["energy"] or {}}


def irregular(source):
    keys = "amplitude motor_amplitude center motor_alone repeats period_deviation"
    return {**chosen(source, keys),
            "swing": source["mean_amplitude"], "swing_deviation": source["amplitude_deviation"],
            "period": source["mean_period"]}


def rest(source):
    source = source or {}
    sides = {f"{shaft} {side}": source[shaft][i] for shaft in ("load", "motor", "error")
             if isinstance(source.get(shaft), list) for i, side in enumerate(("low", "high"))}
    return {"rest": sides, "rests": bool(sides),
            "rest is computed": source.get("certainty") == "computed",
            "rest is approached": source.get("swing_ratio") is not None}


def ceiling(source):
    if not source:
        return {}
    terms = {}
    for term in source["terms"]:
        name = term["source"] if term["source"] not in terms else f"{term['source']} again"
        terms[name] = chosen(term, "size load motor effort")
    return {"load": source["value"],
            **chosen(source, "motor effort mesh_torque below_limit meets_limit"),
            "safe_position": (source["safe_starts"] or {}).get("position"),
            "safe_speed": (source["safe_starts"] or {}).get("speed"),
            "reason": meaning(source["reason"]), "effort_reason": meaning(source["effort_reason"]),
            "terms": terms}


def margins(source, drive):
    if not source:
        return {}

    def borders(one):
        unit = name_in_0_2(one["parameter"], drive)[1]
        return divided(chosen(one, "below above"), unit)
    combined = source["overall"] or source["combined"] or {}
    return {"hunts": source["hunts"], "stopped": source["stopped"],
            "distance": combined.get("distance"),
            "parameters": {name_in_0_2(one["parameter"], drive)[0]: {
                **borders(one), **chosen(one, "certified located"),
                "choices": sorted(one["choices"]), "undecided": len(one["undecided"])}
                for one in source["parameters"]}}


def sensitivities(source, drive):
    if not source:
        return {}
    slopes = {}
    for one in source["numbers"]:
        by, unit = name_in_0_2(one["parameter"], drive)
        slopes |= {f"{name} by {by}": derivative["slope"] and derivative["slope"] * unit
                   for name, derivative in one.items() if isinstance(derivative, dict)}
    return {"available": source["available"], "slopes": slopes}


def in_the_end(answer):
    is_closed = answer["engine"] == "closed form"
    ends = sorted({start["end"] for start in (answer["search"] or {}).get("starts", [])})
    keys = "verdict growth_at_rest dissipative rests_engaged neutral_swings engine"
    return {**chosen(answer, keys),
            "certainty": answer["certainty"], "servo": answer["normal_form"] or {},
            "cycles": [cycle(one, is_closed) for one in answer["cycles"]],
            "irregular": [irregular(one) for one in answer["irregular"]],
            **rest(answer["rest"]), "ends": ", ".join(ends) or None,
            "runs_away": answer["runaway"] is not None,
            "thresholds": {f"{one['end']} {one['direction']}": [one["below"], one["from"]]
                           for one in answer["thresholds"]},
            "enclosures": answer["bounds"] or {}, "ceiling": ceiling(answer["ceiling"]),
            "specification": chosen(answer["specification"], "widest_backlash is_met"),
            "margins": margins(answer["margin"], answer["drive"]),
            "sensitivities": sensitivities(answer["sensitivities"], answer["drive"])}


# ---- what must change ---------------------------------------------------------------------------
def performance(source):
    """Of one drive, its loop and its step response, if they are given."""
    if not source:
        return {}
    inner = source.get("performance", source)
    keys = "verdict growth_at_rest amplitude motor_amplitude frequency static_error"
    return {**chosen(inner, keys), **(source.get("loop") or {}),
            **(source.get("normal_form") or {}),
            **chosen(source.get("response"), "rise_time overshoot settling_time")}


def feasible(source, drive):
    unit = name_in_0_2(source["parameter"], drive)[1]

    def value(key):
        found = source[key]
        return {"value": divided(found["value"], unit), **performance(found)} if found else {}

    def scaled(values):
        return parts(divided(values, unit))
    return {"present": divided(source["present"], unit), **chosen(source, "certified located"),
            "intervals": scaled(source["intervals"]), "searched": scaled([source["searched"]]),
            "undecided": scaled(source["undecided"]),
            "borders": [[border["kind"], border["at"]] for border in source.get("borders") or []],
            "proved": [parts(proof["proved"]) for proof in source.get("proofs") or []],
            "reasons": [meaning(proof["reason"]) for proof in source.get("proofs") or []],
            "nearest": value("nearest"), "closest": value("closest")}


def design(answer):
    return {"met": answer["met"], "present": performance(answer["present"]),
            "parameters": {name_in_0_2(one["parameter"], answer["drive"])[0]:
                           feasible(one, answer["drive"]) for one in answer["answers"]}}


def tuned(source):
    return chosen(source, "values meets units met undecided reached by_derivatives")


def tune(answer):
    limiting = answer["limiting"] or {"values": {}, "performance": None}
    return {**tuned(answer["tuned"]), "present": performance(answer["present"]),
            "nominal": performance(answer["nominal"]), "stopped": answer["stopped"],
            "limiting": {"values": limiting["values"], **performance(limiting["performance"])},
            "integral_hunts": answer["why_integral_action_hunts"] is not None,
            "without_integral": tuned(answer["without_integral"])}


def tolerance(answer):
    def estimate(source):
        return [source["value"], source["standard_error"]] if source else None
    def quantiles(name):
        return {f"{name} {one['share']:g}": estimate(one) for one in answer[name]}
    def indices(one, of):
        return {f"{one['parameter']} {order} of {of}": estimate(found)
                for order, found in (one[f"indices_of_{of}"] or {}).items()}
    allowance = answer["backlash"] or {}
    varied = {one["parameter"]: one for one in answer["parameters"]}
    estimates = {name: estimate(answer[name]) for name in ("hunting", "yield", "mean_amplitude")}
    for name in ("amplitude", "amplitude_of_hunting", "frequency"):
        estimates |= quantiles(name)
    for one in answer["parameters"]:
        estimates |= indices(one, "amplitude") | indices(one, "hunting")
    return {"is_searched": answer["worst"].get("growth_at_rest") is None, "estimates": estimates,
            **chosen(answer, "amplitude_of undecided unknown_amplitudes refused"),
            **chosen(answer["sampling"], "points replicates seed"),
            "quiet": answer["histogram"]["quiet"],
            "means": {name: one["mean"] for name, one in varied.items()},
            "deviations": {name: one["standard_deviation"] for name, one in varied.items()},
            "worst_values": {name: one["worst"]["value"] for name, one in varied.items()},
            "worst": performance(answer["worst"]), "proved": answer["proved"]["bound"],
            "reason": meaning(answer["proved"]["reason"]),
            "largest_of_single_drives": answer["proved"]["largest_of_single_drives"],
            "allowance": {**chosen(allowance, "min max"),
                          "yield": estimate(allowance.get("yield"))}}


# ---- grids --------------------------------------------------------------------------------------
def grid(answer):
    curves = {f"{kind} {i}": curve for kind in ("hunting_boundary", "dissipative_boundary")
              for i, curve in enumerate(answer.get(kind) or [])}
    curves |= {f"{region['kind']} {i} {k}": curve
               for i, region in enumerate(answer.get("regions") or [])
               for k, curve in enumerate(region["outlines"])}
    return {"axes": {axis["path"]: axis["values"] for axis in answer["axes"]},
            "certainty": answer["certainty"],
            "columns": {name: values for name, values in answer["columns"].items() if values},
            "curves": curves}


def value_of(text):
    try:
        return float(text) if text else None
    except ValueError:
        return text


UNIT = re.compile(r"_(1|s|Hz|J|A|V|H|ohm|kg_m2|N_m|rad)(_s2?)?(_per_\w+)?$")


def name_of_column(name):
    """Without its unit, which tables of 0.2 have of motions alone."""
    return UNIT.sub("", name)


def grid_of_csv(rows):
    header, *rows = rows
    header = list(map(name_of_column, header))
    count = header.index("verdict")
    columns = {name: [value_of(row[i]) for row in rows] for i, name in enumerate(header)}
    return {"axes": {name: list(dict.fromkeys(columns[name])) for name in header[:count]},
            "columns": {name: columns[name] for name in header[count:]
                        if any(value is not None for value in columns[name])}}


def grid_of_netcdf(file):
    import xarray  # only here: it takes a second
    with xarray.open_dataset(file) as data:
        data.load()
    dims = data["verdict"].dims
    words = data["verdict"].attrs["flag_meanings"].split()
    known = lambda value: None if value != value else float(value)
    columns = {name: [known(value) for value in data[name].values.ravel()]
               for name in data.data_vars if data[name].dims == dims and name != "verdict"}
    columns["verdict"] = [words[int(value)].replace("_", " ")
                          for value in data["verdict"].values.ravel()]
    boundary = [name for name in data.data_vars if name.startswith("hunting_boundary_")]
    return {"axes": {dim: [float(value) for value in data[dim].values] for dim in dims},
            "certainty": data.attrs["certainty"],
            "units": {name: data[name].attrs["units"] for name in columns if name != "verdict"},
            "columns": {name: values for name, values in columns.items()
                        if any(value is not None for value in values)},
            "curves": boundary and pieces(*(data[name].values for name in reversed(boundary)))}


def pieces(x, y):
    """Curves from points in order, with NaN between two of them."""
    curves = [[]]
    for point in zip(x, y):
        if point[0] != point[0]:
            curves.append([])
        else:
            curves[-1].append([float(value) for value in point])
    return {f"hunting_boundary {i}": curve for i, curve in enumerate(curves)}


# ---- motions ------------------------------------------------------------------------------------
SHAFTS = ("load_position", "load_speed", "motor_position", "motor_speed")


def motion(answer):
    columns, rows = answer["samples"]["columns"], answer["samples"]["rows"]
    events = [[event["time"], event["what"], event["energy_lost"],
               *(event[side][key] for side in ("before", "after") for key in SHAFTS)]
              for event in answer["events"]]
    return {"engine": answer["engine"], "until": answer["until"], "touches": len(answer["touches"]),
            "start": [answer["start"][key] for key in SHAFTS], "energy": answer["energy"] or {},
            "stopped": answer["stopped"]["reason"], "stopped_at": answer["stopped"]["time"],
            "samples": {name: [row[i] for row in rows] for i, name in enumerate(columns)},
            "events": events}


def table_of_motion(rows):
    header, *rows = rows
    return {"samples": {name_of_column(name): [value_of(row[i]) for row in rows]
                        for i, name in enumerate(header) if name != "is_apart"}}


def events_of_table(rows):
    """Columns: time, what, mode after, energy lost, four of the shafts before, four after."""
    return {"events": [[value_of(text) for i, text in enumerate(row) if i != 2]
                       for row in rows[1:]]}


def step_response(source):
    return source and chosen(source, "step rise_time overshoot settling_time final_error ripple")


def compare(answer):
    return {"places": {one.get("sensor") or one["name"]: {"encoder_step": one["encoder_step"],
                                       "response": step_response(one["step_response"]),
                                       "in_the_end": in_the_end(one["limit_cycle"])}
                       for one in answer["cases"]}}


def predicted(source):
    error = source["error"] or {}
    return {**chosen(source, "stable amplitude motor_amplitude period frequency input_amplitude"),
            "real gain": source["gain"]["real"], "imaginary gain": source["gain"]["imaginary"],
            "exact cycle": error.get("of_exact_cycle"), "amplitude error": error.get("amplitude")}


def describe(answer):
    is_closed = answer["engine"] == "closed form"
    return {**chosen(answer, "verdict engine"),
            "cycles": [cycle(one, is_closed) for one in answer["cycles"]],
            "analyses": {one["part"]: {
                **chosen(one, "in_loop"), "nonlinearity": one["nonlinearity"],
                **chosen(one["loop"], "numerator denominator delay"),
                "predicted": [predicted(each) for each in one["cycles"]],
                "unresolved": len(one["unresolved_angular_frequencies"])}
                for one in answer["analyses"]}}


READERS = {"limit-cycle": in_the_end, "design": design, "tune": tune, "tolerance": tolerance,
           "chart": grid, "map": grid, "simulate": motion, "describe": describe, "compare": compare}
