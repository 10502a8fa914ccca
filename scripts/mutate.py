#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plants small faults in a copy of the core, one at a time, and checks whether its tests find them.

All faults are built into one program; an environment variable switches one on (mutation/Mutants.h).
Which faults are chosen depends only on the text of their lines: the same core gets the same faults.
For each, the tests that reach it are run, the most promising first, until one fails, crashes or
takes far longer than without it.

Usage: mutate.py [--lines N] [--seconds N] [--again] [--list] [FILE...]
FILE is a part of a path in Filters/Core, e.g. Patches/
"""
import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "build-mutants"
COPY = FOLDER / "source"
BUILD = FOLDER / "build"
PROGRAM = BUILD / "bin/IsodiamondCoreTests"
# Faults that no test can find, each with the reason: file | fault | reason.
HARMLESS = ROOT / "scripts/mutation/harmless.txt"
# Always the same random cases, and not many: a fault that only luck would find is not found.
ENVIRONMENT = {"ISODIAMONDS_SEED": "1", "ISODIAMONDS_CASES": "10"}

OPERATORS = {
    "<": ("<", ">", "std::less<>", "std::less_equal<>"),
    "<=": ("<", ">", "std::less_equal<>", "std::less<>"),
    ">": ("<", ">", "std::greater<>", "std::greater_equal<>"),
    ">=": ("<", ">", "std::greater_equal<>", "std::greater<>"),
    "==": ("==", "==", "std::equal_to<>", "std::not_equal_to<>"),
    "!=": ("==", "==", "std::not_equal_to<>", "std::equal_to<>"),
    "+": ("+", "+", "std::plus<>", "std::minus<>"),
    "-": ("+", "+", "std::minus<>", "std::plus<>"),
    "*": ("*", "*", "std::multiplies<>", "std::plus<>"),
}


class Fault:
    """A fault in a file: texts to put at places in it, with {} for the fault's number."""

    def __init__(self, path, kind, text, start, edits, what):
        self.path, self.kind, self.edits, self.start = path, kind, edits, start
        self.line = text.count("\n", 0, start) + 1
        self.lines = {self.line, *(text.count("\n", 0, at) + 1 for at, _, _ in edits)}
        source = text.splitlines()[self.line - 1].strip()
        self.words = f"{kind}: {what}"
        self.key = hashlib.sha256(f"{path}|{self.words}|{source}".encode()).hexdigest()

    def name(self):
        return f"{self.path}:{self.line}: {self.words}"


def blanked(text):
    """The text with comments, strings and directives blanked out; all else stays in its place."""
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ ]*#(?:[^\n]*\\\n)*[^\n]*'
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", "~", m[0]), text, flags=re.S | re.M)


def closing(text, start):
    """Where the bracket at a place is closed."""
    depth = 0
    for i in range(start, len(text)):
        depth += (text[i] in "([{") - (text[i] in ")]}")
        if depth == 0:
            return i
    return -1


