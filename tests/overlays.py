"""Configuration of a copy changed by a small YAML that lies on top of one of its files."""

import yaml

from r37core.base.yaml_file import load_yaml


def overlay(project, name, text):
    """Lay `text` on config/`name`: mappings are joined, what else it names is replaced; comments are gone then."""
    file = project / "config" / name
    file.write_text(yaml.safe_dump(_joined(load_yaml(file), yaml.safe_load(text)), sort_keys=False, allow_unicode=True))


def _joined(below, above):
    if not (isinstance(below, dict) and isinstance(above, dict)):
        return above
    return below | {key: _joined(below.get(key), value) for key, value in above.items()}
