#!/usr/bin/env python3
"""Plants one-line bugs and shows that the tests catch them (mutation testing: DeMillo, Lipton & Sayward 1978,
"Hints on Test Data Selection").

    python3 tests/mutation/run.py BUILD [--only TEXT] [--jobs N]

BUILD is a build folder of the Ninja generator in which everything is built. The sources stay as they are: a
changed copy of the one file is found first by the compiler, and the tests that are to catch the bug are
compiled with it and linked before the libraries. A bug is caught if the program of these tests fails, crashes
or runs for more than ten minutes; without bugs all must pass. Ends with 1 if less than 95 % are caught, and
names those that are not.
"""

import argparse
import concurrent.futures
import os
import re
import shlex
import subprocess
import sys
import tempfile
import time

from mutants import MUTANTS, TESTS, USERS

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
REQUIRED = 0.95
TIME_LIMIT = 600  # seconds


class Failure(Exception):
    """The check itself could not be made."""


def ninja_commands(build, target):
    out = subprocess.run(["ninja", "-C", build, "-t", "commands", target], capture_output=True, text=True)
    if out.returncode != 0:
        raise Failure(f"{build}: ninja knows no {target}: {out.stderr.strip()}; build everything there first")
    return out.stdout.splitlines()


class Programs:
    """How the build folder compiles and links."""

    def __init__(self, build):
        self.build = build
        self.commands = {}

    def of(self, target):
        if target not in self.commands:
            self.commands[target] = ninja_commands(self.build, target)
        return self.commands[target]

    def compiled_as(self, target, source):
        """The words of the command that compiles the source, and the unity file that it is part of, or None."""
        files = {}
        for line in self.of(target):
            words = shlex.split(line)
            if "-c" in words:
                files[words[words.index("-c") + 1]] = words
        if source in files:
            return files[source], None
        for unity, words in files.items():
            if "/Unity/" in unity and f'#include "{source}"' in open(unity, encoding="utf-8").read():
                return words, unity
        raise Failure(f"{source} is not part of {target}")

    def compile_command(self, target, source, overlay, output):
        words, unity = self.compiled_as(target, source["stands"])
        read = source["read"]
        if unity and read != source["stands"]:
            # The rest of the unity file with it, for its object stands in for the whole one.
            read = os.path.join(overlay, "unity.cxx")
            with open(unity, encoding="utf-8") as whole, open(read, "w", encoding="utf-8") as changed:
                changed.write(whole.read().replace(f'"{source["stands"]}"', f'"{source["read"]}"'))
        elif unity and source.get("whole"):
            read = unity
        words = words[:words.index("-c")]
        for option in ("-MT", "-MF", "-o"):
            at = words.index(option)
            del words[at:at + 2]
        words.remove("-MD")
        first = next(i for i, word in enumerate(words) if word.startswith("-"))
        return words[:first] + ["-I" + overlay] + words[first:] + ["-c", read, "-o", output]

    def link_command(self, target, objects, output):
        line = self.of(target)[-1]
        words = [w for w in shlex.split(line) if w not in ("&&", ":")]
        at = words.index("-o")
        tail = words[at + 2:]
        # What CMake does after linking (finding the tests' names) is no part of it.
        words = [w for w in words[:at] if not w.endswith(".o")] + objects + ["-o", output]
        return words + [w for w in tail if w.endswith((".a", ".so")) or ".so." in w or w.startswith("-l")
                        or w.startswith("-Wl")]


def sources_of(file, overlay):
    """What is compiled anew: the tests, what they share, and the file itself if it is no header, else its users."""
    tests = [os.path.join(ROOT, "tests", name) for name in TESTS[file]]
    support = {os.path.join(ROOT, "tests", "support", "bsdf_contract.cpp")
               for name in tests if "bsdf_contract.h" in open(name, encoding="utf-8").read()}
    sources = [{"stands": name, "read": name} for name in tests + sorted(support)]
    for user in USERS.get(file, []):
        path = os.path.join(ROOT, "src", user)
        sources.append({"stands": path, "read": path, "whole": True})
    if file.endswith(".cpp"):
        sources.append({"stands": os.path.join(ROOT, "src", file), "read": os.path.join(overlay, file)})
    return sources


