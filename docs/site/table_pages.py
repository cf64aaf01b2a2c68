"""Pages of the tables of validation/tables, docs/tables/*.md: what each has, which sentences rely on it, what makes it."""

import re
import sys
from pathlib import Path
from pkgutil import resolve_name

ROOT = Path(__file__).parent.parent.parent
sys.path += [str(ROOT / "docs/site"), str(ROOT / "validation")]

from evidence import pages, tables  # noqa: E402
from evidence.plan import TABLES, Plan  # noqa: E402
from written_pages import write_folder  # noqa: E402

COMMAND = "snakemake -s validation/Snakefile --cores 2 --resources mem_mb=4600"


def caption(step):
    """First sentences of a step's docstring, without its inputs and outputs."""
    return " ".join(re.split(r"\s(?:Inputs?|Outputs?|Params):", resolve_name(step).__doc__)[0].split())


def statements(text, name):
    """Sentences of a page that link a table or take a number from it, as plain text."""
    blocks = re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )|\n(?=\|)", text)
    sentences = [sentence for block in blocks for sentence in re.split(r"(?<=[.!?])\**\s+(?=[*\[(A-Z])", block)]
    for sentence in sentences:
        if re.search(rf"tables/{name}\.csv|<!--{name}:", sentence):
            plain = re.sub(r"<!--.*?-->|[*`]|^\s*(?:[-*]|\d+\.)\s", "", re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", sentence))
            yield " ".join(plain.replace("|", " ").split())


def uses(texts, name):
    """Lines of a list: pages that rely on a table, and the sentences that do."""
    for page, text in texts.items():
        sentences = list(statements(text, name))
        if sentences or f"<!-- table {name}" in text or f"<!-- lines {name}" in text:
            heading = re.search(r"^# (.*)$", text, re.MULTILINE)[1]
            yield f"- [{heading}](../{page}.md)" + "".join(f"\n  > {sentence}\n" for sentence in sentences)


def table_page(name, item, stamp, texts):
    """Page of a table."""
    rows = tables.read_table(ROOT / TABLES / f"{name}.csv")
    # cells link pages from docs/
    table = pages.markdown(rows).replace("](", "](../")
    made = f"{{download}}`{name}.csv <../../{TABLES}/{name}.csv>` is made by `{item.step}`:"
    # as text: printed lines are wrapped
    command = f"```text\n{COMMAND} {stamp}\n```\n"
    return "\n\n".join([f"# Table: {words(name)}", caption(item.step), *uses(texts, name), table, made, command])


def list_page(items):
    """Page that lists all tables."""
    rows = [(f"[{words(name)}]({name}.md)", caption(item.step)) for name, item in items.items()]
    toctree = "\n".join(["```{toctree}", ":hidden:", *items, "```", ""])
    return "\n".join(["# All tables", "", pages.markdown([("table", "what it has"), *rows]), toctree])


def words(name):
    """Name of a table in words."""
    return name.replace("_", " ")


def write_pages(app):
    """Write the pages of all tables, and their list."""
    plan = Plan(ROOT)
    # a link to one that was never made is refused as a broken one
    made = (file for file in plan.committed if file.endswith(".csv") and (ROOT / file).exists())
    items = {Path(file).stem: plan.committed[file] for file in made}
    texts = {file.stem: file.read_text(encoding="utf-8") for file in sorted(Path(app.srcdir).glob("*.md"))}
    written = {name: table_page(name, item, plan.stamp(item), texts) for name, item in items.items()}
    write_folder(Path(app.srcdir) / "tables", ".md", written | {"index": list_page(items)})


def setup(app):
    """Register it with Sphinx."""
    app.connect("builder-inited", write_pages)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
