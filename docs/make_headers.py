#!/usr/bin/env python3
"""Writes docs/headers.md: a line for every header, its first sentence, folder by folder.

--check only tells whether the file is up to date (exit code 1 if it is not)."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TARGET = ROOT / "docs/headers.md"
FOLDERS = ["kernels", "host", "meshio", "atmosphere", "viewer"]

HEADER = """# Headers
Made by `docs/make_headers.py` from the first sentence of every header; `make lint` checks that it is up to date. What a
folder is for, and which others it may include, stands in [ARCHITECTURE.md](../ARCHITECTURE.md).
"""


def first_sentence(path):
    """The first sentence of the comment that a header begins with, without the header's own name."""
    comment = re.match(r"/\*\s*(.*?)\*/", path.read_text(), re.S)
    if not comment:
        sys.exit(f"{path.relative_to(ROOT)}: found no comment at the start, expected what the header is for")
    text = re.sub(r"\s*\n\s*\*?\s*", " ", comment[1]).strip()
    ended = re.match(r"(.*?)\.(?=\s+[A-Z(]|$)", text)
    text = ended[1] if ended else text
    text = re.sub(r"^[A-Z][\w /,-]{0,40}: ", "", text)
    return text.replace("|", "\\|")


def page():
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *FOLDERS], cwd=ROOT,
                            capture_output=True, text=True, check=True).stdout.split("\n")
    headers = sorted(Path(f) for f in listed if f.endswith((".h", ".hpp")) and (ROOT / f).is_file())
    folders = sorted({h.parent for h in headers}, key=lambda f: (FOLDERS.index(f.parts[0]), f))
    out = [HEADER]
    for folder in folders:
        out.append(f"\n## {folder}/\n| header | what |\n|---|---|\n")
        out += [f"| `{h.stem}` | {first_sentence(ROOT / h)} |\n" for h in headers if h.parent == folder]
    return "".join(out)


def main():
    text = page()
    if "--check" in sys.argv[1:]:
        if not TARGET.exists() or TARGET.read_text() != text:
            print("docs/headers.md is not up to date: run python3 docs/make_headers.py")
            return 1
    else:
        TARGET.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
