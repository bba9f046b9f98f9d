#!/usr/bin/env python3
"""Uses an installed Python module.

Usage: use_module.py DRIVE ANSWER          analyse, simulate and sweep; write the answer as JSON
       use_module.py --recommended DRIVE   draw a picture and make a dataset
       use_module.py --same ANSWER ANSWER  are two answers in JSON the same?
"""

import json
import pathlib
import sys


def use(drive_file: str, answer_file: str) -> None:
    import gearlash

    drive = gearlash.Drive.from_toml(pathlib.Path(drive_file))
    answer = gearlash.analyse(drive)
    pathlib.Path(answer_file).write_text(answer.to_json())
    assert answer.verdict == "hunts", answer.verdict
    samples = gearlash.simulate(drive, until=1.0).sampled(0.01)
    assert len(samples["time"]) == 101, len(samples["time"])
    amplitudes = gearlash.sweep(drive, {"gearbox.backlash": [0.05, 0.1]})["amplitude"]
    assert amplitudes[1] > amplitudes[0] > 0, amplitudes
    try:
        drive.with_({"gearbox.backlash": -1.0})
    except gearlash.InvalidInput:
        pass
    else:
        raise AssertionError("a negative backlash was accepted")


def use_recommended(drive_file: str) -> None:
    import matplotlib
    matplotlib.use("Agg")
    import gearlash
    import gearlash.plot
    import xarray

    drive = gearlash.Drive.from_toml(pathlib.Path(drive_file))
    gearlash.plot.motion(gearlash.simulate(drive, until=1.0)).figure.savefig("motion.png")
    data = gearlash.sweep(drive, {"gearbox.backlash": [0.05, 0.1]})
    assert isinstance(data, xarray.Dataset), type(data)


def without_provenance(report: object) -> object:
    if isinstance(report, dict):
        return {key: without_provenance(value) for key, value in report.items()
                if key not in ("provenance", "version", "command")}
    return [without_provenance(one) for one in report] if isinstance(report, list) else report


def main() -> None:
    match sys.argv[1:]:
        case ["--same", first, second]:
            one, other = (without_provenance(json.loads(pathlib.Path(name).read_text()))
                          for name in (first, second))
            assert one == other, "the answers differ"
        case ["--recommended", drive]:
            use_recommended(drive)
        case [drive, answer]:
            use(drive, answer)
        case _:
            sys.exit(__doc__)


main()
