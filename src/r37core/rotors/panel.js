// whole rotors: every blade over speed, who leads, and growth and waves at the chosen speed; motion is the leading edge's
// displacement, normal and tangential together
panels.rotors = (rotors, page) => {
  const DECADES = 3;
  const { state, digits, speedText, axis, layout, draw } = page;
  const chosen = () => rotors.find(({ blade, scene }) => blade === state.blade && scene === state.scene);
  const median = (values) => [...values].sort((one, other) => one - other)[Math.floor(values.length / 2)];
  const largest = (values) => values.filter(Number.isFinite).reduce((most, value) => Math.max(most, value), 0);
  const placesAxis = (numbers) => axis("blade", { range: [0.5, largest(numbers) + 0.5] });
  const sense = (diameters) => ["against growing theta", "standing", "with growing theta"][Math.sign(diameters) + 1];
  const millimetres = (value) => (Number.isFinite(value) ? `${digits(value, 3)} mm` : "diverged");

  // what is there of the chosen rotor, or nothing
  const drawing = (name, made, clicks) => () => {
    const rotor = chosen();
    draw(name, ...(rotor ? made(rotor) : [[], null]), clicks);
  };
  const nearest = ({ speeds: { values } }) => values.reduce(
    (best, speed, at) => (Math.abs(speed - state.speed) < Math.abs(values[best] - state.speed) ? at : best), 0,
  );
  const leaderText = ({ leader, rms, numbers, above_yield: aboveYield, speeds }, at) => {
    const of = rms.row(at);
    if (!of.some(Number.isFinite)) return `${speedText(speeds.values[at])}<br>blade ${leader.values[at]} diverged first`;
    const count = aboveYield?.values[at];
    const above = Number.isFinite(count) ? `<br>${digits(count)} of ${numbers.length} blades above yield` : "";
    return `${speedText(speeds.values[at])}<br>blade ${leader.values[at]} leads<br>${millimetres(largest(of))}, median ${millimetres(median(of))}${above}`;
  };

  // a place without a blade, and a run that diverged, stay empty
  function map(rotor) {
    const { speeds: { values: speeds }, rms, numbers } = rotor;
    const top = Math.log10(largest(rms.values) || 1);
    const places = Array.from({ length: largest(numbers) }, (_, at) => at + 1);
    const rows = (cell) => places.map((place) => speeds.map((_, at) => cell(at, numbers.indexOf(place), place)));
    const ticks = Array.from({ length: DECADES + 1 }, (_, number) => top - number);
    const trace = {
      type: "heatmap", x: page.shown(speeds), y: places, colorscale: page.MAGMA, zmin: top - DECADES, zmax: top, zsmooth: false, hoverinfo: "text",
      z: rows((at, row) => (row < 0 || !Number.isFinite(rms.row(at)[row]) ? null : Math.log10(Math.max(rms.row(at)[row], 1e-30)))),
      text: rows((at, row, place) => `${speedText(speeds[at])}<br>blade ${place}<br>${row < 0 ? "not there" : millimetres(rms.row(at)[row])}`),
      colorbar: { title: { text: "rms of the motion (mm)", side: "right" }, thickness: 12, tickvals: ticks, ticktext: ticks.map((tick) => digits(10 ** tick, 2)) },
    };
    const plan = layout(page.speedAxis(), placesAxis(numbers), { showlegend: false });
    // on dark colours
    plan.shapes[0].line.color = "#fff";
    return [[trace], plan];
  }

  // in the colour of how far it leads; a cross where it diverged
  function leaders(rotor) {
    const { speeds: { values: speeds }, rms, leader, numbers } = rotor;
    const ahead = speeds.map((_, at) => Math.log10(largest(rms.row(at)) / median(rms.row(at))));
    const colour = ahead.map((value) => (Number.isFinite(value) ? value : null));
    const top = Math.max(1, Math.ceil(largest(ahead)));
    const ticks = Array.from({ length: top + 1 }, (_, number) => number);
    const trace = {
      x: page.shown(speeds), y: leader.values, mode: "markers", cliponaxis: false, hoverinfo: "text", text: speeds.map((_, at) => leaderText(rotor, at)),
      marker: {
        size: 8, symbol: speeds.map((_, at) => (rms.row(at).some(Number.isFinite) ? "circle" : "x")), color: colour, cmin: 0, cmax: top, colorscale: "Viridis", showscale: true,
        colorbar: { title: { text: "its motion over the median", side: "right" }, thickness: 12, tickvals: ticks, ticktext: ticks.map((tick) => `${10 ** tick}`) },
      },
    };
    return [[trace], layout(page.speedAxis(), placesAxis(numbers), { showlegend: false })];
  }

  function growth(rotor) {
    const at = nearest(rotor);
    const traces = [...rotor.largest.row(at).map((number) => `blade ${number}`), "median of all"].map((name, number, all) => {
      const values = rotor.growth.row(at, number);
      const last = number === all.length - 1;
      return {
        x: rotor.spans, y: values, name, mode: "lines", hoverinfo: "text",
        line: last ? { color: page.muted(), width: 1.5, dash: "dot" } : { color: page.colourOf(number), width: 1.5 },
        text: values.map((value, span) => `${name}<br>revolution ${rotor.spans[span]}<br>${millimetres(value)}`),
      };
    });
    const x = axis(`revolution at ${digits(rotor.speeds.values[at] * page.factor())} ${state.unit}`);
    return [traces, layout(x, axis("largest displacement (mm)"), { shapes: [] })];
  }

  function waves(rotor) {
    const at = nearest(rotor);
    const shares = rotor.shares.row(at).map((share) => (Number.isFinite(share) ? share : 0));
    const trace = {
      type: "bar", x: rotor.diameters, y: shares, marker: { color: page.colourOf(0) }, hoverinfo: "text",
      text: shares.map((share, row) => `${Math.abs(rotor.diameters[row])} nodal diameters, ${sense(rotor.diameters[row])}<br>${digits(share, 3)}% of the motion`), textposition: "none",
    };
    const x = axis(`nodal diameters at ${digits(rotor.speeds.values[at] * page.factor())} ${state.unit}`);
    return [[trace], layout(x, axis("share of the motion (%)"), { shapes: [], showlegend: false })];
  }

  const over = ["blade", "scene", "unit"];
  return {
    rotor_map: { title: "Rotor: motion of all blades", draw: drawing("rotor_map", map), of: over },
    rotor_leader: { title: "Rotor: who leads by motion", draw: drawing("rotor_leader", leaders), of: over },
    rotor_growth: { title: "Rotor: growth", draw: drawing("rotor_growth", growth, false), of: [...over, "speed"] },
    rotor_waves: { title: "Rotor: waves", draw: drawing("rotor_waves", waves, false), of: [...over, "speed"] },
  };
};
