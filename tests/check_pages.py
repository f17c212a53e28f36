#!/usr/bin/env python3
"""Repeats the commands that Markdown pages show, and compares what they print with what the pages say they print.

Usage: check_pages.py SOURCE_DIR PROGRAM PAGE [--update]

HTML comments, which a reader does not see, mark the code blocks of a page. A mark stands on the line before its block.

- `<!-- file: NAME -->`: the block is the file NAME in the folder in which the commands run.
- `<!-- repeat -->`: bash runs the block and stops at the first command that fails. The next block without a language
  is what the commands print, on standard output and standard error together.
- `<!-- repeat: table -->`: as `repeat`, but the commands print the next table of the page.
- `<!-- repeat: quiet -->`: bash runs the block, and nothing is compared.

Blocks without a mark are not run. All blocks of a page run in one temporary folder, which holds the files of the page
and a link `cases` to the cases of SOURCE_DIR. `voussoir` is PROGRAM. Rules of the comparison:

- A line `…` of a page stands for any number of lines, and `…` within a line for any text.
- Words are compared one by one, whatever space lies between them.
- Numbers may differ by one unit of the last digit on the page, so a page may round them. Integers below 100 must be
  equal, because they count and number things.
- Times that depend on the machine are not compared (`DURATIONS`), and lines that show the progress of a command
  at the moment are left out (`PROGRESS`).

The exit status is 1 if a command fails or prints something else. With --update the program writes what it found into
the page: also a number that differs within the tolerance, rounded as on the page. Times and all `…` remain as they are.
"""

import os
import re
import subprocess
import sys
import tempfile
import time
from functools import lru_cache
from pathlib import Path

ELLIPSIS = "…"
DURATIONS = re.compile(r"\(\d+(\.\d+)? s\)$"            # gap: … (46.2 s)
                       r"|\bin \d+(\.\d+)? (s|min)\b"   # done in 12 s
                       r"|\b(assembly|factorization|iteration|modes) \d+\.\d+ s\b")  # cost of voussoir modal
PROGRESS = re.compile(r"^\S.*  (t = .* %|(share .*, |multiplier .*, )?(Newton iteration|iteration) \d)"
                      r"|\d (s|min) left\b|^(gravity|end)$")
ANY_NUMBER = r"[+-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?"
NUMBER = re.compile(r"(?<![\w.])" + ANY_NUMBER + r"(?!\w|\.\d)")  # no part of a name such as cs1-62m


class Block:
    """A fenced code block or a table: its mark, its language, its first line (from 0), its lines and their indentation."""

    def __init__(self, mark, language, first, indent):
        self.mark, self.language, self.first, self.indent, self.lines = mark, language, first, indent, []


def blocks_of(lines):
    """The fenced code blocks of a page, and its tables with the language `table`."""
    blocks, fence = [], None
    for number, line in enumerate(lines):
        found = re.match(r"(\s*)(`{3,})\s*(\w*)\s*$", line)
        if fence is None and found:
            fence = found.group(2)
            mark = re.match(r"\s*<!--\s*(file|repeat)(?:\s*:\s*(.*?))?\s*-->\s*$", lines[number - 1]) if number else None
            blocks.append(Block(mark.groups() if mark else None, found.group(3), number + 1, found.group(1)))
        elif fence is not None and found and found.group(2) == fence and not found.group(3):
            fence = None
        elif fence is not None:
            blocks[-1].lines.append(line.removeprefix(blocks[-1].indent))
        elif line.startswith("|"):
            if not lines[number - 1].startswith("|"):
                blocks.append(Block(None, "table", number, ""))
            blocks[-1].lines.append(line)
    return blocks


@lru_cache(maxsize=None)
def words_of(line):
    """A line without durations, with single spaces."""
    return " ".join(DURATIONS.sub("(duration)", line.strip()).split())


@lru_cache(maxsize=None)
def pattern_of(words, number, gap):
    """What a line of a page matches, whatever its numbers are: `number` for each number, `gap` for each `…`."""
    pieces = [number.join(re.escape(text).replace(r"\ ", r"\s+") for text in NUMBER.split(piece))
              for piece in words.split(ELLIPSIS)]
    return re.compile(gap.join(pieces))


def equal_numbers(expected, found):
    """Whether a number lies within one unit of the last digit of the one on the page."""
    mantissa, _, exponent = expected.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    if not decimals and not exponent and abs(int(expected)) < 100:
        return float(expected) == float(found)
    unit = 10.0 ** (int(exponent or 0) - decimals)
    return abs(float(expected) - float(found)) <= unit * (1.0 + 1e-6)


def agrees(expected, found):
    """Whether a found line is the one that the page shows."""
    words = words_of(expected)
    match = pattern_of(words, f"({ANY_NUMBER})", ".*?").fullmatch(words_of(found))
    return match is not None and all(map(equal_numbers, NUMBER.findall(words), match.groups()))


def difference(expected, found):
    """0 for lines that agree, else the share of different words, below 1: a changed line costs less than a missing one."""
    if agrees(expected, found):
        return 0.0
    one, other = set(expected.split()), set(found.split())
    return 0.1 + 0.8 * (1.0 - len(one & other) / max(len(one | other), 1))


