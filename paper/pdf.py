"""Makes paper.pdf of paper.md with pandoc and the first PDF engine that is there: python paper/pdf.py."""

import shutil
import subprocess
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import yaml

FOLDER = Path(__file__).parent
ENGINES = ("tectonic", "xelatex", "lualatex", "pdflatex", "weasyprint")
"""PDF engines of pandoc, besides typst as a program or as a Python package."""


class MissingToolError(RuntimeError):
    """A program that the paper needs is not installed."""


def pandoc():
    """Path of the newest pandoc: a program, or that of the Python package pypandoc_binary."""
    with suppress(ImportError, OSError):
        import pypandoc

        return pypandoc.get_pandoc_path()
    if program := shutil.which("pandoc"):
        return program
    raise MissingToolError("pandoc is missing: `pip install pypandoc_binary`, or see https://pandoc.org/installing.html")


def run(*words):
    """Run a program in the folder of the paper; what it says of an error is the error's message. Warnings are errors, too."""
    done = subprocess.run(words, cwd=FOLDER, capture_output=True, text=True)
    print(done.stdout, done.stderr)
    if done.returncode:
        raise RuntimeError(" ".join(done.stderr.split()))


def make(text, output):
    """Write the PDF of a text in the journal's form."""
    head = yaml.safe_load(text.read_text(encoding="utf-8").split("---\n")[1])
    words = [pandoc(), str(text), "--citeproc", "--standalone", "--fail-if-warnings", "--resource-path", str(FOLDER)]
    # templates of pandoc take authors as texts
    words += [f"--metadata=author:{author['name']}" for author in head["authors"]]
    # pandoc of Debian 12 cannot write typst
    writes_typst = "typst" in subprocess.run([words[0], "--list-output-formats"], capture_output=True, text=True).stdout.split()
    programs = [name for name in ("typst", *ENGINES) if shutil.which(name) and (writes_typst or name != "typst")]
    if programs:
        run(*words, f"--pdf-engine={programs[0]}", "--output", str(output))
    elif writes_typst and find_spec("typst"):
        import typst

        with TemporaryDirectory() as folder:
            page = Path(folder) / "paper.typ"
            run(*words, "--to=typst", f"--extract-media={folder}", "--output", str(page))
            typst.compile(page, output=output, root="/")
    else:
        raise MissingToolError(f"a PDF engine is missing: `pip install typst pypandoc_binary`, or one of {', '.join(ENGINES)}")


if __name__ == "__main__":
    make(FOLDER / "paper.md", FOLDER / "paper.pdf")
