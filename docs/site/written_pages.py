"""Pages that an extension writes before Sphinx reads them."""


def write_folder(folder, suffix, pages):
    """Make `pages`, text by name, the files of a folder with this suffix. A page that is there already stays untouched."""
    folder.mkdir(exist_ok=True)
    for old in folder.glob(f"*{suffix}"):
        if old.stem not in pages:
            old.unlink()
    for name, text in pages.items():
        file = folder / f"{name}{suffix}"
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")
