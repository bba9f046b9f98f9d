"""What of two records differs by more than is permitted; the command's help states the rules.

Each difference is a tuple: field, kind of change, multiple of the permitted difference, before,
after. Every record is of plain meanings; see the adapter. What is left out counts as None.
"""
import itertools
import math

def both(old, new, key, empty=None):
    """A part of two records; {} where one has none."""
    empty = {} if empty is None else empty
    return old.get(key, empty), new.get(key, empty)


# ---- kinds of values ----------------------------------------------------------------------------
def words(name, old, new, keys):
    for key in keys:
        before, after = old.get(key), new.get(key)
        if before != after:
            yield name + key, change_of(before, after), 1.0, before, after


def change_of(before, after):
    if after is None:
        return "missing"
    if before is None:
        return "given now"
    kinds = [value if isinstance(value, (str, bool)) else "other" for value in (before, after)]
    return "changed" if kinds == ["other", "other"] else "{} -> {}".format(*kinds)


def one_sided(name, olds, news):
    """Names that only one of two dictionaries has."""
    for key in olds.keys() ^ news.keys():
        yield name + key, "missing" if key in olds else "given now", 1.0, key in olds, key in news


def are_numbers(*values):
    return all(type(value) in (int, float) for value in values)


def number(name, before, after, relative, scale=0.0):
    """A number below a thousandth of its scale may differ by the same share of that scale."""
    if before == after:
        return
    if not are_numbers(before, after):
        yield name, change_of(before, after), 1.0, before, after
        return
    permitted = relative * (scale if abs(before) < 1e-3 * scale else abs(before))
    if not (excess := abs(after - before) / (permitted or 5e-324)) <= 1:
        yield name, "number", excess, before, after


def numbers(name, old, new, keys, relative, scale=0.0):
    for key in keys:
        yield from number(name + key, old.get(key), new.get(key), relative, scale)


def values(name, old, new, relative):
    """Of dictionaries: every number that either has."""
    yield from numbers(name, old, new, {**old, **new}, relative)


def columns(name, old, new, relative):
    """Lists of numbers or words of the same lengths, each of its own scale."""
    for key in {**old, **new}:
        before, after = old.get(key) or [], new.get(key) or []
        if len(before) != len(after):
            yield f"{name}{key}", "count", 1.0, len(before), len(after)
            continue
        scale = scale_of(before)
        for one, other in zip(before, after):
            yield from number(name + key, one, other, relative, scale)


def scale_of(list_of_values):
    return max((abs(value) for value in list_of_values
                if are_numbers(value) and math.isfinite(value)), default=0.0)


WEAKER, STRONGER = 1e-6, 1e-3  # changes of a proved bound that need no name


def bound(name, before, after, is_upper=True):
    if before is None or after is None or before == after:
        if before != after:
            yield name, "withheld" if after is None else "proved now", 1.0, before, after
        return
    weaker = (after - before if is_upper else before - after) / max(abs(before), 5e-324)
    if not weaker <= WEAKER:
        yield name, "weaker", weaker / WEAKER, before, after
    elif weaker < -STRONGER:
        yield name, "stronger", -weaker / STRONGER, before, after


def enclosure(name, before, after):
    """Both are said to hold the same number."""
    if before is None or after is None or before == after:  # both may be infinite
        if before != after:
            yield name, "withheld" if after is None else "proved now", 1.0, before, after
        return
    rounding = 1e-12 * scale_of(before)
    if not (after[0] <= before[1] + rounding and before[0] <= after[1] + rounding):
        yield name, "apart", 1.0, before, after
    elif not after[1] - after[0] <= (widest := 10 * (before[1] - before[0]) + rounding):
        yield name, "wider", (after[1] - after[0]) / (widest or 5e-324), before, after


def ranges(name, olds, news, relative):
    """Lists of values from one to another; the ends may be words."""
    if len(olds) != len(news):
        yield name, "count", 1.0, olds, news
        return
    for old, new in zip(olds, news):
        for before, after in zip(old, new):
            yield from number(name, before, after, relative, scale_of(old))


def distance_to(curve, x, y):
    """Of a point from a curve of points."""
    best = min(math.hypot(x - a, y - b) for a, b in curve)
    for (a, b), (c, d) in itertools.pairwise(curve):
        dx, dy = c - a, d - b
        if length := dx * dx + dy * dy:
            share = min(1.0, max(0.0, ((x - a) * dx + (y - b) * dy) / length))
            best = min(best, math.hypot(x - a - share * dx, y - b - share * dy))
    return best


