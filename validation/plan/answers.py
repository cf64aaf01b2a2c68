"""Which blade, which interactions, what large displacements change: the one set of runs, and what its answer was tried with."""

from evidence.plan import Item, Run, table

from plan.runs import ALL_SPEEDS, BLADES, DECIDING, SCENES

LINED, BARE = ([f"{kind}_{contact}" for kind in ("twice", "friction", "elastic")] for contact in ("abradable", "direct"))
# on the bare casing all speeds count, on the lining those about 1B/4; CS100 has its 1B/4 elsewhere
COARSE = [{"start": 750, "stop": 2000, "step": 50}]
ABOUT_1B_4 = {"": (1540, 1780), "_CS100": (1300, 1440)}


def tried(name, lined, bare, **changes):
    """Runs of other scenes or at another level: one for each group of blades that have their 1B/4 at the same speeds."""
    for group, (first, last) in ABOUT_1B_4.items():
        yield Run(
            name + group,
            keys={
                **DECIDING,
                "scenes": [*lined, *bare],
                "blades": [blade for blade in BLADES if (blade == "CS100") == bool(group)],
                "speeds": COARSE,
                "speeds_for": [{"scenes": lined, "speeds": [{"start": first, "stop": last, "step": 10}]}],
                **changes,
            },
            priority=2,
        )


CASES, CASES_CS100 = tried("cases", LINED, BARE)
COARSER, COARSER_CS100 = tried("cases_draft", *[[scene] for scene in SCENES], fidelity="draft")
LINEAR = Run(
    "linear",
    keys={
        **DECIDING,
        "structure": {"kinematics": "linear", "boundary": {"contact": "patches"}},
        "fidelity": "draft",
        "speeds": [{"start": 750, "stop": 2000, "step": 25}],
    },
)

RESPONSES = {"quadratic": ALL_SPEEDS.responses(BLADES, *SCENES), "linear": LINEAR.responses(BLADES, *SCENES)}

EVIDENCE = [
    Item(
        "evidence.answers.draw",
        {"table": table("answer"), "picture": "docs/answer.png"},
        {"ranking": f"{ALL_SPEEDS.folder}/ranking.csv"},
    ),
    Item(
        "evidence.answers.checks",
        {"table": table("answer_checks")},
        {
            "ranking": f"{ALL_SPEEDS.folder}/ranking.csv",
            "base": ALL_SPEEDS.responses(BLADES, *SCENES),
            "others": [
                *(file for run in (CASES, CASES_CS100) for file in run.responses(run.keys["blades"], *LINED, *BARE)),
                *(file for run in (COARSER, COARSER_CS100) for file in run.responses(run.keys["blades"], *SCENES)),
            ],
        },
    ),
    Item(
        "evidence.answers.interactions",
        {"lining": table("interactions_lining"), "bare": table("interactions_bare")},
        {
            "campbell": f"{ALL_SPEEDS.folder}/campbell.nc",
            "summary": f"{ALL_SPEEDS.folder}/summary.csv",
            "base": ALL_SPEEDS.responses(BLADES, *SCENES),
        },
    ),
    Item("evidence.answers.large_motion", {"table": table("large_motion"), "picture": "docs/large_motion.png"}, RESPONSES),
]
