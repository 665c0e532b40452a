#!/usr/bin/env python3
"""Links of the Markdown files: each relative one leads to a file, and to a heading of it if it names one.

check_links.py ROOT         names every link that leads nowhere; exit code 1 if there is one
check_links.py --control D  writes pages with broken links into D and succeeds if each is found
"""
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.M | re.S)


def anchors(text):
    """Of the headings, as GitHub makes them: lower case, blanks to hyphens, no other punctuation."""
    found = set()
    for heading in re.findall(r"^#+ (.+)$", FENCE.sub("", text), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).strip().replace(" ", "-"))
    return found


def broken_links(page):
    """Pairs of line and target."""
    text = page.read_text(encoding="ascii")
    for number, line in enumerate(FENCE.sub(lambda m: "\n" * m.group().count("\n"), text).split("\n"), 1):
        for target in LINK.findall(line):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            file = page.parent / path if path else page
            if not file.exists() or (anchor and anchor not in anchors(file.read_text(encoding="ascii"))):
                yield number, target


def pages_of(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "*.md"], capture_output=True, text=True, check=False)
    names = listed.stdout.split() or [p.relative_to(root) for p in root.glob("**/*.md")]
    return [root / name for name in names if (root / name).exists()]


def check(root):
    count = 0
    for page in pages_of(root):
        for line, target in broken_links(page):
            print(f"{page.relative_to(root)}:{line}: {target} leads nowhere")
            count += 1
    return count


def control(folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "other.md").write_text("# How to: it's so\n\n```\n# No heading\n```\n")
    (folder / "page.md").write_text("[a](other.md) [b](other.md#how-to-its-so) [c](missing.md)\n"
                                    "[d](other.md#no-heading)\n![e](picture.png)\n")
    expected = [(1, "missing.md"), (2, "other.md#no-heading"), (3, "picture.png")]
    found = list(broken_links(folder / "page.md"))
    print(found)
    return found != expected


if sys.argv[1:2] == ["--control"]:
    sys.exit(control(pathlib.Path(sys.argv[2])))
sys.exit(check(pathlib.Path(sys.argv[1])) > 0)
