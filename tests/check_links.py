#!/usr/bin/env python3
"""Checks the links of all Markdown pages, and the commands that they show.

Usage: check_links.py SOURCE_DIR [PROGRAM]

- Every relative link and picture leads to a file or folder of the source tree.
- Every anchor exists on its page, by the rules by which GitHub names headings.
- Every file under docs can be reached from docs/README.md by links (left out where that page is missing).
- Every `voussoir VERB --option` in a shell code block names a verb, and long options, that PROGRAM lists in
  `PROGRAM VERB --help` (left out without PROGRAM).
"""

import os
import re
import subprocess
import sys
import unicodedata
from functools import lru_cache
from pathlib import Path
from urllib.parse import unquote

SKIPPED_FOLDERS = {".git", ".cache", "build", "demo"}  # those of .gitignore: no part of the source tree
SHELLS = {"sh", "bash", "shell", "console"}
# Words that stand before a command and are none themselves.
PREFIXES = {"time", "nice", "nohup", "env", "exec", "sudo", "command", "xargs", "srun",
            "do", "then", "else", "elif", "if", "while", "until", "!", "{"}


def blank(match):
    """As many characters and lines as the match has, but no text: positions stay as they are."""
    return re.sub(r"[^\n]", " ", match.group(0))


class Page:
    """A Markdown page: its links with their lines, its anchors, its shell blocks with their lines."""

    def __init__(self, path):
        self.path = path
        self.blocks = []
        lines = path.read_text(encoding="utf-8").split("\n")
        text = self.without_fences(lines)
        text = re.sub(r"<!--.*?-->", blank, text, flags=re.S)
        self.anchors = self.anchors_of(text)
        self.links = self.links_of(re.sub(r"(?<!`)(`+)(?!`).+?(?<!`)\1(?!`)", blank, text, flags=re.S))

    def without_fences(self, lines):
        kept, fence, block = [], None, []
        for number, line in enumerate(lines, 1):
            mark = re.match(r"\s*(?:>\s*)?(`{3,}|~{3,})\s*([\w+-]*)", line)
            if fence is None and mark:
                fence, language, block, first = mark.group(1), mark.group(2).lower(), [], number + 1
            elif fence is not None and mark and mark.group(1).startswith(fence) and not mark.group(2):
                if language in SHELLS:
                    self.blocks.append((first, "\n".join(block)))
                fence = None
            elif fence is not None:
                block.append(line)
            else:
                kept.append(line)
                continue
            kept.append("")
        return "\n".join(kept)

    @staticmethod
    def anchors_of(text):
        headings = []
        lines = text.split("\n")
        for line, after in zip(lines, lines[1:] + [""]):
            hashes = re.match(r" {0,3}#{1,6}\s+(.*?)(?:\s+#+)?\s*$", line)
            if hashes:
                headings.append(hashes.group(1))
            elif re.match(r" {0,3}(=+|-+)\s*$", after) and line.strip() and not re.match(r"\s*([|>*+-]|#)", line):
                headings.append(line.strip())
        anchors, seen = set(), {}
        for heading in headings:
            anchor = anchor_of(heading)
            number = seen.get(anchor, 0)
            seen[anchor] = number + 1
            anchors.add(f"{anchor}-{number}" if number else anchor)
        anchors.update(re.findall(r"<[a-zA-Z][^>]*\s(?:id|name)=[\"']([^\"']+)[\"']", text))
        return anchors

    @staticmethod
    def links_of(text):
        target = r"<([^<>\n]*)>|((?:[^\s()<>]|\([^\s()]*\))*)"
        title = r"(?:\s+(?:\"[^\"]*\"|'[^']*'))?"
        patterns = [rf"\]\(\s*(?:{target}){title}\s*\)",
                    r"^ {0,3}\[[^\]^][^\]]*\]:\s*(?:<([^<>\n]*)>|(\S+))",
                    r"<(?:a|img)\s[^>]*?(?:href|src)=(?:\"([^\"]*)\"|'([^']*)')"]
        found = []
        for pattern in patterns:
            for match in re.finditer(pattern, text, flags=re.M):
                found.append((text.count("\n", 0, match.start()) + 1, match.group(1) or match.group(2) or ""))
        return sorted(found)