def faults_of(path, text):
    """All faults that the patterns give."""
    code = blanked(text)
    # What is evaluated only by the compiler, or only looks like code that runs.
    for skipped in re.finditer(r"\b(assert|static_assert|noexcept|decltype|alignas|sizeof)\(", code):
        end = closing(code, skipped.end() - 1)
        code = code[:skipped.start()] + re.sub(r"[^\n]", "~", code[skipped.start():end + 1]) + code[end + 1:]
    code = re.sub(r"^\s*(template <|using |enum |case ).*$", lambda m: re.sub(r"[^\n]", "~", m[0]), code, flags=re.M)
    found = []

    def add(kind, start, edits, what):
        found.append(Fault(path, kind, text, start, edits, what))

    for m in re.finditer(r"(?<=[\w)\]}] )(<=|>=|==|!=|[<>+*-])(?=[ \n][\s]*[\w(~!*{-])", code):
        left, right, original, mutant = OPERATORS[m[1]]
        if text[m.start() - 9:m.start() - 1] == "operator" or m[1] == "-" and code[m.end()] == ">":
            continue
        kind = "comparison" if left in ("<", "==") else "arithmetic"
        tag = f"{left} (::mutants::Tag<{{}}, {original}, {mutant}>) {right}"
        after = {"std::less_equal<>": "<=", "std::less<>": "<", "std::greater<>": ">", "std::greater_equal<>": ">=",
                 "std::equal_to<>": "==", "std::not_equal_to<>": "!=", "std::plus<>": "+", "std::minus<>": "-"}
        add(kind, m.start(), [(m.start(), m.end(), tag)], f"{m[1]} becomes {after[mutant]}")
    for m in re.finditer(r"(?<= )(&&|\|\|)(?=\s)", code):
        dropped = "::mutants::On({}) |" if m[1] == "&&" else "!::mutants::On({}) &"
        what = " ".join(text[m.start():m.end() + 40].split())
        add("condition dropped", m.start(), [(m.end(), m.end(), " " + dropped)], what)
    for m in re.finditer(r"\b(if|while) \(", code):
        end = closing(code, m.end() - 1)
        condition = " ".join(text[m.end():end].split())
        add("never", m.start(), [(m.end(), m.end(), "!::mutants::On({}) && ("), (end, end, ")")], condition)
        if m[1] == "if":
            add("always", m.start(), [(m.end(), m.end(), "::mutants::On({}) || ("), (end, end, ")")], condition)
    for m in re.finditer(r"(?<![\w.'])(\d+)(U?)(?![\w.'])", code):
        if not re.search(r"\bconstexpr\b[^\n]*$", code[:m.start()].rsplit("\n", 1)[-1]):
            more = int(m[1]) + 1
            add("constant", m.start(), [(m.start(), m.end(), f"(::mutants::On({{}}) ? {more}{m[2]} : {m[0]})")],
                f"{m[0]} becomes {more}, column {m.start() - text.rfind(chr(10), 0, m.start())}")
    for m in re.finditer(r"\b(true|false)\b", code):
        other = {"true": "false", "false": "true"}[m[1]]
        add("constant", m.start(), [(m.start(), m.end(), f"(::mutants::On({{}}) ? {other} : {m[1]})")],
            f"{m[1]} becomes {other}")
    for m in re.finditer(r"\bstd::(min|max)(?=\()", code):
        maximum = str(m[1] == "max").lower()
        add("extreme", m.start(), [(m.start(), m.end(), f"::mutants::Extreme<{{}}, {maximum}>()")],
            f"{m[1]} becomes {'min' if m[1] == 'max' else 'max'}")
    # A call, an assignment, an increment, a jump: whole statements.
    statement = (r"(?<=[;{}] )|(?<=[;{}])(?:[~\s])*\n[ ]+"
                 r"((?:\+\+|--)?[\w:>.-]+(?:[\[(][^;{}]*)?(?: (?:[-+*/|&^]|<<|>>)?= [^;]*)?;)")
    for m in re.finditer(statement, code):
        if m[1] is None or "~" in m[1] or re.match(r"(return|throw|using|private|public|\w+ = default)\b", m[1]):
            continue
        start = m.start(1)
        add("statement removed", start, [(start, start, "if (!::mutants::On({})) ")], " ".join(m[1].split())[:60])
    for m in re.finditer(r"(?<![\w:>.])((?:this->)?[\w:]+)\((\w+(?:\[\w+\])?), (\w+(?:\[\w+\])?)\)(?! const| override|\n *\{| *:)", code):
        line = code[code.rfind("\n", 0, m.start()) + 1:m.start()]
        if m[1] in ("if", "while", "switch", "std::min", "std::max") or m[2] == m[3] or not re.search(r"[=(,]|return|\w", line):
            continue
        swapped = f"(::mutants::On({{}}) ? {m[1]}({m[3]}, {m[2]}) : {m[0]})"
        add("arguments swapped", m.start(), [(m.start(), m.end(), swapped)], m[0])
    return found