def aligned(expected, found):
    """Pairs (line of the page, found line) of the cheapest alignment; one of the two is None where it has no partner."""
    cost = {(0, 0): (0.0, None)}
    for i in range(len(expected) + 1):
        any_lines = i > 0 and expected[i - 1].strip() == ELLIPSIS
        for j in range(len(found) + 1):
            ways = [cost[0, 0]] if i == j == 0 else []
            if i and j and not any_lines:
                ways.append((cost[i - 1, j - 1][0] + difference(expected[i - 1], found[j - 1]), (i - 1, j - 1)))
            if i:
                ways.append((cost[i - 1, j][0] + (0.0 if any_lines else 1.0), (i - 1, j)))
            if j:
                ways.append((cost[i, j - 1][0] + (0.0 if any_lines else 1.0), (i, j - 1)))
            cost[i, j] = min(ways, key=lambda way: way[0])
    pairs, at = [], (len(expected), len(found))
    while at != (0, 0):
        i, j = cost[at][1]
        skipped = i == at[0] and at[0] > 0 and expected[at[0] - 1].strip() == ELLIPSIS
        if not skipped:
            pairs.append((expected[i] if i < at[0] else None, found[j] if j < at[1] else None))
        at = (i, j)
    return pairs[::-1]


def rounded(shown, printed):
    """A found number with no more decimals than the number on the page has."""
    form = "e" if "e" in shown.lower() else "f"
    decimals, more = (len(re.sub(r"^[^.]*\.?|[eE].*", "", text)) for text in (shown, printed))
    if more <= decimals or ("e" in printed.lower()) != (form == "e"):
        return printed
    return f"{float(printed):{'+' if printed.startswith('+') else ''}.{decimals}{form}}"


def renewed(expected, found):
    """The found line, shortened as the line of the page is. As it is if it has other words."""
    words, text = " ".join(expected.split()), found.strip()
    match = pattern_of(words, f"({ANY_NUMBER})", "(.*?)").fullmatch(text)
    if not match:
        return found.rstrip()
    shown = re.findall(f"{NUMBER.pattern}|{ELLIPSIS}", words)
    for group in range(len(shown), 0, -1):
        new = ELLIPSIS if shown[group - 1] == ELLIPSIS else rounded(shown[group - 1], match.group(group))
        text = text[:match.start(group)] + new + text[match.end(group):]
    return found[:len(found) - len(found.lstrip())] + text


def new_line(shown, printed):
    """The line of a renewed page. The line of the page remains if only its space or its times differ."""
    if printed is None or shown is not None and shown.strip() == ELLIPSIS:
        return shown
    line = printed.rstrip() if shown is None else renewed(shown, printed)
    return shown if shown is not None and words_of(line) == words_of(shown) else line


def compare(page, block, found):
    """Prints the lines in which a block and what was found differ. Returns their number and the block's new lines."""
    bad, new, number = 0, [], block.first
    for shown, printed in aligned(block.lines, found):
        number += shown is not None
        same = shown is not None and (shown.strip() == ELLIPSIS or printed is not None and agrees(shown, printed))
        if not same:
            bad += 1
            print(f"{page}:{max(number, block.first + 1)}:\n  the page shows  {'(no line)' if shown is None else shown}\n"
                  f"  the command prints  {'(no line)' if printed is None else printed}")
        if same or printed is not None:
            line = new_line(shown, printed)
            new.append(block.indent + line if line else line)
    return bad, new


def run(page, block, folder, program):
    """Runs the commands of a block. Returns what they print, without lines of progress; ends the check if one fails."""
    environment = dict(os.environ, PATH=f"{folder / 'bin'}:{os.environ['PATH']}")
    (folder / "bin").mkdir(exist_ok=True)
    if not (folder / "bin/voussoir").exists():
        (folder / "bin/voussoir").symlink_to(program)
    began = time.monotonic()
    # stdbuf keeps the order of the lines of the two outputs.
    done = subprocess.run(["stdbuf", "-oL", "bash", "-e", "-c", "\n".join(block.lines)], cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    print(f"{page}:{block.first + 1}: {block.lines[0]} ({time.monotonic() - began:.1f} s)", flush=True)
    if done.returncode != 0:
        sys.exit(f"{page}:{block.first + 1}: the commands fail with exit status {done.returncode}:\n{done.stdout[-2000:]}")
    return [line for line in done.stdout.strip("\n").split("\n") if not PROGRESS.search(line)]


def main():
    arguments = [a for a in sys.argv[1:] if a != "--update"]
    if len(arguments) != 3:
        sys.exit(__doc__)
    source, program, page = (Path(a).resolve() for a in arguments)
    lines = page.read_text(encoding="utf-8").split("\n")
    if sum("<!-- repeat" in line or "<!-- file" in line for line in lines) != sum(b.mark is not None for b in blocks_of(lines)):
        sys.exit(f"{page}: a mark stands before something else than a code block")
    bad, changes, found, language = 0, [], None, ""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "cases").symlink_to(source / "cases")
        for block in blocks_of(lines):
            if block.mark is None and block.language == language and found is not None:
                differences, new = compare(page, block, found)
                bad, found = bad + differences, None
                changes.append((block, new))
            elif block.mark and block.mark[0] == "file":
                (folder / block.mark[1]).write_text("\n".join(block.lines) + "\n", encoding="utf-8")
            elif block.mark:
                if found is not None:
                    sys.exit(f"{page}:{block.first}: no block before this one shows what the commands before print")
                printed = run(page, block, folder, program)
                found, language = None if block.mark[1] == "quiet" else printed, block.mark[1] or ""
    if found is not None:
        sys.exit(f"{page}: no block shows what the last commands print")
    if "--update" in sys.argv:
        for block, new in reversed(changes):
            lines[block.first:block.first + len(block.lines)] = new
        page.write_text("\n".join(lines), encoding="utf-8")
    elif bad:
        print(f"{bad} lines differ. To renew the page: check_pages.py SOURCE_DIR PROGRAM PAGE --update")
        sys.exit(1)


main()
