"""All tables, pictures and generated pages of README and docs/, and what makes each."""

from __future__ import annotations

from .claim import STUDIES, Claim, Output, picture, tables
from .texts import differences, summary

_SWEEP = "results/figures"
_ELASTIC = "results/runs/elastic_casing/figures"
_MAKE = "{snakemake} all_blades"
_BLADES = ("config/blades.yaml", "config/profiles/rotor37.csv", "config/stacking/rotor37.csv")
_STRUCTURE = "config/config.yaml:structure"
_LINED, _DIRECT = "config/scenes.yaml:abradable", "config/scenes.yaml:direct"


def _levels(*names: str) -> tuple[str, ...]:
    """What levels are, without what was measured of them."""
    return tuple(f"config/fidelity.yaml:{name}.{part}" for name in names for part in ("mesh", "reduction", "time_integration"))


_BENCHMARK = (*_BLADES, _STRUCTURE, _LINED, _DIRECT, *_levels("standard"))
"""Configuration of the default sweep but for its speeds."""

_SPEEDS = ("config/config.yaml:speeds",)
_ALL = ("structure", "lined", "direct")


def _study(name: str, *more: str) -> tuple[str, ...]:
    """Files of a study of r37core.studies that decide about its tables: what is run, and what is said."""
    return tuple(f"src/r37core/studies/{name}/{module}.py" for module in ("cases", "report", *more))


_CHECKS = ("src/r37core/studies/checks.py", "src/r37core/published.py", "src/r37core/studies/modelling_choices/validation.py")

_GALLERY = (
    *("campbell", "modes", "mesh", "reference", "spectrum_lined", "spectrum_direct", "revolution", "histories", "stress"),
    *("wear_content", "variants", "variants_spectra", "variants_response", "clearances", "peak_histories", "widths"),
)
_GALLERY_DRAWING = tuple(f"src/r37core/figures/{one}.py" for one in ("style", "campbell_diagram", "cells", "maps", "offscreen"))
_GALLERY_DRAWING += ("src/r37core/studies/modelling_choices/figures.py", "src/r37core/studies/gallery/figures.py")
_GALLERY_DRAWING += ("src/r37core/studies/gallery/shapes.py",)

_VALIDATION_PICTURES = ("reference", "blades", "stress", "histories", "spectrum_lined", "spectrum_direct")
_PATCHES = ("convergence", "worst", "levels", "published", "blades", "statements", "layers", "stiffness", "peaks")

# the gallery stands in docs/ whatever is run, so that of patches is made there and moved
_GALLERY_OF_PATCHES = (
    "mkdir -p build/gallery && cp -r docs/gallery.md docs/gallery build/gallery/",
    "{snakemake} gallery --configfile config/config.yaml config/patches.yaml",
    f"mv docs/gallery.md {STUDIES}/contact_patches/gallery.md && cp -r build/gallery/. docs/",
)
_USER_CODE = dict.fromkeys(("03_two_blades", "04_spectrum", "05_wear", "06_growth", "07_friction"), ())
_USER_CODE |= {
    name: ("src/r37core/figures/style.py", f"src/r37core/{module}.py")
    for name, module in {
        "01_campbell": "figures/campbell_diagram",
        "02_response": "figures/response_curves",
        "08_run_ups": "run_ups/figures",
        "09_tolerances": "tolerances/figures",
        "10_designs": "designs/figures",
    }.items()
}
"""Figures of docs/user_code.md, and what draws them where a call of r37 does."""

_TOLERANCES = "{snakemake} tolerances --configfile config/config.yaml config/tolerances.yaml --config"

_EXPLORER = tuple(
    f"src/r37core/explorer/{name}"
    for name in (
        "frame.html",
        "explorer.html",
        "explorer.css",
        "theme.js",
        "words.js",
        "ranking.js",
        "interactions.js",
        "explorer.js",
    )
)
_RINGS = ("rings", "flexibility", "peaks", "direct", "diameters", "coincidences", "causes", "growth", "overtaken", "cost")
_SEARCH = ("compared", "best", "confirmed", "ranks", "depends")
_OTHER_SEARCHES = (("surrogate", 0), *(("quasi_random", seed) for seed in range(3)))
_PROPOSING = ("gaussian_processes", "proposal", "quantity", "dataset", "pareto", "surrogate")
_LENGTHS = "src/r37core/results/exceedance.py"
_OF_SEARCH = "--configfile config/config.yaml"
_SEARCHED = f"{{snakemake}} search {_OF_SEARCH}"
_ROTORS = ("lengths", "worst", "growth", "longer", "ranking", "steps")
_RANKING = ("", "_statistic", "_direct", "_lined", "_missed", "_cost", "_chances_direct", "_chances_lined")
_MODELS = " ".join(
    f"{{folder}}/{blade}/{file}_pressure_edge.npz"
    for blade in ("Ref", "L50", "L100", "S50", "S100", "CS50", "CS100")
    for file in ("contact", "stress")
)

