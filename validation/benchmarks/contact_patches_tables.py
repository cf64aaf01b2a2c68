"""Tables and figure of docs/accuracy.md on points and patches, from the sweeps of contact_patches.py.

Run: make claims ONLY=contact_patches. The published statements on patches come from the gallery of config/patches.yaml, which
`snakemake gallery` writes over docs/gallery.md, and which is moved to results/studies/contact_patches.
Errors are relative differences of rms, of the leading edge's whole motion, at settled speeds: those at which friction 0.1%
larger or smaller and half the step change little, and that are not beside the end of a branch.
"""

import re
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from contact_patches import (
    ABOUT_PEAK,
    BLADES,
    FINEST_MESH,
    FOLDER,
    GRIDS,
    KINDS,
    LAYERED,
    MASS,
    ROOT,
    STANDARD,
    STEPS,
    STIFFER,
    Model,
    Way,
    perturbed,
    settings,
    sweep,
)

from r37core.contact.casing import casing_axes
from r37core.figures import style
from r37core.io import write_text
from r37core.rom.contact_model import read_contact_model
from r37core.rom.reduction_choice import AREA_PATCHES, PATCHES, POINTS
from r37core.time_integration.static_modes import residual_flexibility
from validation.published import INTERACTIONS
from validation.studies.tables import markdown_table

STUDIES = ROOT / "results/studies"

SETTLED, STEEP = 0.03, 0.25
"""Largest change of rms by a perturbation; change to a neighbouring speed from which on a place counts as steep."""


def rms(model, way):
    """rms of the whole motion (mm) over the speeds of the way."""
    return 1e3 * np.hypot(*sweep(model, way).T)


def settled(model, way):
    """Speeds of the grid at which no perturbation changes much, and that are not beside the end of a branch."""
    standard = Model(model.blade, contact=model.contact if model.contact in KINDS[:2] else PATCHES)
    of = Way(way.scene, stiffer=way.stiffer, grid="coarse" if way.stiffer > 1 else "all")
    base = rms(standard, of)
    quiet = np.all([np.abs(rms(standard, other) / base - 1.0) < SETTLED for other in perturbed(of)], axis=0)
    if way.stiffer > 1:
        return on_grid(quiet, of, model.blade, False)
    steps = np.abs(np.diff(base)) / np.minimum(base[1:], base[:-1]) > STEEP
    return quiet & ~np.concatenate([[False], steps]) & ~np.concatenate([steps, [False]])


def on_grid(values, way, blade, missing=np.nan):
    """Values at the speeds of a way, on the whole grid."""
    whole = np.full(len(GRIDS["all"]), missing)
    whole[np.searchsorted(GRIDS["all"], way.speeds(blade))] = values
    return whole


def errors(first, second):
    """Relative differences of two (model, way) of a blade and scene at its settled speeds, in percent."""
    values = [on_grid(rms(model, way), way, model.blade) for model, way in (first, second)]
    error = 100.0 * np.abs(values[0] / values[1] - 1.0)[settled(*first)]
    return error[np.isfinite(error)]


def cell(pairs):
    """Mean, median and 90% quantile over all blades, and the worst mean with its blade."""
    by_blade = {model.blade: errors((model, way), (other, of)) for (model, way), (other, of) in pairs}
    every = np.concatenate(list(by_blade.values()))
    worst = max(by_blade, key=lambda blade: by_blade[blade].mean())
    return f"{every.mean():.1f}, {np.median(every):.2f}, {np.quantile(every, 0.9):.1f} ({worst} {by_blade[worst].mean():.1f})"