def curves(olds, news, permitted):
    """By kind, as sets of points: which curve has a piece, and where one begins, does not count."""
    def of_kind(all_curves, kind):
        return [curve for name, curve in all_curves.items() if kind_of(name) == kind and curve]
    def kind_of(name):
        return name.rstrip(" 0123456789")
    for kind in dict.fromkeys(map(kind_of, [*olds, *news])):
        before, after = of_kind(olds, kind), of_kind(news, kind)
        if before == after:
            continue
        if not (before and after):
            yield kind, change_of(before or None, after or None), 1.0, len(before), len(after)
            continue
        scales = [[max(point[i] for curve in before for point in curve),
                   min(point[i] for curve in before for point in curve)] for i in (0, 1)]
        def placed(curve):
            return [[(point[i] - low) / (max(high - low, 1e-6 * abs(high)) or 1.0)
                     for i, (high, low) in enumerate(scales)] for point in curve]
        first, second = [placed(curve) for curve in before], [placed(curve) for curve in after]
        gap = max(min(distance_to(other, *point) for other in others)
                  for some, others in ((first, second), (second, first))
                  for curve in some for point in curve)
        if not gap <= permitted:
            yield kind, "moved", gap / permitted, "a curve", f"{gap:.3g} of its size away"


# ---- a motion in the end ------------------------------------------------------------------------
def of_cycle(old, new, is_exact):
    keys = "kind stability certainty mirror_image settles"
    yield from words("cycle.", old, new, [*keys.split(), "impacts per period", "events per period"])
    multiplier = old.get("multiplier")
    apart = abs(1.0 - multiplier) if multiplier is not None else 1e-9
    condition = min(1e6, max(1.0, 1.0 / max(apart, 1e-9)))
    relative = 1e-12 if is_exact else max(1e-9, 10 * (old.get("residual") or 0.0) * condition)
    swing = max(old["amplitude"], old["motor_amplitude"])
    for keys, scale in (("amplitude motor_amplitude center", swing),
                        ("period engaged_time separated_time", old["period"]),
                        ("frequency impact_speed encoder_steps", 0.0), ("multiplier", 1.0)):
        yield from numbers("cycle.", old, new, keys.split(), relative, scale)
    energy = scale_of(old.get("energy", {}).values())
    yield from numbers("cycle.energy: ", *both(old, new, "energy"),
                       ["total", "motor_friction", "load_friction", "impacts"], relative, energy)
    if (new.get("residual") or 0.0) > max(1e-9, 10 * (old.get("residual") or 0.0)):
        yield "cycle.residual", "grown", 1.0, old.get("residual"), new["residual"]


def of_irregular(old, new):
    yield from words("irregular.", old, new, ["motor_alone", "repeats"])
    def spread(key):
        return max(1e-9, (old.get(f"{key}_deviation") or 0.0) / old[key]) if old.get(key) else 0.02
    swing, period = spread("swing"), spread("period")
    yield from numbers("irregular.", old, new, ["amplitude", "motor_amplitude", "center", "swing"],
                       swing, max(old["amplitude"], old.get("motor_amplitude") or 0.0))
    yield from numbers("irregular.", old, new, ["period"], period)


def of_list(name, olds, news, compared):
    """Compares each motion with that nearest to it: equal sizes may come in another order."""
    def distance(old, new):
        others = sum(old.get(key) != new.get(key) for key in ("kind", "stability"))
        return 10 * others + sum(abs(math.log(new[key] / old[key])) for key in
                                 ("period", "amplitude") if old.get(key) and new.get(key))
    left = list(news)
    for old in olds:
        if new := min(left, key=lambda candidate: distance(old, candidate), default=None):
            left.remove(new)
            yield from compared(old, new)
        else:
            yield name, f"lost, {old.get('stability')}", 1, old["amplitude"], None
    for new in left:
        yield name, f"added, {new.get('stability')}", 1, None, new["amplitude"]


def of_cycles(old, new):
    is_exact = old.get("engine") == "closed form" and not old.get("servo", {}).get("restitution")
    yield from of_list("cycle", *both(old, new, "cycles", []),
                       lambda one, other: of_cycle(one, other, is_exact))


def of_ceiling(old, new):
    yield from words("ceiling.", old, new, "reason effort_reason below_limit meets_limit".split())
    for key in "load motor effort mesh_torque".split():
        yield from bound(f"ceiling.{key}", old.get(key), new.get(key))
    for key in "safe_position safe_speed".split():
        yield from bound(f"ceiling.{key}", old.get(key), new.get(key), is_upper=False)
    terms, others = both(old, new, "terms")
    for source in {**terms, **others}:
        for key in "size load motor effort".split():
            yield from bound(f"ceiling.{source}.{key}", terms.get(source, {}).get(key),
                             others.get(source, {}).get(key))