def anchor_of(heading):
    """What GitHub makes of a heading: its text in lower case, letters, digits, hyphens and underscores, - for a space."""
    heading = re.sub(r"!?\[([^\]]*)\](?:\([^)]*\)|\[[^\]]*\])", r"\1", heading)  # the text of a link
    heading = re.sub(r"</?[a-zA-Z][^>]*>", "", heading)
    if "`" not in heading:  # emphasis, which is none within code
        heading = re.sub(r"(?<!\w)(\*{1,3}|_{1,3})(\S(?:.*?\S)?)\1(?!\w)", r"\2", heading)
    kept = (c for c in heading.strip().lower() if c in " -_" or unicodedata.category(c)[0] in "LNM")
    return "".join(kept).replace(" ", "-")


@lru_cache(maxsize=None)
def page_at(path):
    return Page(path)


def exists_exactly(path):
    """Whether a file is there under this very name: some file systems do not tell capitals from small letters."""
    return path.exists() and (path.name in ("", "..") or path.name in os.listdir(path.parent))


class Checker:
    def __init__(self, root, program):
        self.root = root
        self.program = program
        self.faults = 0

    def fault(self, page, line, words):
        print(f"{page.path.relative_to(self.root)}:{line}: {words}")
        self.faults += 1

    def target_of(self, page, link):
        """The path a link leads to, or None where it leads out to the network."""
        if re.match(r"[a-zA-Z][a-zA-Z0-9+.-]*:|//", link):
            return None
        name = unquote(link.partition("#")[0].partition("?")[0])
        if not name:
            return page.path
        start = self.root if name.startswith("/") else page.path.parent
        return Path(os.path.normpath(start / name.lstrip("/")))

    def check_links(self, page):
        for line, link in page.links:
            target = self.target_of(page, link)
            if target is None:
                continue
            anchor = unquote(link.partition("#")[2])
            if not link:
                self.fault(page, line, "a link leads nowhere: ()")
            elif self.root not in (target, *target.parents):
                self.fault(page, line, f"{link} leads out of the source tree")
            elif not exists_exactly(target):
                self.fault(page, line, f"{link} does not exist")
            elif not anchor:
                continue
            elif target.suffix == ".md":
                if anchor not in page_at(target).anchors:
                    self.fault(page, line, f"{link}: no heading has the anchor #{anchor}")
            elif target.is_file() and (lines := re.fullmatch(r"L(\d+)(?:-L(\d+))?", anchor)):
                count = len(target.read_text(encoding="utf-8").splitlines())
                if int(lines.group(2) or lines.group(1)) > count:
                    self.fault(page, line, f"{link}: the file has {count} lines")

    def check_reach(self):
        """Files under docs that no link leads to, from docs/README.md on; a link to a folder leads to all that is in it."""
        docs = self.root / "docs"
        start = docs / "README.md"
        if not start.exists():
            return
        reached, waiting = {start}, [start]
        while waiting:
            page = page_at(waiting.pop())
            for _, link in page.links:
                target = self.target_of(page, link)
                if target is None or not target.exists():
                    continue
                for path in [target, *(target.rglob("*") if target.is_dir() and docs in target.parents else [])]:
                    if path not in reached:
                        reached.add(path)
                        if path.suffix == ".md" and path.is_file():
                            waiting.append(path)
        for path in sorted(docs.rglob("*")):
            if path.is_file() and path not in reached:
                print(f"{path.relative_to(self.root)}: no link leads here from docs/README.md")
                self.faults += 1

    @lru_cache(maxsize=None)
    def help_of(self, *verb):
        return subprocess.run([self.program, *verb, "--help"], capture_output=True, text=True, check=False).stdout

    @lru_cache(maxsize=None)
    def verbs(self, *verb):
        return set(re.findall(r"^  ([a-z]+) ", self.help_of(*verb), flags=re.M))

    @lru_cache(maxsize=None)
    def options(self, *verb):
        return set(re.findall(r"(?:^  |\[ )(--[a-z0-9-]+)", self.help_of(*verb), flags=re.M)) | {"--help"}

    def check_commands(self, page):
        for first, block in page.blocks:
            for line, words in commands_of(block):
                words = words_of_voussoir(words)
                if words is not None:
                    self.check_command(page, first + line, words)

    def check_command(self, page, line, words):
        if not words or words[0] in ("--help", "-h", "--version"):
            return
        verb = words[:1]
        if verb[0] not in self.verbs():
            self.fault(page, line, f"voussoir has no verb {verb[0]}")
            return
        if "PART" in self.help_of(*verb).partition("\n")[0] and len(words) > 1 and not words[1].startswith("-"):
            verb = words[:2]
            if verb[1] not in self.verbs(verb[0]):
                self.fault(page, line, f"voussoir {verb[0]} has no part {verb[1]}")
                return
        for word in words[len(verb):]:
            option = word.partition("=")[0]
            if re.match(r"--[a-zA-Z]", option) and option not in self.options(*verb):
                self.fault(page, line, f"voussoir {' '.join(verb)} has no option {option}")


