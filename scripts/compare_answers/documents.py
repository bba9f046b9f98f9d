"""The JSON of version 0.3, whose keys are the members of the structs, in the shapes of 0.2."""
import math


def range_of(bounds):
    return [bounds["low"], bounds["high"]] if bounds else None


def span(bounds, of=lambda value: value):
    return {"from": of(bounds["low"]), "to": of(bounds["high"])}


def spans(many, of=lambda value: value):
    return [span(bounds, of) for bounds in many]


def word_of(document, path):
    """A value as 0.2 had it: of a choice, the word."""
    facts = next((one for one in document["parameters"] if one["path"] == path), {"choices": []})
    words = facts["choices"]
    return lambda value: words[int(value)] if words and value is not None else value


SIDES = {0: "both", 1: "forward", -1: "backward"}


def cycle(source):
    energy = source["energy"]
    return {**source, "mirror_image": source["has_mirror_image"],
            "energy": energy and {**energy, "total": energy["lost"]}}


def irregular(source):
    return {**source, "motor_alone": source["is_motor_alone"]}


def rest(source):
    return source and {**source, **{key: range_of(source[key])
                                    for key in ("load", "motor", "error")}}


def bounds(source):
    return source and {"growth_at_rest": range_of(source["growth_at_rest"]),
                       **{key: range_of(source[key]) if source["has_cycle"] else None
                          for key in ("amplitude", "period", "multiplier")}}


def ceiling(source):
    return source and {**source, "value": source["load"], "below_limit": source["is_below_limit"]}


def margin(document):
    source = document["margin"]
    if not source:
        return None
    overall, combined = source["overall"], source["combined"]

    def one_of(one):
        of = word_of(document, one["parameter"])
        is_searched = one["kind"] == "searched"
        return {**one, "present": of(one["present"]), "certified": one["kind"] == "certified",
                "choices": [of(choice) for choice in one["choices"]],
                "located": one["located"] if is_searched else None}
    return {"hunts": source["hunts"] if source["is_known"] else None, "stopped": source["stopped"],
            "parameters": [one_of(one) for one in source["parameters"]],
            "overall": {"distance": overall["change"]["length"]}
            if overall and overall["change"] else None,
            "combined": combined and {"distance": combined["distance"]}}


def sensitivities(source):
    if not source:
        return None
    width = len(source["paths"])
    return {"available": source["reason"] is None, "numbers": [
        {"parameter": path, **{name: {"slope": source["slopes"][i * width + j]}
                               for i, name in enumerate(source["quantities"])}}
        for j, path in enumerate(source["paths"])]}


def in_the_end(answer, drive):
    cycles = answer["cycles"]
    starts = (answer["search"] or {"starts": []})["starts"]
    return {**answer, "drive": drive, "bounds": bounds(answer["bounds"]),
            "certainty": {"verdict": answer["certainty"],
                          "stability": cycles[0]["certainty"] if cycles else None,
                          "completeness": answer["completeness"]},
            "ceiling": ceiling(answer["ceiling"]), "specification": None,
            "dissipative": answer["is_dissipative"], "cycles": [cycle(one) for one in cycles],
            "rest": rest(answer["rest"]), "irregular": [irregular(i) for i in answer["irregular"]],
            "runaway": answer["search"] and [one for one in starts if one["end"] == "diverges"],
            "thresholds": [{**one, "direction": SIDES[one["direction"]]}
                           for one in answer["thresholds"]],
            "margin": None, "sensitivities": None}


def limit_cycle(document):
    answer, specified = document, document["specification"]
    found = in_the_end(answer, document["drive"])
    if specified is not None and answer["ceiling"]:
        load = answer["ceiling"]["load"]
        found["specification"] = {"widest_backlash": document["widest_backlash"],
                                  "is_met": load is not None and load <= specified["permitted"]}
    return {**found, "margin": margin(document),
            "sensitivities": sensitivities(document["sensitivity"])}


def loop(source):
    return source and {"stable": source["is_stable"], **{
        key: source[key] for key in ("bandwidth", "crossover", "phase_margin")}}


def performance(answer, keys):
    values = answer["values"]
    return {"verdict": answer["verdict"], **{key: values[key] for key in keys.split()}}


def designed(answer):
    form, step = answer["normal_form"], answer["step"] or {}
    return {"performance": performance(answer, "growth_at_rest amplitude frequency static_error"),
            "normal_form": form and {key: form[key] for key in
                                     ("natural_frequency", "damping", "stiffness")},
            "loop": loop(answer["loop"]), "response": step}


def distance(value, present):
    return abs(math.log(value / present)) if value > 0 and present > 0 else abs(value - present)


def feasible(document, parameter):
    values = parameter["values"]
    of = word_of(document, values["parameter"])
    present = values["present"]
    best = None
    if parameter["results"]:
        found = min(parameter["results"], key=lambda one: distance(one["value"], present or 0.0))
        best = {"value": of(found["value"]), **designed(found["answer"])}
    is_met = bool(values["intervals"])
    return {"parameter": values["parameter"], "present": of(present),
            "searched": span(values["searched"], of), "located": values["located"],
            "certified": values["kind"] == "certified" and not values["stopped"],
            "intervals": spans(values["intervals"], of),
            "undecided": spans(values["undecided"], of), "borders": values["borders"],
            "proofs": [{"proved": spans(proof["parts"], of),
                        "reason": None if proof["parts"] else proof["reason"]}
                       for proof in values["proofs"]],
            "nearest": best if is_met else None, "closest": None if is_met else best}