def of_margins(old, new):
    yield from words("margins.", old, new, ["hunts", "stopped"])
    yield from numbers("margins.", old, new, ["distance"], 1e-4)
    parameters, others = both(old, new, "parameters")
    yield from one_sided("margins: ", parameters, others)
    for path in parameters.keys() & others.keys():
        one, other = parameters[path], others[path]
        yield from words(f"margins: {path}.", one, other, ["certified", "choices", "undecided"])
        yield from numbers(f"margins: {path}.", one, other, ["below", "above"],
                           2 * (one.get("located") or 0.5e-9))


def of_motion_in_the_end(old, new):
    keys = ("verdict engine ends rests dissipative rests_engaged neutral_swings runs_away")
    yield from words("", old, new, keys.split())
    yield from words("certainty of ", *both(old, new, "certainty"),
                     ["verdict", "stability", "completeness"])
    yield from numbers("", old, new, ["growth_at_rest"], 1e-12, 1.0)
    yield from values("servo.", *both(old, new, "servo"), 1e-12)
    yield from of_cycles(old, new)
    yield from of_list("irregular", *both(old, new, "irregular", []), of_irregular)
    # The range of a rest that is only approached depends on the time watched.
    if not (old.get("rest is approached") or new.get("rest is approached")):
        yield from words("", old, new, ["rest is computed"])
        rest = old.get("rest", {})
        yield from numbers("rest.", rest, new.get("rest", {}), rest, 1e-9, scale_of(rest.values()))
    before, after = both(old, new, "thresholds")
    yield from one_sided("threshold of ", before, after)
    for key in before.keys() & after.keys():
        yield from ranges(f"threshold of {key}", [before[key]], [after[key]], 0.04)
    before, after = both(old, new, "enclosures")
    for key in {**before, **after}:
        yield from enclosure(f"bounds of {key}", before.get(key), after.get(key))
    yield from of_ceiling(*both(old, new, "ceiling"))
    before, after = both(old, new, "specification")
    yield from words("specification.", before, after, ["is_met"])
    yield from bound("specification.widest_backlash", before.get("widest_backlash"),
                     after.get("widest_backlash"), is_upper=False)
    yield from of_margins(*both(old, new, "margins"))
    before, after = both(old, new, "sensitivities")
    yield from words("sensitivities.", before, after, ["available"])
    yield from values("slope of ", *both(before, after, "slopes"), 1e-7)


# ---- what must change ---------------------------------------------------------------------------
def of_performance(name, old, new, relative):
    yield from words(name, old, new, ["verdict", "stable"])
    keys = ("growth_at_rest amplitude motor_amplitude frequency static_error natural_frequency "
            "damping stiffness bandwidth crossover phase_margin rise_time overshoot settling_time")
    yield from numbers(name, old, new, keys.split(), relative)


def of_feasible(name, old, new):
    """Ends that are proved are exact, those of a search are where it located them."""
    yield from words(name, old, new, ["certified", "reasons"])
    relative = 1e-9 if old.get("certified") else max(1e-6, 2 * (old.get("located") or 0.0))
    yield from number(f"{name}present", old.get("present"), new.get("present"), 1e-12)
    yield from ranges(f"{name}searched", *both(old, new, "searched", []), 1e-9)
    yield from ranges(f"{name}intervals", *both(old, new, "intervals", []), relative)
    yield from ranges(f"{name}undecided", *both(old, new, "undecided", []),
                      max(1e-6, relative))
    before, after = both(old, new, "borders", [])
    kinds = [{"borders": [kind for kind, _ in found]} for found in (before, after)]
    yield from words(name, *kinds, ["borders"])
    if len(before) == len(after):
        for (kind, at), (_, now) in zip(before, after):
            yield from number(f"{name}borders: {kind}", at, now, relative)
    yield from of_proved(f"{name}proved", *both(old, new, "proved", []))
    for key in ("nearest", "closest"):
        before, after = both(old, new, key)
        yield from number(f"{name}{key}", before.get("value"), after.get("value"), relative)
        yield from of_performance(f"{name}{key}.", before, after, 10 * relative)


def of_proved(name, olds, news):
    """Of each interval the parts over which the target is proved, by their whole extent."""
    def extent(all_parts):
        return sum(high - low for part in all_parts for low, high in part)
    if len(olds) != len(news):
        yield name, "count", 1.0, len(olds), len(news)
        return
    for old, new in zip(olds, news):
        before, after = extent([old]), extent([new])
        if after < 0.99 * before or before < 0.99 * after:
            yield name, "weaker" if after < before else "stronger", 1.0, before, after


