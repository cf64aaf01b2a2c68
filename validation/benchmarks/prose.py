"""How long the sentences of README and docs/ are, and which words stand in them that the project does not use.

Run: python validation/benchmarks/prose.py (one line a page), or with the name of a page for its longest sentences.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
MEAN, LONG, SHARE = 20.0, 30, 0.12
"""Most words of a sentence on average, words of a long sentence, and the largest share of long ones."""

FORBIDDEN = {
    r"\bdear(er|est)?\b": "expensive",
    r"\bnudged?\b": "perturbed",
    r"\brefines? (itself|themselves)\b": "adaptive speed sampling",
    r"\breadings\b|\b(the|a|one|our) reading\b": "modelling choice",
    r"\bturned (once|alone|one at a time)\b": "varied",
    r"\bcasings? that gives? way\b": "flexible casing",
    r"\brotor that stands still\b": "cold clearance, or at rest",
    r"\bno longer the time\b": "too little time",
    r"\bthe march\b|\bstretch(es)? of samples\b": "time integration, constant-speed segment",
    r"[,;] for (it|they|there|this|these|its|their|he|we|no|none|others|machines|contact|modes)\b": "because",
}
"""Pattern of a word or a phrase -> what to write instead."""

_LEFT_OUT = (
    re.compile(r"<!-- \w+(?: made-with:\w+)? -->\n.*?<!-- end -->", re.DOTALL),  # generated
    re.compile(r"^ *```.*?^ *```", re.DOTALL | re.MULTILINE),
    re.compile(r"^\$\$.*?^\$\$|\\\[.*?\\\]", re.DOTALL | re.MULTILINE),
    re.compile(r"^( {4}.*\n)+(?=\n|\Z)", re.MULTILINE),  # indented code
    re.compile(r"^ *\|.*$", re.MULTILINE),
    re.compile(r"^#.*$", re.MULTILINE),
    re.compile(r"!\[[^\]]*\]\([^)]*\)"),
    re.compile(r"<!--.*?-->", re.DOTALL),
)
_LIST_ITEM = re.compile(r"^ *(?:[-*]|\d+\.) +", re.MULTILINE)
_END = re.compile(r"(?<!\b[A-Z]\.)(?<=[.!?])[)*\"”]*\s+(?=[\"(*_`\[]*[A-Z0-9`])")


@dataclass(frozen=True)
class Prose:
    """The sentences of a page."""

    sentences: tuple[str, ...]

    @property
    def lengths(self):
        """Words of each sentence."""
        return [len(words(sentence)) for sentence in self.sentences]

    @property
    def mean(self):
        """Words of a sentence on average."""
        return sum(self.lengths) / max(len(self.lengths), 1)

    @property
    def share_of_long(self):
        """Share of the sentences of more than LONG words."""
        return sum(length > LONG for length in self.lengths) / max(len(self.lengths), 1)

    @property
    def is_short(self):
        """Whether mean and share keep their bounds."""
        return self.mean <= MEAN and self.share_of_long <= SHARE


def words(sentence):
    """Words of a sentence: what stands between blanks and has a letter or a digit; code in a line is one word."""
    return [word for word in re.sub(r"`[^`]*`", "code", sentence).split() if re.search(r"\w", word)]


def plain(text):
    """The page's prose alone: no code, tables, headings, pictures and generated parts, links as their text."""
    for pattern in _LEFT_OUT:
        text = pattern.sub("\n\n", text)
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)


def prose(text):
    """The sentences of a page. A paragraph and an item of a list end one; so does a point before a capital, digit or code."""
    paragraphs = re.split(r"\n\s*\n", _LIST_ITEM.sub("\n\n", plain(text)))
    sentences = [" ".join(part.split()) for paragraph in paragraphs for part in _END.split(paragraph.strip())]
    return Prose(tuple(sentence for sentence in sentences if words(sentence)))


def forbidden(text):
    """What stands in a page that the project says otherwise -> what to write."""
    corrections = {}
    for pattern, better in FORBIDDEN.items():
        for match in re.finditer(pattern, plain(text), re.IGNORECASE):
            corrections[match[0]] = better
    return corrections


def pages(root=ROOT):
    """README and the pages of docs/, name -> text."""
    files = [root / "README.md", *sorted((root / "docs").glob("*.md"))]
    return {file.name: file.read_text(encoding="utf-8") for file in files}


def main(names):
    """Print the figures of all pages, or the longest sentences of those that are named."""
    for name, text in pages().items():
        page = prose(text)
        if name in names:
            print("\n".join(sorted((f"{len(words(s)):3} {s}" for s in page.sentences), reverse=True)[:60]))
        if not names or name in names:
            mark = "" if page.is_short else "  too long"
            length = f"{name:16} {len(page.sentences):4} sentences, {page.mean:5.1f} words,"
            print(length, f"{page.share_of_long:5.1%} over {LONG}{mark}", *forbidden(text))


if __name__ == "__main__":
    main(sys.argv[1:])