def run_with(programs, file, text):
    """Whether the tests of `file` pass if that stands in it."""
    target = TESTS[file][0].split("/")[0] + "_tests"
    with tempfile.TemporaryDirectory(prefix="mutation.") as folder:
        overlay = os.path.join(folder, "include")
        changed = os.path.join(overlay, file)
        os.makedirs(os.path.dirname(changed))
        with open(changed, "w", encoding="utf-8") as out:
            out.write(text)
        objects = []
        for number, source in enumerate(sources_of(file, overlay)):
            objects.append(os.path.join(folder, f"{number}.o"))
            command = programs.compile_command(target, source, overlay, objects[-1])
            made = subprocess.run(command + ["-w"], cwd=programs.build, capture_output=True, text=True)
            if made.returncode != 0:
                raise Failure(f"{file}: does not compile: {made.stderr[-2000:]}")
        program = os.path.join(folder, target)
        made = subprocess.run(programs.link_command(target, objects, program), cwd=programs.build,
                              capture_output=True, text=True)
        if made.returncode != 0:
            raise Failure(f"{file}: does not link: {made.stderr[-2000:]}")
        try:
            ran = subprocess.run([program, "--gtest_brief=1", "--gtest_filter=-*Heavy*"], cwd=programs.build, capture_output=True,
                                 text=True, timeout=TIME_LIMIT)
        except subprocess.TimeoutExpired:
            return False, f"no end within {TIME_LIMIT} s"
        failed = sorted(set(re.findall(r"\[  FAILED  \] (\S+)", ran.stdout)))
        return ran.returncode == 0, ", ".join(failed[:3]) or f"exit status {ran.returncode}"


def text_of(file):
    with open(os.path.join(ROOT, "src", file), encoding="utf-8") as source:
        return source.read()


def mutated(file, before, after):
    text = text_of(file)
    if text.count(before) != 1:
        raise Failure(f"{file}: '{before}' stands there {text.count(before)} times; bring mutants.py up to date")
    return text.replace(before, after)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("build", help="build folder")
    parser.add_argument("--only", default="", help="only mutants whose file or description has this text")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    chosen = [m for m in MUTANTS if options.only in m[0] or options.only in m[3]]
    if not chosen:
        raise Failure(f"no mutant has '{options.only}' in it")
    programs = Programs(os.path.abspath(options.build))
    texts = [mutated(file, before, after) for file, before, after, _ in chosen]
    start = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        files = sorted({m[0] for m in chosen})
        for file, (passed, what) in zip(files, pool.map(lambda f: run_with(programs, f, text_of(f)), files)):
            if not passed:
                raise Failure(f"{file}: its tests fail without a bug: {what}")
        print(f"without bugs: the tests of {len(files)} files pass", flush=True)
        missed = []
        runs = pool.map(lambda pair: run_with(programs, pair[0][0], pair[1]), zip(chosen, texts))
        for number, (mutant, (passed, what)) in enumerate(zip(chosen, runs), 1):
            print(f"{number}/{len(chosen)} {'NOT CAUGHT' if passed else 'caught'}: {mutant[0]}: {mutant[3]}"
                  + ("" if passed else f" ({what})"), flush=True)
            if passed:
                missed.append(mutant)
    caught = len(chosen) - len(missed)
    print(f"{caught} of {len(chosen)} bugs caught ({100 * caught / len(chosen):.1f} %) in "
          f"{time.monotonic() - start:.0f} s")
    for file, before, after, what in missed:
        print(f"  not caught: {file}: {what}\n    {before}\n    {after}")
    return 0 if caught >= REQUIRED * len(chosen) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as failure:
        sys.exit(f"mutation: {failure}")
