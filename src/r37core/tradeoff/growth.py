"""How costs grow with the parameters."""

import numpy as np
import pandas as pd

PAIRS = (
    ("mesh_nodes", "model_cpu_s", "making the model"),
    ("mesh_nodes", "model_peak_memory_bytes", "memory of making the model"),
    ("fixed_interface_modes", "cpu_s", "one run"),
    ("boundary_nodes", "cpu_s", "one run"),
    ("boundary_nodes", "model_cpu_s", "making the model"),
    ("revolutions", "cpu_s", "one run"),
    ("revolutions", "bytes_written", "file of one run"),
    ("central_difference_step", "cpu_s", "one run"),
    ("exact_modal_step", "cpu_s", "one run"),
)
"""Parameter, cost, and what the cost is of."""

COLUMNS = ("parameter", "cost", "of", "first_value", "last_value", "first_cost", "last_cost", "exponent")


def growth_table(table: pd.DataFrame) -> pd.DataFrame:
    """First and last value and cost of each pair of parameter and cost, and the exponent of a power law between them."""
    rows = []
    for parameter, cost, purpose in PAIRS:
        costs = costs_of(table, parameter, cost)
        if len(costs) >= 3:
            values, several = costs.index.to_numpy(), costs.to_numpy()
            ends = (values[0], values[-1], several[0], several[-1])
            rows.append((parameter, cost, purpose, *ends, exponent_of(values, several)))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def costs_of(table: pd.DataFrame, parameter: str, cost: str) -> pd.Series:
    """Mean cost over the scenes by ascending value of a parameter, as far as they are known and positive."""
    rows = table[table["parameter"] == parameter]
    costs = rows.groupby(rows["value"].astype(float))[cost].mean().sort_index()
    return costs[(costs > 0.0) & (costs.index > 0.0)]


def exponent_of(values: np.ndarray, costs: np.ndarray) -> float:
    """Slope of log cost over log value, by least squares over the more expensive half: what is fixed dominates small cases."""
    largest = np.argsort(costs)[-max(3, (len(costs) + 1) // 2) :]
    return float(np.polyfit(np.log(values[largest]), np.log(costs[largest]), 1)[0])