def convergence_table(scene):
    """What is varied, and how far each kind of contact is from its finest, in percent."""

    def row(what, of, *makers):
        return [what, of, *("" if make is None else cell([make(blade) for blade in BLADES]) for make in makers)]

    way, rows = Way(scene), []

    def meshes(nodes, contact):
        return lambda blade: ((Model(blade, nodes, contact), way), (Model(blade, FINEST_MESH, contact), way))

    for nodes in (5000, 10000, 20000, 40000):
        kinds = (POINTS, PATCHES, AREA_PATCHES if nodes in (5000, STANDARD) else None)
        rows.append(row(f"mesh of {nodes:,} nodes", f"{FINEST_MESH:,}", *(kind and meshes(nodes, kind) for kind in kinds)))

    def counts(count, contact):
        return lambda blade: ((Model(blade, contact=contact, count=count), way), (Model(blade, contact=contact, count=29), way))

    if scene == "direct":
        for count in (4, 8, 15):
            rows.append(row(f"{count} of them along the tip", "29", counts(count, POINTS), counts(count, PATCHES), None))
    for modes in (3, 10, 20):

        def of_modes(blade, modes=modes):
            return (Model(blade, contact=PATCHES, modes=modes), way), (Model(blade, contact=PATCHES, modes=40), way)

        rows.append(row(f"{modes} fixed-interface modes", "40", None, of_modes, None))
    if scene == "direct":
        finest = Way(step=STEPS[-1], grid="coarse")
        for name, other in [
            *((f"step {step:g} s", Way(step=step, grid="coarse")) for step in STEPS[:-1]),
            ("nodes with mass", MASS),
        ]:

            def of_step(blade, other=other):
                model = Model(blade, contact=PATCHES)
                return (model, other), (model, finest)

            rows.append(row(name, f"{STEPS[-1]:g} s", None, of_step, None))

    def changed(contact, other):
        return lambda blade: ((Model(blade, contact=contact), other), (Model(blade, contact=contact), way))

    for name, other in zip(("friction + 0.1%", "friction - 0.1%", "half the step"), perturbed(way), strict=True):
        rows.append(row(name, "as shipped", changed(POINTS, other), changed(PATCHES, other), None))
    return markdown_table(["what", "against", "points", "patches", "area patches"], rows)


def worst_table():
    """Direct contact at 20,000 nodes against the finest mesh, at the worst speeds of each blade, settled and not."""
    rows, way, speeds = [], Way(), GRIDS["all"]
    for blade in BLADES:
        cells = []
        for contact in KINDS[:2]:
            model, mask = Model(blade, contact=contact), settled(Model(blade, contact=contact), way)
            error = 100.0 * np.abs(rms(model, way) / rms(Model(blade, FINEST_MESH, contact), way) - 1.0)
            top = int(np.argmax(np.where(mask, error, 0.0)))
            cells += [
                f"{mask.sum()}: {error[mask].mean():.1f}, {error[top]:.0f} at {speeds[top]:g}",
                f"{(~mask).sum()}: {np.median(error[~mask]):.1f}, {error[~mask].max():.0f}",
            ]
        rows.append([blade, *cells])
    head = [f"{contact}, {what}" for contact in KINDS[:2] for what in ("settled: mean, largest", "others: median, largest")]
    return markdown_table(["blade", *head], rows)


def levels_table():
    """How far each level is from the finest mesh, by blade: mean and 90% quantile at settled speeds, in percent."""
    levels = {
        "draft": (5000, Way(step=6.4e-6, grid="coarse"), Way("abradable")),
        "standard": (20000, Way(), Way("abradable")),
        "fine": (40000, Way(step=2.4e-6, grid="coarse"), Way("abradable", 3.2e-6, grid="coarse")),
    }
    rows = []
    for name, (nodes, *ways) in levels.items():
        for contact in KINDS[:2]:
            for way in ways:
                of = {
                    blade: errors((Model(blade, nodes, contact), way), (Model(blade, FINEST_MESH, contact), Way(way.scene)))
                    for blade in BLADES
                }
                worst = max(of, key=lambda blade: of[blade].mean())
                cells = [f"{of[blade].mean():.1f}, {np.quantile(of[blade], 0.9):.1f}" for blade in BLADES]
                rows.append([f"`{name}`", contact, f"`{way.scene}`", *cells, f"{worst} {of[worst].mean():.1f}"])
    return markdown_table(["level", "contact", "scene", *BLADES, "worst mean"], rows)


def drop(speeds, values):
    """Speed (rad/s) before the steepest loss of rms, as a share of the largest rms."""
    return float(speeds[np.nanargmin(np.diff(values))])


def branches_table():
    """Largest rms (mm) with its speed and the speed before the steepest drop, over the whole range; by mesh and contact."""
    rows = []
    for blade in BLADES:
        for contact in KINDS:
            cells = []
            for nodes in (5000, STANDARD, FINEST_MESH):
                values = rms(Model(blade, nodes, contact), Way())
                top = int(np.nanargmax(values))
                cells.append(f"{values[top]:.2f} at {GRIDS['all'][top]:g}; {drop(GRIDS['all'], values):g}")
            rows.append([blade, contact, *cells])
    return markdown_table(["blade", "contact", *(f"{nodes:,} nodes" for nodes in (5000, STANDARD, FINEST_MESH))], rows)