def chosen(path, text, lines_a_fault):
    """Some of a file's faults, of all kinds, in the order of hashes."""
    kinds = collections.defaultdict(list)
    for fault in sorted(faults_of(path, text), key=lambda fault: fault.key):
        kinds[fault.kind].append(fault)
    order = sorted(kinds, key=lambda kind: kinds[kind][0].key)
    turns = sorted((place, order.index(kind)) for kind, faults in kinds.items() for place in range(len(faults)))
    wanted = max(3, text.count("\n") // lines_a_fault)
    result, used = [], set()
    for place, kind in turns:
        fault = kinds[order[kind]][place]
        if len(result) < wanted and not any(start < to + 1 and at < end + 1 for start, end in used
                                            for at, to, _ in fault.edits):
            result.append(fault)
            used.update((at, to) for at, to, _ in fault.edits)
    return result


def planted(text, faults):
    """The text with faults in it, and with tables that are made when the program runs."""
    edits = sorted(((at, -end, end, new.format(fault.number)) for fault in faults for at, end, new in fault.edits),
                   reverse=True)
    for at, _, end, new in edits:
        text = text[:at] + new + text[end:]
    # Variable templates are initialised in no particular order; functions avoid that.
    for m in list(re.finditer(r"(template <[^\n]*>\ninline )constexpr (\w+) (\w+) = ([^;]*);", text)):
        text = text.replace(m[0], f"{m[1]}const {m[2]}& {m[3]}() {{ static const {m[2]} made = {m[4]}; return made; }}")
        text = re.sub(rf"\b{m[3]}<([^<>]*)>(?!\()", rf"{m[3]}<\1>()", text)
    text = re.sub(r"^inline constexpr (?=(?:auto|std::array<[^\n(]*>) \w+ =)", "inline const ", text, flags=re.M)
    text = re.sub(r"^( +static) constexpr (?=auto \w+ = Make)", r"\1 inline const ", text, flags=re.M)
    return re.sub(r'^static_assert\(([^\n]*), "[^\n]*"\);', r"inline const bool Asserted = (\1) || (std::abort(), true);",
                  text, flags=re.M)


def write_copy(sources, faults):
    """Copies the project; only changed files are written, so that builds are incremental."""
    for folder in ("Filters/Core", "Testing", "cmake"):
        for source in (ROOT / folder).rglob("*"):
            if source.is_file():
                name = str(source.relative_to(ROOT))
                text = source.read_bytes()
                if name in sources:
                    text = planted(sources[name], [fault for fault in faults if fault.path == name]).encode()
                write(COPY / name, text)
    write(COPY / "CMakeLists.txt", (ROOT / "CMakeLists.txt").read_bytes())
    write(COPY / "Mutants.h", (ROOT / "scripts/mutation/Mutants.h").read_bytes())


def write(target, text):
    if not target.exists() or target.read_bytes() != text:
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(text)


def build(jobs):
    """Builds the copy. @return the output if that failed, else nothing"""
    flags = f"-w -O2 -D_GLIBCXX_ASSERTIONS -include {COPY}/Mutants.h"
    subprocess.run(["cmake", "-S", COPY, "-B", BUILD, "-G", "Ninja", "-DISODIAMONDS_CORE_ONLY=ON",
                    "-DCMAKE_BUILD_TYPE=None", f"-DCMAKE_CXX_FLAGS={flags}"], check=True, stdout=subprocess.DEVNULL)
    # Discovery of tests runs the program; here it is not wanted.
    done = subprocess.run(["cmake", "--build", BUILD, f"-j{jobs}", "--target", "IsodiamondCoreTests", "--", "-k", "0"],
                          capture_output=True, text=True, check=False)
    return done.stdout + done.stderr if done.returncode != 0 else ""


def read(file):
    return json.loads(file.read_text()) if file.exists() else {}


def build_what_compiles(sources, faults, jobs):
    """Takes out faults that do not compile until the rest does. They are not tried again."""
    broken = read(FOLDER / "broken.json")
    faults = [fault for fault in faults if fault.key not in broken]
    while True:
        write_copy(sources, faults)
        output = build(jobs)
        if not output:
            return faults
        for what in (r"[^\n]*error:", ""):  # lines with errors, else all lines named in it
            bad = {(m[1], int(m[2])) for m in re.finditer(rf"{COPY}/(Filters/Core/[^:\n]*):(\d+):{what}", output)}
            left = [fault for fault in faults if not any((fault.path, line) in bad for line in fault.lines)]
            if len(left) < len(faults):
                break
        if len(left) == len(faults):
            sys.exit(output)
        print(f"{len(faults) - len(left)} do not compile")
        broken.update({fault.key: fault.name() for fault in faults if fault not in left})
        (FOLDER / "broken.json").write_text(json.dumps(broken, indent=0))
        faults = left


def run(test, number, limit, reached=None):
    """@return the exit code of a test, and how long it took"""
    environment = {**os.environ, **ENVIRONMENT, "ISODIAMONDS_MUTANT": str(number)}
    if reached:
        environment["ISODIAMONDS_REACHED"] = str(reached)
    start = time.monotonic()
    done = subprocess.run(["timeout", "-k", "1", f"{limit:.0f}", PROGRAM, f"--gtest_filter={test}"], env=environment,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return done.returncode, time.monotonic() - start


def measure_tests(jobs):
    """@return the seconds that each test takes, and the numbers of the faults that it reaches"""
    names, suite = [], ""
    for line in subprocess.run([PROGRAM, "--gtest_list_tests"], capture_output=True, text=True,
                               check=True).stdout.splitlines():
        line = line.split("#")[0].rstrip()
        if line.endswith("."):
            suite = line
        elif line.startswith("  "):
            names.append(suite + line.strip())

    def measure(name):
        file = FOLDER / ("reached-" + name.replace("/", "-"))
        code, seconds = run(name, -1, 3600, file)
        if code != 0:
            print(f"{name} fails without a fault, and is left out")
        return name, (seconds, [int(number) for number in file.read_text().split()] if code == 0 else [])

    file = FOLDER / "tests.json"
    known = read(file)
    built = str(PROGRAM.stat().st_mtime)
    if known.get("built") != built:
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            known = {"built": built, "tests": dict(pool.map(measure, names))}
        file.write_text(json.dumps(known))
    return {name: (seconds, set(numbers)) for name, (seconds, numbers) in known["tests"].items()}


class Hunt:
    """Looks for faults with the tests that reach them; first with those that found many quickly."""

    def __init__(self, tests, faults, seconds):
        self.tests, self.seconds = tests, seconds
        self.runs, self.finds = collections.Counter(), collections.Counter()
        # The part of what a test reaches that is in a file: largest for the file that it is about.
        self.part = collections.Counter()
        path_of = {fault.number: fault.path for fault in faults}
        for name, (_, numbers) in tests.items():
            for number in numbers & path_of.keys():
                self.part[name, path_of[number]] += 1 / len(numbers)

    def price(self, name, path):
        """The seconds that this test is likely to take for each fault that it finds."""
        chance = (self.finds[name] + 1) / (self.runs[name] + 4) + self.finds[name, path] / (self.runs[name, path] + 1)
        chance += self.part[name, path]
        return (self.tests[name][0] + 0.05) / chance

    def look_for(self, fault):
        """@return the test that finds a fault; "" if none does, "-" if none reaches it"""
        left = {name for name, (_, numbers) in self.tests.items() if fault.number in numbers}
        if not left:
            return "-"
        spent = 0.0
        while left and spent < self.seconds:
            name = min(left, key=lambda name: (self.price(name, fault.path), name))
            left.remove(name)
            code, took = run(name, fault.number, 10 + 8 * self.tests[name][0])
            spent += took
            for key in (name, (name, fault.path)):
                self.runs[key] += 1
                self.finds[key] += code != 0
            if code != 0:
                return name + (" (too slow)" if code in (124, 137) else "")
        return ""


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--lines", type=int, default=25, help="lines for each fault; 3 faults at least")
    arguments.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments.add_argument("--seconds", type=float, default=float("inf"), help="at most for each fault")
    arguments.add_argument("--again", action="store_true", help="only those that survived, or were not looked for, the last time")
    arguments.add_argument("--list", action="store_true", help="only lists what would be planted")
    arguments.add_argument("files", nargs="*")
    options = arguments.parse_args()

    sources = {str(path.relative_to(ROOT)): path.read_text()
               for path in sorted((ROOT / "Filters/Core").rglob("*")) if path.suffix in (".h", ".cpp")}
    faults = [fault for path, text in sources.items() for fault in chosen(path, text, options.lines)]
    # The numbers in a file do not depend on other files' faults: else all would be built again.
    files = list(sources)
    counts = collections.Counter()
    for fault in faults:
        fault.number = 1000 * files.index(fault.path) + counts[fault.path]
        counts[fault.path] += 1
    asked = [fault for fault in faults if not options.files or any(name in fault.path for name in options.files)]
    results_file = FOLDER / "results.json"
    results = read(results_file)
    if options.list:
        print("\n".join(fault.name() for fault in asked))
        return
    FOLDER.mkdir(exist_ok=True)
    faults = build_what_compiles(sources, faults, options.jobs)
    tests = measure_tests(options.jobs)
    print(f"{len(tests)} tests, {sum(seconds for seconds, _ in tests.values()):.0f} s")
    asked = sorted((fault for fault in faults if fault in asked), key=lambda fault: fault.number % 1000)  # all files
    reasons = {tuple(line.split(" | ")[:2]) for line in HARMLESS.read_text().splitlines()}

    def is_harmless(fault):
        return (fault.path, fault.words) in reasons

    if options.again:
        asked = [fault for fault in asked if results.get(fault.key, "") in ("", "-")
                 and not (fault.key in results and is_harmless(fault))]
    print(f"{len(asked)} faults", flush=True)

    hunt = Hunt(tests, faults, options.seconds)

    def judge(fault):
        found = hunt.look_for(fault)
        results[fault.key] = found
        results_file.write_text(json.dumps(results, indent=0))
        if found in ("", "-"):
            what = "harmless" if is_harmless(fault) else "survived" if found == "" else "not reached"
            print(f"{what}: {fault.name()}", flush=True)
        return found not in ("", "-")

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        found = list(pool.map(judge, asked))
    harmless = sum(not is_found and is_harmless(fault) for is_found, fault in zip(found, asked))
    print(f"{time.strftime('%Y-%m-%d')}: {len(asked)} planted, {sum(found)} found, {harmless} harmless, "
          f"{len(asked) - sum(found) - harmless} survived")


if __name__ == "__main__":
    main()