def of_design(old, new):
    yield from words("", old, new, ["met"])
    yield from of_performance("present.", *both(old, new, "present"), 1e-9)
    parameters, others = both(old, new, "parameters")
    yield from one_sided("", parameters, others)
    for path in parameters.keys() & others.keys():
        yield from of_feasible(f"{path}: ", parameters[path], others[path])


def of_region(old, new):
    yield from columns("axis ", *both(old, new, "range"), 1e-3)
    yield from curves(*both(old, new, "curves"), 5e-3)


def of_tuned(name, old, new):
    yield from words(name, old, new, ["meets", "units", "met", "undecided", "by_derivatives"])
    yield from numbers(name, old, new, ["reached"], 1e-3)
    yield from values(f"{name}values: ", *both(old, new, "values"), 1e-2)


def of_tune(old, new):
    yield from of_tuned("", old, new)
    yield from words("", old, new, ["stopped", "integral_hunts"])
    yield from of_performance("present.", *both(old, new, "present"), 1e-9)
    yield from of_performance("nominal.", *both(old, new, "nominal"), 1e-2)
    before, after = both(old, new, "limiting")
    yield from of_performance("limiting.", before, after, 1e-2)
    yield from values("limiting values: ", *both(before, after, "values"), 1e-2)
    yield from of_tuned("without integral: ", *both(old, new, "without_integral"))


def of_tolerance(old, new):
    is_searched = old.get("is_searched")
    keys = "amplitude_of points replicates seed undecided unknown_amplitudes refused quiet reason"
    yield from words("", old, new, keys.split())
    before, after = both(old, new, "estimates")
    for name in {**before, **after}:
        yield from of_estimate(name, before.get(name), after.get(name), is_searched)
    relative = 1e-3 if is_searched else 1e-6
    yield from values("mean of ", *both(old, new, "means"), 1e-9)
    yield from values("deviation of ", *both(old, new, "deviations"), 1e-9)
    yield from values("worst ", *both(old, new, "worst_values"), relative)
    yield from of_performance("worst.", *both(old, new, "worst"), relative)
    yield from bound("proved", old.get("proved"), new.get("proved"))
    yield from numbers("", old, new, ["largest_of_single_drives"], relative)
    before, after = both(old, new, "allowance")
    yield from numbers("allowed backlash.", before, after, ["min", "max"], 1e-6)
    yield from of_estimate("allowed backlash.yield", before.get("yield"), after.get("yield"),
                           is_searched)


def of_estimate(name, old, new, is_searched):
    if not (old and new):
        yield from words("", {name: old}, {name: new}, [name])
        return
    if is_searched:
        if not (are_numbers(*old, *new) and abs(new[0] - old[0]) <= 0.1 * old[1]):
            yield from number(name, old[0], new[0], 1e-9, 1e-6)
        return
    yield from number(name, old[0], new[0], 1e-9, 1e-6)
    yield from number(f"{name}, its error", old[1], new[1], 1e-6, 1e-6)


# ---- grids --------------------------------------------------------------------------------------
CEILINGS = ("ceiling", "motor_ceiling", "effort_ceiling")
OF_A_STEP = ("rise_time", "overshoot", "settling_time")
NEWER = ("time_to_rest",)  # than the record


def of_grid(old, new):
    yield from columns("axis ", *both(old, new, "axes"), 1e-12)
    yield from words("", old, new, ["certainty"])
    units = ({name: unit for name, unit in side.get("units", {}).items() if name not in NEWER}
             for side in (old, new))
    yield from words("", *({"units": of_side} for of_side in units), ["units"])
    before, after = both(old, new, "columns")
    for name in ({**before, **after}).keys() - set(NEWER):
        one, other = both(before, after, name, [])
        if len(one) != len(other):
            yield f"column {name}", "count", 1.0, len(one), len(other)
            continue
        scale = scale_of(one)
        for i, there in enumerate(zip(one, other)):
            if name in CEILINGS:
                yield from bound(f"column {name}", *there)
            elif name == "verdict":
                yield from words("column ", *({name: verdict} for verdict in there), [name])
            elif name != "residual":
                yield from number(f"column {name}", *there, permitted_at(before, name, i), scale)
    yield from curves(*both(old, new, "curves"), 5e-3)


