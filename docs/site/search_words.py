"""Words that lead to a page in the search, whatever its own words are: they count more than titles."""

from sphinx.addnodes import index

WORDS = {
    "assess": "my blade, safe, safe blade, is my blade safe, assess, verdict",
    "what_to_trust": "trust, limitations, limits, assumptions, what to trust",
    "which_blade": "best blade, which blade, compare blades, ranking",
    "interactions": "interaction, interactions, critical speed, critical speeds",
    "clearance_and_lining": "clearance, which clearance, which lining",
    "lining": "lining, abradable, wear",
    "your_blade": "mesh, import, own mesh, ansys, calculix",
    "requirements": "requirement, requirements, goodman, fatigue",
    "better_blade": "better blade, search, optimise, optimization",
}
"""Page -> searches that find it first."""


def add(app, doctree):
    """Put a page's words into the index, from which the search takes them."""
    words = WORDS.get(app.env.docname)
    if words:
        doctree.insert(0, index(entries=[("single", word, "", "main", None) for word in words.split(", ")]))


def setup(app):
    """Register it with Sphinx."""
    app.connect("doctree-read", add)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
