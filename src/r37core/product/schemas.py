"""JSON schemas of the configuration files, for editors, in config/schemas.

`python -m r37core.product.schemas` writes them.
"""

import json
from pathlib import Path

from pydantic import BaseModel

from r37core.base.io import write_text
from r37core.config.blades import Blades
from r37core.config.fidelity import Levels
from r37core.config.scenes import Scenes

from .reading import CONFIG

MODELS: dict[str, type[BaseModel]] = {"config": CONFIG, "blades": Blades, "scenes": Scenes, "fidelity": Levels}


def schemas() -> dict[str, str]:
    """File name -> content. `changes` is for files that lie on top of config.yaml, where nothing is required."""
    made = {name: model.model_json_schema() for name, model in MODELS.items()}
    made["changes"] = {key: value for key, value in made["config"].items() if key != "required"}
    dialect = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return {f"{name}.schema.json": json.dumps(dialect | made[name], indent=1, ensure_ascii=False) + "\n" for name in made}


def main(folder: Path = Path("config/schemas")) -> None:
    """Write all of them."""
    for name, text in schemas().items():
        write_text(text, folder / name)


if __name__ == "__main__":
    main()