def permitted_at(columns_there, name, place):
    """By the residual and the multiplier of the cycle there; 2 % of a motion without these."""
    def at(quantity):
        return (columns_there.get(quantity) or [None] * (place + 1))[place]
    if name in ("growth_at_rest", "bandwidth", "phase_margin", "static_error"):
        return 1e-9
    if name in OF_A_STEP:
        return 1e-7
    if at("multiplier") is None:
        return 0.02 if at("amplitude") and "multiplier" in columns_there else 1e-9
    condition = min(1e6, 1.0 / max(abs(1.0 - at("multiplier")), 1e-6))
    return max(1e-9, 10 * (at("residual") or 0.0) * max(1.0, condition))


# ---- motions ------------------------------------------------------------------------------------
OF_AN_EVENT = ["time", "what", "energy lost", *(
    f"{shaft} {quantity} {side}" for side in ("before", "after") for shaft in ("load", "motor")
    for quantity in ("position", "speed"))]


def of_simulation(old, new):
    yield from words("", old, new, ["engine", "stopped", "touches"])
    yield from numbers("", old, new, ["until", "stopped_at"], 1e-9)
    yield from columns("", {"start": old.get("start", [])}, {"start": new.get("start", [])}, 1e-9)
    yield from numbers("energy.", *both(old, new, "energy"),
                       {**old.get("energy", {}), **new.get("energy", {})}, 1e-8,
                       scale_of(old.get("energy", {}).values()))
    yield from columns("sample: ", *both(old, new, "samples"), 1e-8)
    by_name = [{name: list(column) for name, column in zip(OF_AN_EVENT, zip(*events))}
               for events in both(old, new, "events", [])]
    yield from columns("event: ", *by_name, 1e-8)


def of_description(old, new):
    yield from words("", old, new, ["verdict", "engine"])
    yield from of_cycles(old, new)
    analyses, others = both(old, new, "analyses")
    for part in {**analyses, **others}:
        one, other = analyses.get(part, {}), others.get(part, {})
        name = f"{part}: "
        yield from words(name, one, other, ["in_loop", "unresolved"])
        yield from values(name, *both(one, other, "nonlinearity"), 1e-9)
        for side in ("numerator", "denominator"):
            yield from columns(name, {side: one.get(side, [])}, {side: other.get(side, [])}, 1e-9)
        yield from number(f"{name}delay", one.get("delay"), other.get("delay"), 1e-9)
        before, after = both(one, other, "predicted", [])
        if len(before) != len(after):
            yield f"{name}predicted cycles", "count", 1.0, len(before), len(after)
            continue
        for cycle, now in zip(before, after):
            yield from words(f"{name}predicted ", cycle, now, ["stable", "exact cycle"])
            keys = "amplitude motor_amplitude period frequency input_amplitude"
            yield from numbers(f"{name}predicted ", cycle, now, keys.split(), 1e-8)
            for keys, relative in ((["real gain", "imaginary gain"], 1e-8),
                                   (["amplitude error"], 1e-7)):
                yield from numbers(f"{name}predicted ", cycle, now, keys, relative, 1.0)


def of_places(old, new):
    places, others = both(old, new, "places")
    for place in {**places, **others}:
        one, other = places.get(place, {}), others.get(place, {})
        yield from numbers(f"{place}: ", one, other, ["encoder_step"], 1e-9)
        before, after = both(one, other, "response")
        for keys, scale in ((["step", *OF_A_STEP], 0.0),
                            (["final_error", "ripple"], before.get("step", 0.0))):
            yield from numbers(f"{place}: ", before, after, keys, 1e-6, scale)
        for field, *rest in of_motion_in_the_end(*both(one, other, "in_the_end")):
            yield f"{place}: {field}", *rest


def of_numbers(old, new):
    pairs = itertools.zip_longest(*both(old, new, "numbers", []), fillvalue="nothing")
    if first := next((pair for pair in pairs if pair[0] != pair[1]), None):
        yield "text", "changed", 1, *first


COMPARED = {"limit-cycle": of_motion_in_the_end, "design": of_design, "tune": of_tune,
            "tolerance": of_tolerance, "chart": of_grid, "map": of_grid, "sweep": of_grid,
            "simulate": of_simulation, "describe": of_description, "compare": of_places,
            "thesis": of_numbers}


def differences(question, old, new):
    """`old` is on record; both have a status and, unless the question was refused, a record."""
    yield from words("exit ", old, new, ["status"])
    yield from words("answer ", old, new, ["unreadable"])
    before, after = old.get("record"), new.get("record")
    if before is None or after is None:
        yield from one_sided("", *({"answer": record} if record is not None else {}
                                   for record in (before, after)))
        return
    compared = of_region if question["form"] == "svg" else COMPARED[question["verb"].split()[0]]
    yield from compared(before, after)
