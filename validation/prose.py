"""Prose of the project: length and words of README and docs/, and docstrings that cannot be read alone.

Run: python validation/prose.py (one line a page), with the name of a page for its longest sentences.
"""

import ast
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
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
    r"\bbeside\b": "next to, in addition to, apart from",
    r"\b(is|are|was|were|be) told\b|\bsaid once\b": "reported, printed, described",
    r"\b(certainly|possibly) above yield\b": "in most / in some revolutions",
    r"\bclaims?\b(?! to)": "table, picture",
    r"\bmade (anew|again)\b": "regenerated, rerun",
    r"\bwings?\b|\bspine\b": "extension, pipeline",
    r"\bis no measure\b|\bis no peak\b": "cannot be used, is not a peak",
    r"\b(takes whatever|whoever gives|whoever)\b": "users can, users who",
    r"[,;] for (it|they|there|this|these|its|their|he|we|no|none|others|machines|contact|modes)\b": "because",
}
"""Pattern of a word or a phrase -> what to write instead."""

_LEFT_OUT = (
    re.compile(r"<!-- [\w ]+(?:: [^\n]*)? -->\n.*?<!-- end -->", re.DOTALL),  # generated
    re.compile(r"^ *```.*?^ *```", re.DOTALL | re.MULTILINE),
    re.compile(r"^\$\$.*?^\$\$|\\\[.*?\\\]", re.DOTALL | re.MULTILINE),
    re.compile(r"^( {4}.*\n)+(?=\n|\Z)", re.MULTILINE),  # indented code
    re.compile(r"^ *\|.*$", re.MULTILINE),
    re.compile(r"^#.*$", re.MULTILINE),
    re.compile(r"!\[[^\]]*\]\([^)]*\)"),
    re.compile(r"<!--.*?-->", re.DOTALL),
)
_SOURCE = re.compile(r"<!--\S+?-->")
"""Source of a number in a sentence."""

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
    text = _SOURCE.sub("", text)
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


SOURCED = ("README.md", "index.md", "first_run.md", "assess.md", "what_to_trust.md", "which_blade.md", "interactions.md")
SOURCED += ("clearance_and_lining.md",)
"""Pages whose numbers all come from a table or from the configuration."""

_NAMES = re.compile(r"\b(\d[BT](/\d+)?|rotor 37|Python 3.\d+|[A-Z]+\d+)\b|^\d+\. ", re.MULTILINE)
_FACTORS = (1.0, 1e-3, 1e3, 0.10471975512)
"""Units of the configuration in those of the pages: the same, Hz in kHz, m in mm, rpm in rad/s."""


def configured(root=ROOT):
    """Numbers of the shipped configuration and of the examples, in units of the pages, as texts of four digits."""
    files = [*(root / "config").glob("*.yaml"), *root.glob("examples/*/*.yaml")]
    numbers = (abs(float(n)) for file in files for n in _numbers(yaml.safe_load(file.read_text(encoding="utf-8"))))
    return {f"{factor * number:.4g}" for number in numbers for factor in _FACTORS}


def _numbers(content):
    if isinstance(content, dict | list):
        for part in content.values() if isinstance(content, dict) else content:
            yield from _numbers(part)
    elif re.fullmatch(r"[-+\d.]+(e[-+]?\d+)?", str(content)):
        yield content


def unsourced(text, known):
    """Numbers in the sentences of a page that neither have their source behind them nor are `known`."""
    sentences = plain(re.sub(rf"[-+\d.,]*\d{_SOURCE.pattern}", "", text))
    sentences = re.sub(r"`[^`]*`|(?:https?|doi):\S+", "", sentences)
    numbers = re.findall(r"(?<![\w.])\d(?:[\d,.]*\d)?(?!\w)", _NAMES.sub("", sentences))
    return [number for number in numbers if f"{float(number.replace(',', '')):.4g}" not in known]


def pages(root=ROOT):
    """README, CONTRIBUTING and the pages of docs/, name -> text."""
    files = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").glob("*.md"))]
    return {file.name: file.read_text(encoding="utf-8") for file in files}


MOST_WORDS, MOST_OF_A_PAGE, MOST_ROWS, MOST_COLUMNS = 20_000, 2_000, 7, 8
"""Words of all pages and of each, rows and columns of a generated table on a page: of all but configuration.md."""


def large_tables(text):
    """Names of the generated tables of a page that have more than 7 rows or 8 columns."""
    tables = re.findall(r"<!-- table (\w+)[^\n]* -->\n(.*?)<!-- end -->", text, re.DOTALL)
    rows = {name: table.strip().splitlines() for name, table in tables}
    wide = {name: len(re.findall(r"(?<!\\)\|", lines[0])) - 1 > MOST_COLUMNS for name, lines in rows.items()}
    return [name for name, lines in rows.items() if len(lines) - 2 > MOST_ROWS or wide[name]]


_PREPOSITIONS = ("of", "on", "with", "from", "to", "at", "in", "by", "for")
_PRONOUNS = ("those", "that", "its", "their", "it", "they", "them", "as", "such", "else", "and", "or", "but")
_PLACES = ("between", "beside", "before", "after", "among", "without", "within", "under")
_QUESTIONS = ("what", "whether", "who")
_LEANS = {word.capitalize() for word in (*_PREPOSITIONS, *_PRONOUNS, *_PLACES, *_QUESTIONS)}
"""First words of a docstring that has its subject in the line above."""


def _trees(root):
    for file in sorted((root / "src").rglob("*.py")):
        yield file.relative_to(root), ast.parse(file.read_text(encoding="utf-8"))


def docstrings(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Docstrings of modules, classes and functions, and texts after an assignment: line and text."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            continue
        first, assigned = node.body[:1], zip(node.body, node.body[1:], strict=False)
        texts = [*first, *(text for before, text in assigned if isinstance(before, ast.Assign | ast.AnnAssign))]
        for text in texts:
            if isinstance(text, ast.Expr) and isinstance(text.value, ast.Constant) and isinstance(text.value.value, str):
                yield text.lineno, text.value.value


def leaning_docstrings(root=ROOT):
    """Docstrings that cannot be read without the line above, as `file:line: text`."""
    return [
        f"{file}:{line}: {text.splitlines()[0]}"
        for file, tree in _trees(root)
        for line, text in docstrings(tree)
        if text.split()[0].rstrip(",;:") in _LEANS
    ]


def main(names):
    """Print the figures of all pages, and the longest sentences of those that are named."""
    for name, text in pages().items():
        page = prose(text)
        if name in names:
            print("\n".join(sorted((f"{len(words(s)):3} {s}" for s in page.sentences), reverse=True)[:60]))
        if not names or name in names:
            mark = "" if page.is_short else "  too long"
            length = f"{name:16} {len(page.sentences):4} sentences, {page.mean:5.1f} words,"
            print(length, f"{page.share_of_long:5.1%} over {LONG}{mark}", *forbidden(text))
    print(sum(len(text.split()) for name, text in pages().items() if name != "configuration.md"), "words")
    print("docstrings that begin without their subject:", *leaning_docstrings(), sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
