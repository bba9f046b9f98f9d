"""The commands record and compare."""
import argparse
import collections
import concurrent.futures
import fnmatch
import functools
import gzip
import json
import pathlib
import subprocess
import sys
import tomllib

from .differences import differences
from .questions import KINDS, all_questions
from .runs import answer_of

MOST = 5.0  # processor-seconds of a question in the record; longer ones are left out
LONGEST = 60_000  # characters of an answer in the record: a motion of thousands of events is longer
LIMIT = 60.0  # those that a compared tool may take


def put(tool, questions, limit, jobs):
    """Pairs of a question and what answer_of() gives, in order."""
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        yield from zip(questions, pool.map(functools.partial(answer_of, tool, limit), questions))


def packed(content):
    return json.dumps(content, separators=(",", ":"), ensure_ascii=False)


def record(tool, path, every, jobs, only):
    drives, cases, seconds = {}, [], collections.Counter()
    questions = [asked for asked in all_questions() if only in (None, asked["kind"])][::every]
    for asked, (answer, took) in put(tool, questions, MOST, jobs):
        seconds[asked["kind"]] += took
        if took > MOST or answer["status"] == "over the limit":
            print(f"left out, over {MOST:g} processor-seconds: {asked['name']}")
            continue
        if len(packed(answer)) > LONGEST:
            print(f"left out, with a long answer: {asked['name']}")
            continue
        if "unreadable" in answer:
            sys.exit(f"{asked['name']}: {answer['unreadable']}: the adapter does not fit the tool")
        text = asked["drive"]
        place = None if text is None else drives.setdefault(text, len(drives))
        cases.append(asked | {"drive": place, "answer": answer})
    version = subprocess.run([tool, "--version"], capture_output=True, encoding="utf-8", check=True)
    content = {"tool": version.stdout.strip(), "drives": list(drives), "cases": cases}
    pathlib.Path(path).write_bytes(gzip.compress(packed(content).encode(), 9, mtime=0))
    counts = collections.Counter((case["kind"], str(case["answer"]["status"])) for case in cases)
    for (kind, status), count in sorted(counts.items()):
        print(f"{kind}: {count} with exit status {status}")
    for kind, took in seconds.items():
        print(f"{kind}: {took:.0f} processor-seconds")


def recorded(path, only=None):
    content = json.loads(gzip.decompress(pathlib.Path(path).read_bytes()))
    for case in content["cases"]:
        if only in (None, case["kind"]):
            place = case["drive"]
            yield case | {"drive": None if place is None else content["drives"][place]}


class Expected:
    """The differences that a file names, and which of them were seen."""

    def __init__(self, path):
        text = pathlib.Path(path).read_text(encoding="utf-8") if path else "expected = []"
        self.entries = tomllib.loads(text)["expected"]
        for entry in self.entries:
            if not {"difference", "reason"} <= entry.keys() <= {"difference", "reason", "case"}:
                sys.exit(f"{path}: an entry has difference and reason, and may have case: {entry}")
        self.seen = [0] * len(self.entries)

    def reason_of(self, difference, case):
        for i, entry in enumerate(self.entries):
            if fnmatch.fnmatchcase(difference, entry["difference"]) and \
                    fnmatch.fnmatchcase(case["name"], entry.get("case", "*")):
                self.seen[i] += 1
                return entry["reason"]
        return None

    def unseen(self):
        return [entry for entry, count in zip(self.entries, self.seen) if not count]


def compare(path, tool, only, jobs, expected):
    cases = list(recorded(path, only))
    causes = collections.defaultdict(list)
    took = 0.0
    for case, (answer, seconds) in put(tool, cases, LIMIT, jobs):
        took += seconds
        for field, change, *found in differences(case, case["answer"], answer):
            difference = f"{case['kind']}: {field}: {change}"
            causes[expected.reason_of(difference, case), difference].append((*found, case))
    for (reason, difference), found in sorted(causes.items(), key=lambda cause: -len(cause[1])):
        excess, old, new, case = max(found, key=lambda each: each[0])
        print(f"{f'expected, {reason}: ' if reason else ''}{difference}: {len(found)} times; worst "
              f"{old!r} -> {new!r}, {excess:.3g} of what is permitted, in {case['name']}: "
              f"{case['verb']} {case['with']}")
    for entry in expected.unseen():
        print(f"expected, but not seen: {entry['difference']}: {entry['reason']}")
    differing = {case["name"] for (reason, _), found in causes.items() if not reason
                 for *_, case in found}
    print(f"{len(cases)} compared, of which {len(differing)} differ otherwise than expected; "
          f"{took:.0f} processor-seconds")
    return bool(differing)


def main(description):
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["record", "compare"])
    parser.add_argument("paths", nargs=2, help="TOOL RECORD, or RECORD TOOL")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--only", choices=list(KINDS))
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--expected", metavar="FILE.toml")
    arguments = parser.parse_args()
    if arguments.command == "record":
        record(*arguments.paths, arguments.every, arguments.jobs, arguments.only)
    else:
        expected = Expected(arguments.expected)
        sys.exit(compare(*arguments.paths, arguments.only, arguments.jobs, expected))