def stiffness_table():
    """From which stiffness of the lining on a finer mesh changes the lined response with points: mean and 90% quantile, %."""
    rows = []
    for stiffer in (1, *STIFFER):
        way = Way("abradable", grid="coarse", stiffer=stiffer) if stiffer > 1 else Way("abradable")
        cells = [
            cell([((Model(blade, STANDARD, contact), way), (Model(blade, FINEST_MESH, contact), way)) for blade in BLADES])
            for contact in KINDS[:2]
        ]
        rows.append([f"{stiffer}", f"{bar_stiffness(stiffer):.2g}", *cells])
    return markdown_table(["times as stiff", "bar (um/N)", "points", "patches"], rows)


def bar_stiffness(stiffer):
    """Flexibility of an elastic bar (um/N) of the lining made stiffer, on the reference blade."""
    lining = settings().scenes["abradable"].scene.lining
    area = lining.area(float(read_contact_model(Model("Ref").file).radius.max()))
    return 1e6 * lining.thickness / (stiffer * lining.elastic_modulus * area)


def peaks_table():
    """Speed (rad/s) of the largest rms about the ten published peaks, with bars of 1 mm and as wide as the patches."""
    columns = {
        "8 points, 1 mm": (Model("", contact=POINTS), Way("abradable", grid="peaks")),
        "8 patches, 1 mm": (Model("", contact=PATCHES), Way("abradable", grid="peaks")),
    }
    for count in (4, 8, 15):
        columns[f"{count} patches, bars as wide"] = (
            Model("", contact=PATCHES, count=count),
            Way("abradable", grid="peaks", wide=True),
        )
    rows, off = [], {name: [] for name in columns}
    for one in INTERACTIONS:
        cells = []
        for name, (model, way) in columns.items():
            values, speeds = rms(replace(model, blade=one.blade), way), way.speeds(one.blade)
            near = (speeds >= ABOUT_PEAK[0] * one.peak - 1.0) & (speeds <= ABOUT_PEAK[1] * one.peak)
            top = int(np.argmax(np.where(near, values, 0.0)))
            off[name].append(speeds[top] / one.peak - 1.0)
            cells.append(f"{speeds[top]:g} ({values[top]:.2f})")
        rows.append([f"{one.blade} 1B/{one.engine_order}", f"{one.peak:g}", *cells])
    rows.append(
        [
            "mean off",
            "",
            *(f"{100 * np.mean(values):+.1f}%, largest {100 * np.max(np.abs(values)):.1f}%" for values in off.values()),
        ]
    )
    return markdown_table(["peak", "published", *columns], rows)


def published_table():
    """Direct contact of Ref at every rad/s, as the paper speaks of it: largest normal rms, the drop after it, what is left."""
    cases = {
        "8 points": Model("Ref"),
        "8 points, 80,000 nodes": Model("Ref", FINEST_MESH),
        "8 patches": Model("Ref", contact=PATCHES),
        "8 patches, 80,000 nodes": Model("Ref", FINEST_MESH, PATCHES),
        "15 patches": Model("Ref", contact=PATCHES, count=15),
    }
    rows = []
    for name, model in cases.items():
        speeds, values = GRIDS["fine"], 1e3 * sweep(model, Way(grid="fine"))[:, 0]
        near = (speeds > 1200.0) & (speeds < 1450.0)
        top = int(np.argmax(np.where(near, values, 0.0)))
        steepest = int(np.argmin(np.where(near[:-1], np.diff(values), 0.0)))
        after, low = values[steepest + 1 : steepest + 25], speeds < 1000.0
        rows.append(
            [
                name,
                f"{values[top]:.3f} at {speeds[top]:g}",
                f"{speeds[steepest]:g}: {values[steepest]:.3f} to {after.min():.3f}",
                f"{np.median(values[speeds > speeds[steepest] + 5.0]):.3f}",
                f"{np.median(values[low]):.3f}",
                f"{np.median(values):.3f}",
            ]
        )
    head = ["contact", "largest (mm)", "drop (rad/s; mm)", "median above (mm)", "median below 1000 rad/s", "median of all"]
    return markdown_table(head, rows)


def flexibility(model):
    """Normal displacement (um/N) of the leading and of a middle contact node per force on it, by modes beyond the first 32."""
    contact = read_contact_model(model.file)
    normal = casing_axes(contact.displacement_operator, contact.tip_cone_angle)[:, :, 32:]
    static = residual_flexibility(np.sqrt(contact.squared_frequencies[32:]), normal)[0]
    return 1e6 * np.diag(static)[[0, 3]]


