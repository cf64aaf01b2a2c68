PARTS = ("explorer.html", "explorer.css", "explorer.js")
"""What the page is put together from, in this folder, beside its data and plotly."""