CLAIMS = (
    # made anew and compared by tests
    Claim(
        "rules",
        tables("architecture", "", ("rules",)),
        ("{python} -m claims.rule_graph",),
        checked_by="tests/test_docs.py",
    ),
    Claim(
        "configuration",
        tuple(Output(f"docs/configuration.md#{name}", None) for name in ("config", "blades", "scenes", "fidelity")),
        ("{python} -m r37core.product.reference",),
        checked_by="tests/test_configuration_page.py",
    ),
    Claim(
        "words",
        tuple(Output(f"docs/results.md#{name}", None) for name in ("columns", "ranking_columns")),
        ("{python} -m r37core.results.glossary",),
        checked_by="tests/test_explorer_tables.py",
    ),
    Claim(
        "refusal",
        (Output("docs/your_blade.md#refusal", None),),
        by_hand="copy the message that tests/test_your_blade.py gets",
        checked_by="tests/test_your_blade.py",
    ),
    Claim(
        "integration_speed",
        (Output("docs/speed.md#integration_speed", f"{STUDIES}/integration_speed.md"),),
        ("{snakemake} results/Ref/contact_pressure_edge.npz", "{python} validation/benchmarks/integration_speed.py"),
        minutes=4,
        checked_by="tests/test_docs.py",
    ),
    # the default sweep
    Claim(
        "sweep",
        (picture("response_Ref", f"{_SWEEP}/response_Ref.png", "figures/response_curves"),),
        (_MAKE,),
        minutes=10,
        configuration=(*_BENCHMARK, *_SPEEDS),
        numbers=(*_ALL, "stress"),
    ),
    Claim(
        "blades",
        (picture("blades", f"{_SWEEP}/blades.png", "figures/blade_shapes", "figures/offscreen"),),
        ("{snakemake} results/figures/blades.png",),
        minutes=1,
        configuration=_BLADES,
        numbers=("structure",),
    ),
    Claim(
        "gallery",
        (
            Output("docs/gallery.md", None, _CHECKS),
            *(Output(f"docs/gallery/{name}.png", None, _GALLERY_DRAWING) for name in _GALLERY),
        ),
        ("{snakemake} gallery",),
        minutes=15,
        code=_study("gallery"),
        configuration=(*_BENCHMARK, *_SPEEDS),
        numbers=(*_ALL, "stress"),
    ),
    Claim(
        "explorer",
        (Output("docs/explorer.png", None),),
        (_MAKE, "{python} validation/benchmarks/explorer_picture.py"),
        minutes=10,
        code=("validation/benchmarks/explorer_picture.py",),
        configuration=(*_BENCHMARK, *_SPEEDS, *_EXPLORER),
        numbers=(*_ALL, "stress"),
    ),
    Claim(
        "tutorial",
        (Output("docs/tutorial.ipynb", None),),
        ("make tutorial",),
        minutes=1,
        code=("docs/tutorial.py", "validation/benchmarks/tutorial.py"),
        numbers=_ALL,
    ),
    Claim(
        "user_code",
        tuple(
            Output(f"docs/user_code/{name}.png", None, (f"examples/figures/{name}.py", *drawn_by))
            for name, drawn_by in _USER_CODE.items()
        ),
        ("{python} validation/benchmarks/user_code.py",),
        minutes=4,
        code=("validation/benchmarks/user_code.py",),
        numbers=_ALL,
    ),
    # studies
    Claim(
        "tradeoff",
        (
            *tables("accuracy", "", ("growth",)),
            *tables("accuracy_tables", "", ("levels", "tradeoff")),
            picture("growth", f"{STUDIES}/figures/growth.png"),
            picture("tradeoff_pareto", f"{STUDIES}/figures/tradeoff_pareto.png"),
        ),
        ("{snakemake} tradeoff",),
        minutes=20,
        code=_study("tradeoff"),
        configuration=(
            *_BENCHMARK,
            *_levels("draft", "paper", "fine", "reference"),
            "config/config.yaml:studies.tradeoff",
        ),
        numbers=(*_ALL, "central_difference", "stress"),
    ),
    Claim(
        "stability",
        (
            Output("docs/stability_tables.md#stability", f"{STUDIES}/stability.md"),
            Output("docs/stability.md#stability", f"{STUDIES}/stability.md", text=summary),
        ),
        ("{snakemake} stability",),
        minutes=10,
        code=_study("stability"),
        configuration=_BENCHMARK,
        numbers=_ALL,
    ),
    Claim(
        "validation",
        (
            Output("docs/validation_tables.md#validation", f"{STUDIES}/validation.md"),
            Output("docs/validation.md#validation", f"{STUDIES}/validation.md", text=summary),
            Output("README.md#differences", f"{STUDIES}/validation.md", text=differences),
            *tables("validation", "", ("modelling_choices",)),
            picture("modelling_choices", f"{STUDIES}/figures/modelling_choices.png"),
            *(
                picture(f"validation_{name}", f"{STUDIES}/figures/validation_{name}.png", *drawn_by)
                for name in _VALIDATION_PICTURES
                for drawn_by in [("figures/maps", "figures/cells") if "spectrum" in name else ()]
            ),
        ),
        ("{snakemake} modelling_choices",),
        minutes=180,
        code=(*_study("modelling_choices", "figures"), *_CHECKS),
        configuration=(*_BENCHMARK, *_levels("paper")),
        numbers=(*_ALL, "central_difference", "stress"),
    ),
    Claim(
        "ranges",
        (
            Output("docs/validation_tables.md#ranges", f"{STUDIES}/validation_ranges.md"),
            Output("docs/validation.md#ranges", f"{STUDIES}/validation_ranges.md", text=summary),
        ),
        ("{snakemake} validation_ranges",),
        minutes=90,
        code=(*_study("validation_ranges"), *_CHECKS),
        configuration=(*_BENCHMARK, "config/config.yaml:studies.validation_ranges"),
        numbers=(*_ALL, "stress"),
    ),
    Claim(
        "refinement",
        tables("accuracy_tables", "", ("refinement",)),
        (
            "{snakemake} refinement --configfile config/config.yaml config/tolerances.yaml --config "
            "scenes='[abradable, direct]' structure='{boundary: {contact: points}}' "
            "tolerances='{members: 4, scenes: [abradable]}' speeds_for='[]' "
            "speeds='[{start: 750, stop: 2000, step: 20, refine_to: 1}]'",
        ),
        minutes=240,
        code=_study("refinement"),
        configuration=(*_BENCHMARK, "config/tolerances.yaml:tolerances"),
        numbers=(*_ALL, "stress"),
    ),
    Claim(
        "estimate",
        tables("speed", "", ("estimate",)),
        ("{snakemake} estimate --config fidelity=paper studies='{estimate: {every: 200}}'",),
        minutes=10,
        code=_study("estimate"),
        configuration=(*_BENCHMARK, *_levels("paper"), "config/config.yaml:studies.estimate"),
    ),
    # accuracy
    Claim(
        "contact_accuracy",
        (
            Output("docs/accuracy.md#contact", f"{STUDIES}/contact_accuracy_summary.md"),
            Output("docs/accuracy_tables.md#contact", f"{STUDIES}/contact_accuracy.md"),
            Output("docs/accuracy_tables.md#meshes", f"{STUDIES}/contact_meshes.md"),
            Output("docs/accuracy_tables.md#extremes", f"{STUDIES}/contact_extremes.md"),
        ),
        (_MAKE, "{python} validation/benchmarks/contact_accuracy.py"),
        minutes=40,
        code=("validation/benchmarks/contact_accuracy.py",),
        configuration=_BENCHMARK,
        numbers=(*_ALL, "central_difference", "stress"),
    ),
    Claim(
        "contact_patches",
        (
            *(Output(f"docs/accuracy.md#patches_{name}", f"{STUDIES}/contact_patches_{name}.md") for name in _PATCHES),
            Output("docs/accuracy_tables.md#branches", f"{STUDIES}/contact_patches_branches.md"),
            picture("contact_patches", f"{STUDIES}/figures/contact_patches.png"),
        ),
        (
            f"rm -rf {STUDIES}/contact_patches",
            "{python} validation/benchmarks/contact_patches.py",
            *_GALLERY_OF_PATCHES,
            "{python} validation/benchmarks/contact_patches_tables.py",
        ),
        minutes=235,
        code=("validation/benchmarks/contact_patches_tables.py",),
        configuration=(*_BENCHMARK, "config/patches.yaml"),
        numbers=(*_ALL, "patches", "central_difference"),
    ),
    # models
    Claim(
        "coriolis",
        (
            *tables("coriolis", "coriolis_", ("frequencies", "peaks", "direct", "cost")),
            picture("coriolis_peaks", f"{STUDIES}/figures/coriolis_peaks.png"),
        ),
        ("{snakemake} campbell --config structure='{coriolis: true}'", "{python} validation/benchmarks/coriolis.py"),
        minutes=15,
        code=("validation/benchmarks/coriolis.py",),
        configuration=_BENCHMARK,
        numbers=(*_ALL, "coriolis"),
    ),
    Claim(
        "elastic_casing",
        (
            *tables("elastic_casing", "elastic_casing_", _RINGS),
            picture("elastic_casing_peaks", f"{STUDIES}/figures/elastic_casing_peaks.png"),
        ),
        (
            "{snakemake} campbell",
            "{python} validation/benchmarks/elastic_casing.py",
            "{python} validation/benchmarks/elastic_casing_waves.py",
        ),
        minutes=30,
        code=("validation/benchmarks/elastic_casing.py", "validation/benchmarks/elastic_casing_waves.py"),
        configuration=(*_BENCHMARK, "config/scenes.yaml:elastic_abradable", "config/scenes.yaml:elastic_direct"),
        numbers=(*_ALL, "ring"),
    ),
    Claim(
        "elastic_casing_run",
        (
            picture("casing_Ref", f"{_ELASTIC}/casing_Ref__elastic_abradable.png", "figures/casing_map", "figures/cells"),
            picture("campbell_elastic_casing", f"{_ELASTIC}/campbell_Ref.png", "figures/campbell_diagram"),
        ),
        (f"{_MAKE} --configfile config/config.yaml config/elastic_casing.yaml --config blades='[Ref]'",),
        minutes=5,
        configuration=(*_BENCHMARK, "config/elastic_casing.yaml", "config/scenes.yaml:elastic_abradable"),
        numbers=(*_ALL, "ring"),
    ),
    Claim(
        "clearance",
        (
            *tables("clearance", "", ("clearance_growth", "clearance_effect")),
            picture("clearance_growing_abradable", f"{_SWEEP}/clearance_growing_abradable.png", "figures/clearance_curves"),
        ),
        (
            f"{_MAKE} --configfile config/config.yaml config/clearance.yaml",
            "{python} validation/benchmarks/clearance.py",
        ),
        minutes=25,
        code=("validation/benchmarks/clearance.py",),
        configuration=(*_BENCHMARK, "config/clearance.yaml", "config/scenes.yaml:growing_abradable"),
        numbers=(*_ALL, "clearance", "stress"),
    ),
    Claim(
        "rotor",
        (
            *(Output(f"docs/rotor.md#rotor_{name}", f"{STUDIES}/rotor_{name}.md") for name in _ROTORS),
            picture("rotor", f"{STUDIES}/rotor/rotor.png", "rotors/figures"),
        ),
        (_MAKE, "{python} validation/benchmarks/rotor.py"),
        minutes=60,
        code=("validation/benchmarks/rotor.py",),
        configuration=_BENCHMARK,
        numbers=("structure", "lined", "stress"),
    ),
    Claim(
        "search_libraries",
        (Output("docs/better_blade.md#search_libraries", "validation/benchmarks/search_libraries.md"),),
        by_hand="pip install egobox smt optuna openturns pymoo; python validation/benchmarks/search_libraries.py",
        minutes=10,
        code=("validation/benchmarks/search_libraries.py",),
    ),
    Claim(
        "search",
        (
            *(Output(f"docs/better_blade.md#search_{name}", f"{STUDIES}/search_{name}.md") for name in _SEARCH),
            picture("search_designs", "results/runs/search/figures/search_designs.png", "search/figures"),
            picture("search_slices", "results/runs/search/figures/search_slices.png", "search/figures"),
        ),
        (
            f"{_SEARCHED} config/search.yaml",
            *(
                f"{_SEARCHED} config/search.yaml --config run='{{name: search_{method}_{seed}}}' "
                f"search='{{method: {method}, seed: {seed}}}'"
                for method, seed in _OTHER_SEARCHES
            ),
            "{python} validation/benchmarks/search.py designs",
            f"{{snakemake}} results/runs/search_ranks/ranking.csv {_OF_SEARCH} config/search.yaml --config "
            "fidelity=standard blades=all "
            "run='{name: search_ranks}' blades_file=results/studies/search/designs.yaml",
            f"{_MAKE} {_OF_SEARCH} config/search_best.yaml",
            "{python} validation/benchmarks/search.py",
        ),
        minutes=150,
        code=("validation/benchmarks/search.py", _LENGTHS, *(f"src/r37core/search/{name}.py" for name in _PROPOSING)),
        configuration=(
            *("config/search.yaml", "config/search_blades.yaml", "config/search_best.yaml"),
            *("config/profiles/rotor37.csv", _STRUCTURE, _LINED, _DIRECT, "config/scenes.yaml:rotor_abradable"),
            *_levels("draft", "standard"),
        ),
        numbers=(*_ALL, "stress"),
    ),
    Claim(
        "run_ups",
        (
            *tables("run_ups", "", ("run_up_rates", "run_up_variants")),
            Output("docs/accuracy.md#run_ups", f"{STUDIES}/run_up_accuracy.md"),
            picture("run_up_rates", f"{_SWEEP}/run_up_rates_abradable.png", "run_ups/figures"),
            picture("run_ups_Ref", f"{_SWEEP}/run_ups_Ref__abradable.png", "run_ups/figures"),
        ),
        (
            _MAKE,
            "{snakemake} run_ups --configfile config/config.yaml config/run_ups.yaml",
            "{python} validation/benchmarks/run_ups.py",
        ),
        minutes=40,
        code=("validation/benchmarks/run_ups.py",),
        configuration=(*_BENCHMARK, "config/run_ups.yaml"),
        numbers=(*_ALL, "run_up", "stress"),
    ),
    Claim(
        "run_up_cost",
        tables("run_ups", "", ("run_up_cost",)),
        ("{snakemake} campbell", "{python} validation/benchmarks/run_up_cost.py"),
        minutes=3,
        code=("validation/benchmarks/run_up_cost.py",),
        configuration=_BENCHMARK,
        numbers=(*_ALL, "run_up"),
    ),
    Claim(
        "tolerances",
        (
            *tables("tolerances", "", ("tolerance_ranges",)),
            picture("tolerances_Ref", "results/runs/members/figures/tolerances_Ref__abradable.png", "tolerances/figures"),
        ),
        (
            _MAKE,
            f"{_TOLERANCES} tolerances='{{members: 16}}'",
            f"{_TOLERANCES} run='{{name: members}}' blades='[Ref]'",
            "{python} validation/benchmarks/tolerances.py",
        ),
        minutes=120,
        code=("validation/benchmarks/tolerances.py",),
        configuration=(*_BENCHMARK, "config/tolerances.yaml"),
        numbers=(*_ALL, "patches", "stress"),
    ),
    Claim(
        "tolerance_rankings",
        tables("tolerances", "", ("tolerance_sensitivity", "tolerance_rankings", "tolerance_members")),
        (f"rm -rf {STUDIES}/tolerance_rankings", "{python} validation/benchmarks/tolerance_rankings.py"),
        minutes=20,
        code=("validation/benchmarks/tolerance_rankings.py",),
        configuration=(*_BENCHMARK, *_levels("draft"), "config/tolerances.yaml"),
        numbers=("structure", "lined", "patches", "stress"),
    ),
    Claim(
        "ranking",
        (
            *(Output(f"docs/which_blade.md#ranking{name}", f"{STUDIES}/ranking{name}.md") for name in _RANKING),
            picture("which_blade", f"{_SWEEP}/ranking.png", "figures/ranking_bars"),
        ),
        (
            _MAKE,
            "{snakemake} "
            + _MODELS.replace("{folder}", "results/runs/patches")
            + " --configfile config/config.yaml config/patches.yaml",
            f"rm -rf {STUDIES}/ranking && {{python}} validation/benchmarks/ranking.py 2",
        ),
        minutes=50,
        code=("validation/benchmarks/ranking.py", _LENGTHS),
        configuration=(*_BENCHMARK, *_SPEEDS, "config/patches.yaml", "config/ranking.yaml"),
        numbers=(*_ALL, "patches", "stress"),
    ),
    # other programs and meshes
    Claim(
        "other_programs",
        tuple(
            Output(f"docs/validation.md#other_{name}", f"{STUDIES}/other_programs_{name}.md")
            for name in ("elastic", "worn", "direct")
        ),
        (
            "{snakemake} results/Ref/contact_pressure_edge.npz",
            "{python} validation/benchmarks/other_programs.py elastic worn direct",
        ),
        minutes=5,
        code=("validation/benchmarks/other_programs.py",),
        configuration=_BENCHMARK,
        numbers=(*_ALL, "central_difference"),
    ),
    Claim(
        "nlstep",
        tuple(
            Output(f"docs/validation.md#other_{name}", f"{STUDIES}/other_programs_{name}.md") for name in ("histories", "rms")
        ),
        by_hand="with GNU Octave, and NLstep in the folder $NLSTEP: python validation/benchmarks/other_programs.py histories rms",
        minutes=10,
        code=("validation/benchmarks/other_programs.py",),
        configuration=_BENCHMARK,
        numbers=("structure", "direct"),
    ),
    Claim(
        "element_libraries",
        tables("structure", "", ("element_libraries",)),
        by_hand="pip install scikit-fem felupe; python validation/benchmarks/element_libraries.py",
        minutes=5,
        code=("validation/benchmarks/element_libraries.py",),
    ),
    Claim(
        "remeshed",
        tables("your_blade", "", ("remeshed",)),
        (f"rm -f {STUDIES}/remeshed.json", "{python} validation/benchmarks/remeshed_blades.py"),
        minutes=15,
        code=("validation/benchmarks/remeshed_blades.py",),
        configuration=(*_BLADES, _LINED, *_levels("standard")),
        numbers=("structure", "lined"),
    ),
    # cost
    Claim(
        "integration_cost",
        tables("speed", "", ("integration_cost",)),
        by_hand="make all_blades; python validation/benchmarks/integration_cost.py FOLDER, a checkout of the version to compare with",
        minutes=12,
        code=("validation/benchmarks/integration_cost.py",),
        configuration=_BENCHMARK,
    ),
    Claim(
        "resources",
        tables("cluster", "", ("resources",)),
        ("{python} validation/benchmarks/resources.py",),
        minutes=10,
        code=("validation/benchmarks/resources.py",),
    ),
    Claim(
        "scaling",
        tables("cluster", "", ("scaling",)),
        ("{python} validation/benchmarks/scaling.py",),
        minutes=10,
        code=("validation/benchmarks/scaling.py",),
    ),
    # examples of what is not in the default sweep
    Claim(
        "designs",
        (
            *tables("blades", "", ("designs", "designs_correlations")),
            picture("designs_Sweep", f"{STUDIES}/designs_Sweep.png", "designs/figures"),
        ),
        ("{python} validation/benchmarks/designs.py",),
        minutes=10,
        code=("validation/benchmarks/designs.py", _LENGTHS),
        configuration=(*_BLADES, _LINED, _DIRECT, *_levels("draft")),
        numbers=(*_ALL, "patches", "stress"),
    ),
    Claim(
        "shapes",
        (picture("shapes", f"{_SWEEP}/shapes_Ref__abradable.png", "figures/offscreen"),),
        by_hand="`shapes` among the results of the scene `abradable`; snakemake all_blades --config blades='[Ref]'",
        configuration=(*_BENCHMARK, *_SPEEDS),
        numbers=("structure", "lined", "stress"),
    ),
    Claim(
        "signals",
        (picture("signals", f"{_SWEEP}/orders_Ref__abradable.png", "signals/figures", "figures/cells"),),
        by_hand="`signals` as shown in config/config.yaml; snakemake all_blades --config blades='[Ref]'",
        configuration=(*_BENCHMARK, *_SPEEDS),
        numbers=("structure", "lined"),
    ),
    Claim(
        "imported",
        (
            picture("your_blade_campbell", f"{_SWEEP}/campbell_Fan.png", "figures/campbell_diagram"),
            picture("your_blade_response", f"{_SWEEP}/response_Fan.png", "figures/response_curves"),
        ),
        by_hand="the worked example of docs/your_blade.md",
        configuration=(_LINED, *_levels("standard"), *_SPEEDS),
        numbers=("structure", "lined", "stress"),
    ),
)

DRAWN = {"docs/casing_axes.svg"}
"""Pictures that show no result."""

OUTPUTS = {output.place: (claim, output) for claim in CLAIMS for output in claim.outputs}
"""Place -> claim and output."""
