"""What stands in a page for readers of the repository, as readers of the site need it."""

import re

_NUMBER = r"(?P<number>[-+]?\d[\d.,]*\d|[-+]?\d)<!--(?P<table>\w+):[^>]*-->"


def adapt(app, name, source):
    """Lead tables, numbers and the explorer to their pages, name other files of the repository, and pages by their words.

    The list of pages of the index becomes the contents at the side.
    """
    # of table_pages.py, which are of the site alone
    if name.startswith("tables/"):
        return
    text = re.sub(r"\]\(\.\./validation/tables(?:/(\w+)\.csv)?\)", lambda link: f"](tables/{link[1] or 'index'}.md)", source[0])
    text = re.sub(r"\[`?([^\]`]+)`?\]\(\.\./[^)]+\)", r"`\1`", text)
    text = re.sub(rf"\[[^\]]*\]\([^)]*\)|{_NUMBER}", number, text)
    text = text.replace("](results.md#the-explorer)", "](site:explorer.html)")
    text = re.sub(r"(!\[[^\]]*\]\(explorer\.png\))(?!\])", r"[\1](site:explorer.html)", text)
    text = re.sub(r"\[(\w+)\.md\](?=\(\1\.md)", wording, text)
    source[0] = re.sub(r"^## All pages\n.*?(?=^#|\Z)", contents, text, flags=re.DOTALL | re.MULTILINE)


def number(match):
    """A number as a link to the table that it is from; none within another link."""
    return match[0] if match["number"] is None else f"[{match['number']}](tables/{match['table']}.md){{.number}}"


def contents(section):
    """The lists of pages of a section, `- **Title**: [page](page.md), ...`, as contents."""
    groups = re.findall(r"^- \*\*(.*?)\*\*: (.*)$", section[0], re.MULTILINE)
    return "".join(f"```{{toctree}}\n:hidden:\n:caption: {title}\n{linked(pages)}\n```\n\n" for title, pages in groups)


def linked(pages):
    """Names of the pages that are linked, one a line."""
    return "\n".join(re.findall(r"\]\(([\w/]+)\.\w+\)", pages))


def wording(match):
    """A link with the page's words in place of its file's name; a capital where a sentence begins."""
    words = match[1].replace("_", " ")
    begins = re.search(r"(\A|[.!?]\s+|\n\s*\n|\n\s*- )\Z", match.string[: match.start()])
    return f"[{words.capitalize() if begins else words}]"


def setup(app):
    """Register it with Sphinx."""
    app.connect("source-read", adapt)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
