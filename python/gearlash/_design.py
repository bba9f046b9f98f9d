"""What must change: designs, margins, production runs and tuned gains."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Union, get_args

from gearlash import _core, _records
from gearlash._analysis import Progress
from gearlash._arguments import (listed, mapping, number, one_of, optional_number, where_given,
                                 whole)
from gearlash._arguments import share as _share
from gearlash._drive import Drive
from gearlash._records import (Aim, Axis, BacklashDemand, Distribution, FeasibleValues,
                               HuntingMargin, ParameterTolerance, Quantity, SamplePlan,
                               SensitivityStudy, StudyQuestions, Target, TolerancedDrive,
                               ToleranceStudy, TunedDrive, TuneEffort, TuneTask, WidestBacklash)

TargetLike = Union[str, Target]
SeriesLike = Union[Drive, TolerancedDrive]

_DISTRIBUTIONS = tuple(getattr(_records, kind.__forward_arg__) for kind in get_args(Distribution))


def target(wanted: TargetLike, drive: Drive) -> Target:
    """Read a target as the tool does: "no-hunting", "amplitude <= 1 arcmin and frequency >= 5 Hz".

    Raises
    ------
    InvalidInput
        For unknown quantities, wrong units and contradictions.
    """
    return wanted if isinstance(wanted, Target) else _core.target(wanted, drive)


_target = target  # where an argument has its name


def design(drive: Drive, wanted: TargetLike, parameters: Sequence[str | Axis] | None = None, *,
           progress: Progress = None) -> dict[str, FeasibleValues]:
    """Find the values of single parameters that meet a target.

    Parameters
    ----------
    drive : Drive
    wanted : str or Target
        As of :func:`target`.
    parameters : sequence of str or Axis, optional
        Paths, ``"PATH=FROM:TO:COUNT[:log]"`` with units, or axes; default those that are easiest to
        change.
    progress : callable, optional
        As of :func:`gearlash.analyse`.

    Returns
    -------
    dict of path to FeasibleValues
        ``intervals`` in SI, certain to be all of them if ``kind`` is "certified".

    Raises
    ------
    InvalidInput
        For an unsound drive, target or parameter.

    Examples
    --------
    >>> import gearlash
    >>> servo = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
    >>> found = gearlash.design(servo, "no-hunting", ["servo.damping"])["servo.damping"]
    >>> found.kind, round(found.nearest, 6)
    ('certified', 0.849487)
    """
    asked = _core.usual_parameters(drive) if parameters is None else parameters
    answers = _core.design(drive, target(wanted, drive), _axes("parameters", asked, drive), progress)
    return {answer.parameter: answer for answer in answers}


def _axes(name: str, given: Sequence[Axis | str], drive: Drive) -> tuple[Axis, ...]:
    return tuple(_core.axis(name, one, drive) if isinstance(one, str) else one
                 for one in listed(name, given))


def margins(drive: Drive, axes: Sequence[Axis | str] = (), *,
            progress: Progress = None) -> HuntingMargin:
    """Report how far each parameter is from the border of hunting, and all of them together.

    Parameters
    ----------
    drive : Drive
    axes : sequence of Axis or str
        The parameters, as of :func:`design`; default those that a designer considers first.
    progress : callable, optional
        As of :func:`gearlash.analyse`.

    Raises
    ------
    InvalidInput
        For an unsound drive and for axes that it does not have.
    """
    return _core.margins(drive, _axes("axes", axes, drive), progress)


def series(drive: SeriesLike, varied: Mapping[str, Distribution] | None = None) -> TolerancedDrive:
    """Make a series of drives: a drive, and what varies from unit to unit.

    Parameters
    ----------
    drive : Drive or TolerancedDrive
        A drive from a file brings the file's tolerances.
    varied : mapping of path to Distribution
        UniformBetween, UniformAbout, Normal or DiscreteLots, in SI, beside those of the file.

    Returns
    -------
    TolerancedDrive

    Raises
    ------
    TypeError
        For something else than a drive or a distribution.
    """
    if not isinstance(drive, (Drive, TolerancedDrive)):
        raise TypeError("drive must be a gearlash.Drive or a gearlash.TolerancedDrive, not "
                        f"{type(drive).__name__}")
    nominal, own = ((drive.nominal, drive.varied) if isinstance(drive, TolerancedDrive)
                    else (drive, drive.tolerances))
    added = {}
    for path, spread in mapping("varied", varied or {}).items():
        if not isinstance(spread, _DISTRIBUTIONS):
            names = ", ".join(kind.__name__ for kind in _DISTRIBUTIONS)
            raise TypeError(f"varied must have one of {names} for {path}, not "
                            f"{type(spread).__name__}")
        added[path] = ParameterTolerance(path, spread)
    kept = tuple(one for one in own if one.path not in added)
    return TolerancedDrive(nominal=nominal, varied=kept + tuple(added.values()))


def tolerance(drive: SeriesLike, varied: Mapping[str, Distribution] | None = None, *,
              target: TargetLike | None = None, samples: int | None = None,
              error: float | None = None, seed: int = 1960, quantity: str = "amplitude",
              shares: Sequence[float] | None = None, bins: int | None = None, client: Any = None,
              progress: Progress = None) -> ToleranceStudy:
    """Predict how many samples of a production run hunt, and how many meet a target.

    Parameters
    ----------
    drive, varied
        As of :func:`series`.
    target : str or Target, optional
        For the yield.
    samples : int, optional
        The least number, at most 16,777,216, rounded up to 16 times a power of two; default 65,536
        in closed form, 512 with bounces, 64 of drives that are searched.
    error : float, optional
        Instead: as many as the probability of hunting and the yield need to be known to within this
        share, 1e-6 … 0.5.
    seed : int
        Equal seeds give equal bits on every machine.
    quantity : str
        "amplitude" of the load, or "motor_amplitude".
    shares : sequence of float, optional
        Of the samples, 0 … 1, for the quantiles; default 5, 25, 50, 75 and 95 %.
    bins : int, optional
        Of the histogram; default 40, 0 for none.
    client : distributed.Client, optional
        Deal the samples out to its workers; see :mod:`gearlash.distributed`. The study is the same
        for any number of workers. Not with `error`.
    progress : callable, optional
        As of :func:`gearlash.analyse`.

    Returns
    -------
    ToleranceStudy

    Raises
    ------
    InvalidInput
        With every fault of the drive, the distributions, the target and the sampling.

    Notes
    -----
    Sobol's sequence with random digital shifts (Owen; L'Ecuyer and Lemieux, 2002).

    Examples
    --------
    >>> import gearlash
    >>> servo = gearlash.Drive.normal_form(0.3, 2, 0.1, 0.3)
    >>> study = gearlash.tolerance(servo, {"servo.damping": gearlash.UniformBetween(0.7, 1.0)})
    >>> abs(study.hunting.value - (0.849487 - 0.7) / 0.3) < 1e-4
    True
    """
    one, questions, sampling = _study(drive, varied, target, samples, seed, quantity,
                                      shares=shares, bins=bins)
    if client is not None:
        from gearlash import distributed

        if error is not None:
            raise TypeError("client needs samples, not error")
        return distributed.study(one, sampling, questions, client, progress=progress)
    return _core.tolerance_study(one, sampling, questions, error, progress)


def sensitivity_indices(drive: SeriesLike, varied: Mapping[str, Distribution] | None = None, *,
                        samples: int | None = None, seed: int = 1960,
                        quantity: str = "amplitude", progress: Progress = None) -> SensitivityStudy:
    """Report which tolerance is responsible: Sobol's indices of amplitude and of hunting.

    Parameters are those of :func:`tolerance`.
    """
    one, questions, sampling = _study(drive, varied, None, samples, seed, quantity)
    return _core.sensitivity_indices(one, sampling, questions, progress)


def widest_backlash(drive: SeriesLike, target: TargetLike, share: float = 0.95, *,
                    least: float | None = None, varied: Mapping[str, Distribution] | None = None,
                    samples: int | None = None, seed: int = 1960,
                    progress: Progress = None) -> WidestBacklash | None:
    """Find how much backlash production may permit, so that a share of the samples meets a target.

    Parameters
    ----------
    drive, varied, samples, seed
        As of :func:`tolerance`. The backlash is uniform from `least` to the value that is sought.
    target : str or Target
        Without a lower limit of amplitude.
    share : float
        Of the samples that must meet the target, above 0 to 1.
    least : float, optional
        rad, from 0 on; default the lowest value of a backlash that varies, else its nominal value.
    progress : callable, optional
        As of :func:`gearlash.analyse`.

    Returns
    -------
    WidestBacklash or None
        rad; None where not even the least backlash gives the share.

    Raises
    ------
    InvalidInput
        With every fault of the drive, the target and the sampling.

    Examples
    --------
    >>> import gearlash
    >>> servo = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
    >>> varied = {"servo.damping": gearlash.UniformBetween(0.18, 0.2)}
    >>> widest = gearlash.widest_backlash(servo, "amplitude <= 0.1 rad", least=0.0, varied=varied)
    >>> round(widest.max, 2)
    0.13
    >>> print(gearlash.widest_backlash(servo, "amplitude <= 0.1 rad", varied=varied))  # from 0.3 on
    None
    """
    one, questions, sampling = _study(drive, varied, target, samples, seed, "amplitude")
    demand = BacklashDemand(target=questions.target, yield_=_share("share", share),
                            min=optional_number("least", least))
    return _core.widest_backlash(one, demand, sampling, progress)


def _study(drive: SeriesLike, varied: Mapping[str, Distribution] | None, wanted: TargetLike | None,
           samples: int | None, seed: int, quantity: str, **more: Any
           ) -> tuple[TolerancedDrive, StudyQuestions, SamplePlan]:
    one = series(drive, varied)
    for one_share in listed("shares", more.get("shares") or ()):
        if not 0.0 <= number("shares", one_share) <= 1.0:
            raise ValueError(f"shares must be from 0 to 1, not {one_share}")
    shafts: tuple[Quantity, Quantity] = ("amplitude", "motor_amplitude")
    questions = StudyQuestions(amplitude=one_of("quantity", quantity, shafts),
                               target=Target() if wanted is None else target(wanted, one.nominal),
                               **where_given(**more))
    plan = (_core.usual_sampling(one, questions) if samples is None
            else _core.sampling_of(whole("samples", samples, 1), 0))
    return one, questions, SamplePlan(plan.points, plan.replicates, whole("seed", seed, 0))


def tune(drive: SeriesLike, parameters: Sequence[str | Axis] | None = None, *,
         varied: Mapping[str, Distribution] | None = None, target: TargetLike | None = None,
         aim: Aim = "bandwidth", share: float = 1.0, least_phase_margin: float | None = None,
         units: int | None = None, rounds: int | None = None, evaluations: int | None = None,
         seed: int = 1960, progress: Progress = None) -> TunedDrive:
    """Find the best values of several parameters for a whole series of drives.

    Parameters
    ----------
    drive, varied
        As of :func:`series`; without tolerances it is one drive.
    parameters : sequence of str or Axis, optional
        Numbers to tune: from 0.1 to 10 times the present value, over ``"PATH=FROM:TO"`` with units,
        or over an axis; default the controller's gains above 0.
    target : str or Target, optional
        Which each unit must keep; default to come to rest, or to hunt by one step of the encoder at
        most, and not to run away.
    aim : str
        "bandwidth" (greatest), "settling" (shortest) or "static_error" (least), of the worst unit.
    share : float
        Of the units that must keep the target, above 0 to 1.
    least_phase_margin : float, optional
        rad; default 0.5235988 (30 deg).
    units : int, optional
        Of the series, to which each proposal is put; default 64.
    rounds, evaluations : int, optional
        Of proposing, and of proposals in each; default 8 and 60.
    seed : int
        Of the units.
    progress : callable, optional
        As of :func:`gearlash.analyse`.

    Returns
    -------
    TunedDrive

    Raises
    ------
    InvalidInput
        For faults of the series, the target and the ranges.

    Notes
    -----
    Mutapcic and Boyd, Optimization Methods and Software 24 (2009). Searched, not proved.
    """
    one = series(drive, varied)
    nominal = one.nominal
    axes = tuple(parameter if isinstance(parameter, Axis)
                 else _core.axis_to_tune(parameter, nominal)
                 for parameter in (listed("parameters", parameters) if parameters is not None
                                   else _core.usual_gains(nominal)))
    if not axes:
        raise ValueError("parameters must name at least one number; the drive has no gains above 0")
    tuned = {given.path for given in axes}
    task = TuneTask(
        series=TolerancedDrive(nominal, tuple(v for v in one.varied if v.path not in tuned)),
        tuned=axes,
        target=_core.usual_target(nominal) if target is None else _target(target, nominal),
        aim=aim, share=_share("share", share), **where_given(least_phase_margin=least_phase_margin))
    effort = TuneEffort(seed=whole("seed", seed, 0), **where_given(
        **{name: whole(name, value, 1) for name, value in
           {"units": units, "rounds": rounds, "evaluations": evaluations}.items()
           if value is not None}))
    return _core.tune(task, effort, progress)
