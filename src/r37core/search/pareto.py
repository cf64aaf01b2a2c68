"""stub"""


def feasible(e):
    return e.status == "done" and all(m >= 0 for m in e.margins)


def best_designs(evaluated):
    return [e.name for e in sorted((e for e in evaluated if feasible(e)), key=lambda e: sum(e.objectives))]


def not_dominated(evaluated):
    ok = [e for e in evaluated if feasible(e)]
    return [
        e.name
        for e in ok
        if not any(all(b <= a for a, b in zip(e.objectives, o.objectives)) and o.objectives != e.objectives for o in ok)
    ]
