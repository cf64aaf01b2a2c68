"""The documentation site, of Sphinx: make site writes it to site/, which opens from the disk without a network.

Why Sphinx, and how equations are drawn: docs/architecture.md.
"""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent.parent / "src")]

from source_pages import linkcode_resolve  # noqa: E402, F401  # a value of sphinx.ext.linkcode

from r37core import __version__  # noqa: E402

project = "r37"
version = release = __version__
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.linkcode", "api_pages", "equations", "explorer_page", "pictures"]
extensions += ["repository_links", "search_words", "source_pages", "table_pages"]
exclude_patterns = ["site/*", "tutorial.py"]

# pages are Markdown as GitHub shows it, with $...$ and $$...$$ for formulas
myst_enable_extensions = ["attrs_inline", "dollarmath"]
# site: leads to a page that Sphinx does not write
myst_url_schemes = {"http": None, "https": None, "site": "{{path}}"}
# links to headings, as far down as pages have any
myst_heading_anchors = 4
# make validation runs the notebook; the site shows what it has
nb_execution_mode = "off"

autodoc_member_order = "bysource"
# types stand in annotations
autodoc_use_type_comments = False
# `name` in a docstring is code
default_role = "code"
add_module_names = False
python_maximum_signature_line_length = 100
toc_object_entries = False

html_theme = "furo"
html_title = f"r37 {version}"
# filters of pictures on a dark page: black letters on white become white letters on its colour, with the hues that they had
html_theme_options = {"dark_css_variables": {"drawing": "invert(0.93) hue-rotate(180deg)", "rendering": "brightness(0.85)"}}
html_static_path = ["style"]
html_css_files = ["r37.css"]
# excerpts would be fetched, which browsers refuse to a page on the disk
html_show_search_summary = False
# pages and calls before the inside
html_search_scorer = str(HERE / "search_order.js")
html_copy_source = False
# no page leads to an index of all names
html_use_index = html_domain_indices = False
html_show_copyright = False
html_show_sphinx = False