def design(document):
    source = document["design"]
    return {"drive": document["drive"], "present": designed(source["present"]["answer"]),
            "met": {"all": True, "none": False}.get(source["met"]),
            "answers": [feasible(document, one) for one in source["parameters"]]}


def tune(document):
    task, limiting = document["task"], document["tuned"]["limiting"]
    unit = 6.283185307179586 if task["aim"] == "bandwidth" else 1.0
    keys = "amplitude motor_amplitude frequency static_error"

    def tuned(source, paths):
        reached = source["reached"]
        return source and {**source, "values": dict(zip(paths, source["values"])),
                           "reached": reached if reached is None else reached / unit}
    paths = [axis["path"] for axis in task["tuned"]]
    without = document["without_integral"]
    return {"tuned": tuned(document["tuned"], paths),
            "present": performance(document["present"], keys),
            "nominal": performance(document["nominal"], keys),
            "stopped": document["tuned"]["stopped"],
            "limiting": limiting and {
                "values": dict(zip((one["path"] for one in task["series"]["varied"]),
                                   limiting["values"])),
                "performance": performance(limiting["answer"], keys)},
            "why_integral_action_hunts": document["why_integral_action_hunts"],
            "without_integral": without and tuned(
                without, [path for path in paths if "integral" not in path])}


NONE = {"value": None, "standard_error": None}


def tolerance(document):
    study, worst = document["study"], document["worst"]
    has_target = document["target_text"] is not None

    def quantiles(many):
        return [{"share": one["share"], **(one["value"] or NONE)} for one in many]

    def indices(source):
        return source or {"first_order": NONE, "total": NONE}
    count = len(document["drive"]["varied"])
    numbers = document["sensitivities"]["numbers"] or count * [
        {"of_amplitude": None, "of_hunting": None}]
    places = worst["numbers"] or count * [{"value": None, "place": "fixed"}]
    return {**study, "worst": worst["result"],
            "amplitude_of": "motor" if document["amplitude"] == "motor_amplitude" else "load",
            "yield": study["yield"] if has_target else None,
            "mean_amplitude": study["mean_amplitude"] or NONE,
            **{key: quantiles(study[key])
               for key in ("amplitude", "amplitude_of_hunting", "frequency")},
            "parameters": [{"parameter": moments["path"], **moments,
                            "indices_of_amplitude": indices(number["of_amplitude"]),
                            "indices_of_hunting": indices(number["of_hunting"]), "worst": place}
                           for moments, number, place in zip(document["moments"], numbers, places)],
            "proved": {**document["proved"],
                       "largest_of_single_drives": document["proved"]["largest"]},
            "backlash": document["backlash"]}


def curves(source):
    return source and [[[point["x"], point["y"]] for point in curve] for curve in source]


def grid(document):
    columns = {"verdict": document["verdicts"], **document["columns"]}
    if document["kinds"]:
        columns["target"] = document["kinds"]
    return {**document, "columns": columns,
            "hunting_boundary": curves(document["hunting_boundary"]),
            "dissipative_boundary": curves(document["dissipative_boundary"]),
            "regions": [{**region, "outlines": curves(region["outlines"])}
                        for region in document["regions"] or []]}


def simulate(document):
    samples = document["samples"]
    known = [name for name in samples["columns"] if name != "is_apart"]  # the last, which 0.2 had not
    return {**document, "stopped": {"reason": document["stop"], "time": document["end_time"]},
            "samples": {**samples, "columns": known}}


def predicted(source, cycles):
    balance, error = source["balance"], source["error"]
    return {"stable": balance["stable"], "amplitude": source["amplitude"],
            "motor_amplitude": source["motor_amplitude"], "period": balance["period"],
            "frequency": 1.0 / balance["period"], "input_amplitude": balance["amplitude"],
            "gain": balance["gain"], "error": error and {
                **error, "of_exact_cycle": error["exact"] if error["exact"] < cycles else None}}


KINDS = {"friction controlled backlash": "friction-controlled backlash",
         "inertia controlled backlash": "inertia-controlled backlash",
         "coulomb friction": "Coulomb friction"}


def describe(document):
    answer = document
    return {**in_the_end(answer, document["drive"]), "analyses": [
        {**one, "in_loop": any(one["loop"]["numerator"]),
         "nonlinearity": {**one["nonlinearity"], "kind": KINDS.get(one["nonlinearity"]["kind"],
                                                                   one["nonlinearity"]["kind"])},
         "cycles": [predicted(each, len(answer["cycles"])) for each in one["cycles"]],
         "unresolved_angular_frequencies": one["unresolved"]} for one in document["analyses"]]}


def compare(document):
    return {"cases": [{"name": one["name"], "encoder_step": one["encoder_step"],
                       "step_response": one["answer"]["step"],
                       "limit_cycle": in_the_end(one["answer"], one["drive"])}
                      for one in document["drives"]]}


OF = {"limit-cycle": limit_cycle, "design": design, "tune": tune, "tolerance": tolerance,
      "grid": grid, "simulate": simulate, "describe": describe, "compare": compare}


def in_shapes_of_0_2(document):
    return OF[document["schema"].split("/")[1]](document)
