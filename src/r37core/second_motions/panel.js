// second motions: rms of the leading edge carried up, carried down and from rest; shaded where these differ by more than they scatter
panels.second_motions = (pairs, page) => {
  const { state, digits, speedText, axis, layout, draw } = page;
  const named = (name) => (name === "rest" ? "from rest" : `carried ${name}`);

  function curves() {
    const pair = pairs.find(({ blade, scene }) => blade === state.blade && scene === state.scene);
    if (!pair) return draw("second_motions", [], null);
    const { speeds: { values: speeds }, mean, names, ranges } = pair;
    const traces = names.map((name, row) => ({
      x: page.shown(speeds), y: mean.row(row), name: named(name), mode: "lines", hoverinfo: "text",
      line: { color: page.colourOf(row), width: 1.5, dash: name === "rest" ? "dot" : "solid" },
      text: speeds.map((speed, at) => `${named(name)}<br>${speedText(speed)}<br>${digits(mean.row(row)[at], 3)} mm`),
    }));
    const plan = layout(page.speedAxis(), axis("rms, normal and tangential (mm)"));
    plan.shapes = [...(plan.shapes ?? []), ...ranges.map(([low, high]) => ({
      type: "rect", yref: "paper", x0: low * page.factor(), x1: high * page.factor(), y0: 0, y1: 1, line: { width: 0 }, fillcolor: page.muted(), opacity: 0.2, layer: "below",
    }))];
    return draw("second_motions", traces, plan);
  }

  return { second_motions: { title: "Motion carried up, down and from rest", draw: curves, of: ["blade", "scene", "unit"] } };
};
