"""Size of the project in tokens: names, numbers, operators and strings that are no docstring, as `tokenize` counts them.

Docstrings, comments, names and layout cost nothing in it. Run: python validation/size.py, next to the numbers kept in
pyproject.toml. Whoever raises one of them lowers another in the same commit.
"""

import tokenize
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
FOLDERS = ("src/r37core", "src/r37studies", "src/r37imports", "src/r37", "tests", "validation")
MARGIN = 0.01
"""Share above a kept number from which on a test fails."""

_COUNTED = (tokenize.NAME, tokenize.NUMBER, tokenize.OP, tokenize.STRING)
_BEFORE_A_STATEMENT = (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.NL)


def tokens_of(file: Path) -> int:
    """Tokens of a file of Python."""
    count, before = 0, tokenize.NEWLINE
    with tokenize.open(file) as stream:
        for token in tokenize.generate_tokens(stream.readline):
            is_text = token.type == tokenize.STRING and before in _BEFORE_A_STATEMENT
            count += token.type in _COUNTED and not is_text
            if token.type not in (tokenize.COMMENT, tokenize.NL):
                before = token.type
    return count


def sizes(root: Path = ROOT) -> dict[str, int]:
    """Folder -> tokens of its files of Python; links are not followed."""
    files = {folder: [file for file in (root / folder).rglob("*.py") if file.resolve() == file] for folder in FOLDERS}
    return {folder: sum(map(tokens_of, of_folder)) for folder, of_folder in files.items()}


def kept_sizes(root: Path = ROOT) -> dict[str, int]:
    """Folder -> largest number of tokens, as pyproject.toml keeps it."""
    return tomllib.loads((root / "pyproject.toml").read_text())["tool"]["r37"]["tokens"]


if __name__ == "__main__":
    kept = kept_sizes()
    for folder, count in sizes().items():
        print(f"{folder:16} {count:8,} tokens, kept {kept[folder]:8,}{'  too many' * (count > (1 + MARGIN) * kept[folder])}")
    print(f"{'src':16} {sum(count for folder, count in sizes().items() if folder.startswith('src')):8,} tokens")
