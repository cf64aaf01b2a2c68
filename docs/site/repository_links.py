"""What stands in a page for readers of the repository, and is no page of the site."""

import re


def adapt(app, name, source):
    """Name files that are no page instead of linking them, pages by their words, and make the graph of rules a table.

    The graph is a diagram of mermaid in the repository, which needs scripts.
    """
    text = re.sub(r"\[`?([^\]`]+)`?\]\(\.\./[^)]+\)", r"`\1`", source[0])
    text = re.sub(r"\[(\w+)\.md\](?=\(\1\.md)", wording, text)
    source[0] = re.sub(r"```mermaid\nflowchart LR\n(.*?)```", lambda found: table(found[1]), text, flags=re.DOTALL)


def wording(found):
    """A link with the page's words in place of its file's name; a capital where a sentence begins."""
    words = found[1].replace("_", " ")
    begins = re.search(r"(\A|[.!?]\s+|\n\s*\n|\n\s*- )\Z", found.string[: found.start()])
    return f"[{words.capitalize() if begins else words}]"


def table(edges):
    """Edges of a flowchart, one row for all that leave a node."""
    rows = {}
    for one, other in re.findall(r"(\w+) --> (\w+)", edges):
        rows.setdefault(one, []).append(f"`{other}`")
    lines = [f"| `{one}` | {', '.join(others)} |" for one, others in rows.items()]
    return "\n".join(["| rule | its results go to |", "|---|---|", *lines])


def setup(app):
    """Register it with Sphinx."""
    app.connect("source-read", adapt)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
