"""Add words of templates and definitions to the frozen list that planner_ft.facts reads by.

    python scripts/freeze_words.py planner_ft/vocabulary/*.toml planner_ft/data/things.txt

A word that stands at least twice in the files is added with its count; listed words stay, since
readings of commands depend on them. Files with misspelt words on purpose are not for this.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path

from planner_ft.facts.words import FOLDER, known_words


def main(paths: list[str]) -> None:
    """Write the list again with the words of some files."""
    texts = (Path(path).read_text(encoding="utf-8").lower() for path in paths)
    counts = Counter(word for text in texts for word in re.findall(r"[^\W\d_]{2,}", text))
    found = {word: count for word, count in counts.items() if count > 1} | known_words()
    lines = (f"{word} {count}\n" for word, count in sorted(found.items()))
    (FOLDER / "known_words.txt").write_text("".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
