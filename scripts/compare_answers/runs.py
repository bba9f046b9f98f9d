"""Runs a tool on a question and reads its answer. Limits are of processor time, so that neither a
busy machine nor one with more cores changes them."""
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import threading

from . import answers_of_0_2 as adapter

HANGS = 900.0  # s of wall time, for a tool that waits for ever


def answer_of(tool, limit, question):
    """The exit status, the record or None, and the processor-seconds that it took."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if question["drive"]:
            (folder / adapter.INPUT).write_text(question["drive"], encoding="utf-8")
        command = [str(pathlib.Path(tool).resolve()), *adapter.ask(question)]
        status, seconds = run(command, folder, limit)
        answer = {"status": status}
        if status in (0, 1):
            printed = (folder / "printed").read_text(encoding="utf-8")
            try:
                answer["record"] = plain(adapter.read(question, folder, printed))
            except (AttributeError, IndexError, KeyError, TypeError, ValueError) as fault:
                answer["unreadable"] = f"{type(fault).__name__}: {fault}"
        return answer, seconds


def run(command, folder, limit):
    with open(folder / "printed", "wb") as printed:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=printed,
                                   stderr=subprocess.DEVNULL)
    whole = max(1, int(limit))
    resource.prlimit(process.pid, resource.RLIMIT_CPU, (whole, whole + 1))
    hanging = threading.Timer(HANGS, process.kill)
    hanging.start()
    _, ended, usage = os.wait4(process.pid, 0)
    hanging.cancel()
    process.returncode = os.waitstatus_to_exitcode(ended)
    is_stopped = process.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
    return ("over the limit" if is_stopped else process.returncode), usage.ru_utime + usage.ru_stime


def plain(value):
    """Without what is None or empty, and with 14 digits: more are rounding, and do not compress."""
    if isinstance(value, dict):
        return {key: inner for key, one in value.items()
                if (inner := plain(one)) is not None and inner != {} and inner != []}
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    return float(f"{value:.14g}") if isinstance(value, float) else value