def commands_of(block):
    """The simple commands of a shell block, each as its line (from 0) and its words, without quotes and comments."""
    lines, end = [], None
    for line in block.split("\n"):
        if end is not None:  # the text of a here-document
            end = None if line.strip() == end else end
            lines.append("")
            continue
        here = re.search(r"<<-?\s*[\"']?(\w+)[\"']?", line)
        end = here.group(1) if here else None
        lines.append(re.sub(r"^\s*\$ ", "", line))
    text = "\n".join(lines)
    words, word, quote, line, start = [], None, None, 0, 0
    position = 0

    def end_word():
        nonlocal word
        if word is not None:
            words.append(word)
        word = None

    while position < len(text):
        c = text[position]
        position += 1
        if quote is not None:
            if c == quote:
                quote = None
            else:
                word += c
        elif c == "\\" and position < len(text):
            if text[position] != "\n":
                word = (word or "") + text[position]
            else:
                line += 1
            position += 1
            continue
        elif c in "\"'":
            quote, word = c, word or ""
        elif c == "#" and word is None:
            position = text.find("\n", position)
            position = len(text) if position < 0 else position
            continue
        elif c in ";&|()`\n":
            end_word()
            if words:
                yield start, words
            words = []
        elif c in " \t<>":
            end_word()
        else:
            if not words and word is None:
                start = line
            word = (word or "") + c
        if c == "\n":
            line += 1
    end_word()
    if words:
        yield start, words


def words_of_voussoir(words):
    """What a command hands to voussoir, or None where it runs another program."""
    words = list(words)
    while words and (words[0] in PREFIXES or words[0].startswith("-") or re.match(r"\w+=", words[0])):
        words.pop(0)
    if words[:2] in (["docker", "run"], ["podman", "run"]) and "voussoir" in words:
        words = words[words.index("voussoir"):]
    return words[1:] if words and os.path.basename(words[0]) == "voussoir" else None


def main(arguments):
    if not 1 <= len(arguments) <= 2:
        sys.exit(__doc__)
    root = Path(os.path.abspath(arguments[0]))
    checker = Checker(root, arguments[1] if len(arguments) == 2 else None)
    pages = []
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(name for name in folders if name not in SKIPPED_FOLDERS)
        pages += [page_at(Path(folder) / name) for name in sorted(files) if name.endswith(".md")]
    if not pages:
        sys.exit(f"{root} has no Markdown pages")
    if checker.program and len(checker.verbs()) < 10:
        sys.exit(f"{checker.program} --help names fewer verbs than expected")
    for page in pages:
        checker.check_links(page)
        if checker.program:
            checker.check_commands(page)
    checker.check_reach()
    print(f"{len(pages)} pages, {sum(len(page.links) for page in pages)} links, {checker.faults} faults")
    return 1 if checker.faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