def layers_table():
    """Patches of the line and of the area on meshes with more layers of elements: flexibility (um/N), and rms."""
    rows, way = [], Way()
    for blade in ("L100", "S100"):
        for nodes, layers in ((5000, 1), (STANDARD, 1), (FINEST_MESH, 1), *LAYERED):
            cells = []
            for contact in KINDS[1:]:
                model = Model(blade, nodes, contact, layers=layers)
                finest = Model(blade, FINEST_MESH, contact)
                error = "" if model == finest else f"{np.median(errors((model, way), (finest, way))):.2f}%"
                cells += ["{:.4f}, {:.4f}".format(*flexibility(model)), error]
            rows.append([blade, f"{nodes:,}", f"{layers}", *cells])
    head = [f"{contact}: {what}" for contact in ("patches", "area patches") for what in ("flexibility", "rms, median off")]
    return markdown_table(["blade", "nodes", "layers", *head], rows)


def disagreements(page):
    """Published statements that do not agree in a page of the gallery, by their words without numbers."""
    parts = re.findall(r"\*\*Does not agree\*\*.*?:\n\n((?:- .*\n)+)", page)
    lines = [line[2:] for part in parts for line in part.splitlines()]
    # what comes before the first number of its own, or the verdict in brackets
    return {re.split(r" (?=[\d.]+(?:%| rad/s| mm| GPa| revolutions| \(pub))| \((?!pub)", line)[0]: line for line in lines}


def statements_table():
    """Published numbers and statements that agree with contact on points or on patches, but not on both."""
    points, patches = (disagreements(page.read_text()) for page in (ROOT / "docs/gallery.md", FOLDER / "gallery.md"))
    rows = [
        [words, *(page.get(words, "agrees").removeprefix(words).strip() for page in (points, patches))]
        for words in dict.fromkeys([*points, *patches])
    ]
    return markdown_table(["statement", "on points", "on patches"], [row for row in rows if row[1] != row[2]])


def blades_table():
    """Direct contact of the seven blades at every rad/s, on points and on patches: rms (mm); and what changes with lining."""
    rows = []
    for blade in BLADES:
        points, patches = (rms(Model(blade, contact=contact), Way(grid="fine")) for contact in KINDS[:2])
        cells = []
        for values in (points, patches):
            top = int(np.argmax(values))
            cells += [
                f"{np.median(values):.2f}",
                f"{values[top]:.2f} at {GRIDS['fine'][top]:g}",
                f"{drop(GRIDS['fine'], values):g}",
            ]
        change = 100.0 * np.abs(patches / points - 1.0)
        of_lined = errors((Model(blade, contact=PATCHES), Way("abradable")), (Model(blade), Way("abradable")))
        lined = f"{np.median(of_lined):.1f}%, {of_lined.max():.0f}%"
        rows.append([blade, *cells, f"{np.median(change):.0f}%, {np.quantile(change, 0.9):.0f}%", lined])
    head = [f"{contact}: {what}" for contact in KINDS[:2] for what in ("median", "largest", "steepest drop (rad/s)")]
    head += ["change: median, 90% quantile", "with lining, settled: median, largest"]
    return markdown_table(["blade", *head], rows)


def figure():
    """Direct contact of two blades on three meshes, on points and on patches."""
    drawn, axes = plt.subplots(2, 2, figsize=(style.PAGE, 4.2), sharex=True, sharey="row")
    for row, blade in zip(axes, ("L100", "S100"), strict=True):
        for axis, contact in zip(row, KINDS[:2], strict=True):
            for nodes in (5000, STANDARD, FINEST_MESH):
                axis.plot(GRIDS["all"], rms(Model(blade, nodes, contact), Way()), label=f"{nodes:,} nodes")
            axis.set_title(f"{blade}, contact on {contact}")
        row[0].set_ylabel("rms of the leading edge (mm)")
    for axis in axes[1]:
        axis.set_xlabel("angular speed (rad/s)")
    axes[0, 0].legend()
    drawn.savefig(STUDIES / "figures/contact_patches.png")


def main():
    tables = {
        "convergence": "\n".join(f"`{scene}`\n\n{convergence_table(scene)}" for scene in ("direct", "abradable")),
        "worst": worst_table(),
        "levels": levels_table(),
        "branches": branches_table(),
        "stiffness": stiffness_table(),
        "peaks": peaks_table(),
        "published": published_table(),
        "blades": blades_table(),
        "statements": statements_table(),
        "layers": layers_table(),
    }
    for name, table in tables.items():
        write_text(table, STUDIES / f"contact_patches_{name}.md")
        print(table, flush=True)
    figure()


if __name__ == "__main__":
    main()
