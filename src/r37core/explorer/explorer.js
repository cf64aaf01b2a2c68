(async () => {
  const data = JSON.parse(document.getElementById("data").textContent);
  // Okabe and Ito's colours, told apart with any colour vision, and darker ones of them; further blades repeat them with another marker
  const COLOURS = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000",
    "#003F62", "#8A3D00", "#00573F", "#7A3F61", "#2B6E94", "#7F5700", "#888888",
  ];
  const MARKERS = ["circle", "square", "diamond", "triangle-up", "star"];
  const DASHES = ["solid", "dash", "dot", "dashdot"];
  // of the figures; plotly does not have it
  const MAGMA = ["#000004", "#1c1044", "#4f127b", "#812581", "#b5367a", "#e55064", "#fb8761", "#fec287", "#fcfdbf"]
    .map((colour, at, all) => [at / (all.length - 1), colour]);
  const STATUS = ["completed", "diverged", "not run"];
  const DIVERGED = STATUS.indexOf("diverged");
  const RPM = 30 / Math.PI;
  const PLOTS = ["campbell", "response", "spectrum", "wear", "stress"];
  // plotly's own choice has a button that uploads; explorer.css puts the bar beside the heading
  const OPTIONS = {
    displaylogo: false, displayModeBar: true, modeBarButtons: [["toImage", "zoom2d", "pan2d", "resetScale2d"]],
  };
  // a finger that drags over a plot scrolls the page
  const DRAG = window.matchMedia("(pointer: coarse)").matches ? false : "zoom";
  const OUTSIDE = data.outside;
  const SPECTRUM_DECIBELS = 60;
  // width and height that the number of an engine order takes (pixels)
  const NUMBER_SIZE = [16, 12];

  async function unpack(array) {
    const bytes = Uint8Array.from(atob(array.base64), (letter) => letter.charCodeAt(0));
    const whole = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    const buffer = await new Response(whole).arrayBuffer();
    const values = array.bits === 64 ? new Float64Array(buffer) : new Float32Array(buffer);
    const { shape } = array;
    // the axes after the given places of the first ones; asked for at every point of a curve, so each is made once
    const rows = new Map();
    const row = (...place) => {
      let at = 0;
      place.forEach((index, axis) => { at = at * shape[axis] + index; });
      const length = shape.slice(place.length).reduce((product, size) => product * size, 1);
      const key = `${at},${length}`;
      if (!rows.has(key)) rows.set(key, Array.from(values.subarray(at * length, (at + 1) * length)));
      return rows.get(key);
    };
    return { shape, values: Array.from(values), row };
  }

  // a part of the data with all its arrays unpacked
  async function unpackAll(part) {
    if (typeof part !== "object" || part === null) return part;
    if ("base64" in part) return unpack(part);
    const unpacked = await Promise.all(Object.values(part).map(unpackAll));
    return Array.isArray(part) ? unpacked : Object.fromEntries(Object.keys(part).map((name, at) => [name, unpacked[at]]));
  }

  const { values: speeds } = await unpack(data.speeds);
  const [status, exitCause, campbell, curves, yieldStress, history] = await Promise.all(
    [data.status, data.exit_cause, data.campbell, data.curves, data.yield_stress, data.history].map(unpackAll),
  );
  const { frequency, crossing, speeds: { values: campbellSpeeds } } = campbell;
  const maps = await unpackAll({ spectrum: data.spectrum, wear: data.wear });

  // and what they are where the address does not say
  const SWITCHES = { all: false };
  const state = { blade: data.blades[0], scene: data.scenes[0], quantity: curves[0].name, speed: speeds[0], unit: "rad/s", ...SWITCHES };

  const bladeIndex = () => data.blades.indexOf(state.blade);
  const sceneIndex = () => data.scenes.indexOf(state.scene);
  const factor = () => (state.unit === "rpm" ? RPM : 1);
  const shown = (values) => values.map((value) => value * factor());
  const digits = (value, count = 5) => (Number.isFinite(value) ? Number(value.toPrecision(count)).toString() : "none");
  // a number with its unit; of what has none, and where there is no number, without
  const quantityText = (value, unit) => (unit === "1" || !Number.isFinite(value) ? digits(value) : `${digits(value)} ${unit}`);
  const speedText = (speed) => `${digits(speed)} rad/s, ${digits(speed * RPM)} rpm`;
  const ran = (blade, scene) => speeds.map((_, at) => at).filter((at) => status.row(blade, scene)[at] !== 2);
  const axis = (title, more = {}) => ({ ...theme.axis(), title: { text: title }, zeroline: false, ...more });
  const speedAxis = () => axis(`speed (${state.unit})`, { range: shown([speeds[0], speeds[speeds.length - 1]]) });

  // a quantity's long name with its unit; on an axis in lines that are short enough for it
  const labelText = ({ label, unit }) => (unit === "1" ? label : `${label} (${unit})`);
  const broken = (text) => text.replace(/(.{1,36})(?: |$)/g, "$1<br>").slice(0, -"<br>".length);
  // black is not seen in the dark
  const colourOf = (number) => {
    const colour = COLOURS[number % COLOURS.length];
    return colour === "#000000" && theme.dark() ? theme.colour("text") : colour;
  };

  const modeText = (mode) => (/^\d+$/.test(mode) ? `mode ${mode}` : mode);

  // value of a curve by its name, of the run at a place among the speeds
  const valueOf = (name, blade, scene, at) => curves.find((one) => one.name === name)?.values.row(blade, scene)[at];

  // of the run at a speed, whatever is shown of it: when its stress passes yield, and when it leaves the model and by which limit
  function eventsText(blade, scene, at) {
    const [first, count, exit, inside, ever] = ["first_yield_revolution", "revolutions_above_yield", "exit_revolution", "max_von_mises_inside", "max_von_mises_ever"]
      .map((name) => valueOf(name, blade, scene, at));
    const passed = first > 0 ? `<br>above yield first in revolution ${first}, in ${count} of all, ${OUTSIDE}` : "";
    const left = exit > 0 ? `<br>leaves the model in revolution ${exit}, by ${data.causes[exitCause.row(blade, scene)[at]]}` : "";
    return `${passed}${left}${ever > 0 ? `<br>largest stress ${digits(ever)} MPa, ${digits(inside)} MPa inside the model` : ""}`;
  }

  // name of a curve -> what one of its points says
  function pointText(curve, blade, scene, at) {
    const value = curve.values.row(blade, scene)[at];
    const number = status.row(blade, scene)[at];
    const where = `${data.blades[blade]}, ${data.scenes[scene]}<br>${speedText(speeds[at])}<br>`;
    if (number === DIVERGED) return `${where}diverged: beyond all that has a number`;
    return `${where}${quantityText(value, curve.unit)}<br>${STATUS[number]}${eventsText(blade, scene, at)}`;
  }

  // the speeds in operation, shaded
  const operatingRange = () => (data.operating ? [{
    type: "rect", yref: "paper", x0: data.operating[0] * factor(), x1: data.operating[1] * factor(), y0: 0, y1: 1, line: { width: 0 },
    fillcolor: theme.colour("bars-light"), opacity: 0.2, layer: "below",
  }] : []);

  function layout(x, y, more = {}) {
    const cursor = state.speed * factor();
    return {
      ...theme.layout(), margin: { l: 60, r: 15, t: 10, b: 45 }, hovermode: "closest", dragmode: DRAG, xaxis: x, yaxis: y, showlegend: true,
      legend: { orientation: "h", y: 1.02, yanchor: "bottom", font: { size: 11 } }, uirevision: state.unit,
      shapes: [
        { name: "cursor", type: "line", x0: cursor, x1: cursor, yref: "paper", y0: 0, y1: 1, line: { color: theme.colour("muted"), width: 1, dash: "dot" }},
        ...(x.title.text.startsWith("speed (") ? operatingRange() : []),
      ],
      ...more,
    };
  }

  // where on the blades stress is looked for, a line at the yield stress of each, and what is above the lowest of them;
  // what differs says whose it is
  function markStress(plan, traces, blades, scene) {
    const regions = new Set(blades.map((blade) => data.stress_region[data.blades[blade]]).filter(Boolean));
    (plan.annotations ||= []).push({
      xref: "paper", x: 0, xanchor: "left", yref: "paper", y: 1, yanchor: "top", showarrow: false, font: { size: 10 },
      text: regions.size > 1 ? "stress in regions of each blade: see summary.csv" : [...regions].map((region) => `stress: ${region}`).join("").replaceAll("<", "&lt;"),
    });
    const bladesOf = new Map();
    blades.forEach((blade) => {
      const limit = yieldStress.row(blade)[scene];
      if (Number.isFinite(limit)) bladesOf.set(limit, [...(bladesOf.get(limit) ?? []), data.blades[blade]]);
    });
    if (!bladesOf.size) return;
    const across = { xref: "paper", x0: 0, x1: 1, layer: "below", showlegend: true };
    const lowest = Math.min(...bladesOf.keys());
    const top = 1.05 * traces.flatMap(({ y }) => y).filter(Number.isFinite).reduce((most, value) => Math.max(most, value), lowest);
    plan.yaxis.range = [0, top];
    plan.shapes.push({
      ...across, type: "rect", y0: lowest, y1: top, line: { width: 0 }, fillcolor: theme.colour("warning"), opacity: 0.12, name: OUTSIDE,
    });
    [...bladesOf].forEach(([limit, names], number) => {
      plan.shapes.push({
        ...across, type: "line", y0: limit, y1: limit, line: { color: theme.colour("muted"), width: 1.5, dash: "dash" }, name: "yield stress",
        showlegend: number === 0,
      });
      if (bladesOf.size > 1) {
        (plan.annotations ||= []).push({
          xref: "paper", x: 1, xanchor: "right", y: limit, yanchor: "bottom", showarrow: false, font: { size: 10 }, text: names.join(", "),
        });
      }
    });
  }

  // panels that have nothing to show are hidden, and named in one line below the others
  const missing = new Set();
  const fitted = new ResizeObserver((entries) => entries.forEach(({ target }) => {
    if (!target.clientWidth || target.dataset.width === String(target.clientWidth)) return;
    target.dataset.width = target.clientWidth;
    Plotly.Plots.resize(target);
  }));

  // `clicks`: whether a click goes to the speed under it
  function draw(name, traces, plan, clicks = true) {
    const place = document.getElementById(name);
    place.parentElement.hidden = traces.length === 0;
    if (traces.length === 0) {
      missing.add(name);
      fitted.unobserve(place);
      if (place.classList.contains("js-plotly-plot")) Plotly.purge(place);
      delete place.dataset.listens;
      return;
    }
    missing.delete(name);
    place.dataset.width = place.clientWidth;
    Plotly.react(place, traces, plan, OPTIONS);
    fitted.observe(place);
    if (clicks && !place.dataset.listens) {
      place.dataset.listens = "yes";
      place.on("plotly_click", ({ points: [{ x, data: of }] }) => { if (of?.type !== "bar") set({ speed: x / factor() }); });
    }
  }

  function drawMissing() {
    const titles = PLOTS.filter((name) => missing.has(name))
      .map((name) => document.getElementById(name).parentElement.querySelector("h2").textContent);
    const history = missing.has("stress")
      ? " For the stress of every revolution name speeds in the scene's stress_history_speeds_rad_s." : "";
    document.getElementById("missing").textContent = titles.length
      ? `Not computed for ${state.blade} in ${state.scene}: ${titles.join(", ")}.${history}` : "";
  }

  // the archive of Snakemake's report has each file in a folder of its own, and lists the figures itself
  const IN_REPORT = /\/data\/raw\/[0-9a-f]+\/[^/]+$/.test(window.location.pathname);

  // tables and figures: those of the chosen blade and scene, and those of several
  function drawLinks() {
    const isHere = ({ blade = state.blade, scene = state.scene }) => !IN_REPORT && blade === state.blade && scene === state.scene;
    const links = (data.links ?? []).filter(isHere)
      .flatMap(({ label, file }) => [Object.assign(document.createElement("a"), { href: encodeURI(file), textContent: label }), " "]);
    document.getElementById("links").replaceChildren(...(links.length ? ["Tables and figures: ", ...links] : []));
  }

  // how long each blade is dangerous and unknown in the chosen scene
  function drawDanger() {
    const place = document.getElementById("danger");
    const scene = sceneIndex();
    const known = data.blades.map((_, blade) => blade).filter((blade) => ran(blade, scene).length && data.danger[blade][scene].lengths.dangerous !== undefined);
    place.parentElement.hidden = !yieldStress || !known.length;
    const table = document.createElement("table");
    const heads = ["blade", "dangerous (rad/s)", "unknown (rad/s)", "sustained (rad/s)", "largest stress inside the model (MPa)", "leaves the model by"];
    table.createTHead().insertRow().append(...heads.map((textContent) => Object.assign(document.createElement("th"), { scope: "col", textContent })));
    const body = table.createTBody();
    known.forEach((blade) => {
      const { lengths, causes } = data.danger[blade][scene];
      const inside = ran(blade, scene).map((at) => valueOf("max_von_mises_inside", blade, scene, at)).filter(Number.isFinite);
      const row = body.insertRow();
      row.className = blade === bladeIndex() ? "chosen" : "";
      row.addEventListener("click", () => set({ blade: data.blades[blade] }));
      row.insertCell().append(Object.assign(document.createElement("button"), { type: "button", className: "choose", textContent: data.blades[blade] }));
      const numbers = [lengths.dangerous, lengths.unknown, lengths.sustained, inside.length ? Math.max(...inside) : NaN];
      [...numbers.map((value) => digits(value, 3)), causes].forEach((textContent) => Object.assign(row.insertCell(), { textContent }));
    });
    place.replaceChildren(table);
  }

  function drawCampbell() {
    const blade = bladeIndex();
    const top = Math.max(...frequency.row(blade, Math.min(5, campbell.modes.length - 1)).filter(Number.isFinite)) * 1.05;
    const last = campbellSpeeds[campbellSpeeds.length - 1];
    const modes = campbell.modes.map((_, number) => number).filter((number) => Math.min(...frequency.row(blade, number)) < top);
    const traces = modes.flatMap((number) => modeTraces(blade, number));
    const ranges = [shown([campbellSpeeds[0], last]), [0, top]];
    const [x, y] = [axis(`speed (${state.unit})`, { range: [...ranges[0]] }), axis("frequency (Hz)", { range: [...ranges[1]] })];
    const plan = layout(x, y, { margin: { l: 60, r: 30, t: 10, b: 45 } });
    // above the numbers of the engine orders
    plan.legend.y = 1.06;
    const [lines, numbers] = orderTraces("campbell", ...ranges);
    draw("campbell", [lines, ...traces, numbers], plan);
    followView("campbell");
  }

  // lines of the engine orders from border to border of a panel, and their numbers where they leave it, as far as these have room
  function orderTraces(name, [left, right], [bottom, top]) {
    const { clientWidth, clientHeight } = document.getElementById(name);
    const lines = {
      x: [], y: [], text: [], mode: "lines", line: { color: theme.colour("lines"), width: 1 }, hoverinfo: "text", name: "engine orders",
    };
    const numbers = {
      x: [], y: [], text: [], textposition: [], mode: "text", textfont: { size: 10, color: theme.colour("muted") }, hoverinfo: "skip",
      cliponaxis: false, showlegend: false, name: "numbers of engine orders",
    };
    let before = [Infinity, Infinity];
    campbell.orders.forEach((order) => {
      const slope = order / 2 / Math.PI / factor();
      const [start, end] = [Math.max(left, bottom / slope), Math.min(right, top / slope)];
      if (end <= start) return;
      const height = Math.min(slope * end, top);
      lines.x.push(start, end, null);
      lines.y.push(slope * start, height, null);
      lines.text.push(`engine order ${order}`, `engine order ${order}`, null);
      const place = [(end - left) / (right - left) * clientWidth / NUMBER_SIZE[0], (height - bottom) / (top - bottom) * clientHeight / NUMBER_SIZE[1]];
      if (Math.hypot(place[0] - before[0], place[1] - before[1]) < 1) return;
      before = place;
      numbers.x.push(end);
      numbers.y.push(height);
      numbers.text.push(String(order));
      numbers.textposition.push(end < right ? "top center" : "middle right");
    });
    return [lines, numbers];
  }

  // the engine orders fit the part of the diagram that is shown
  function fitOrders(diagram) {
    const place = document.getElementById(diagram);
    const [lines, numbers] = orderTraces(diagram, place.layout.xaxis.range, place.layout.yaxis.range);
    const both = (name) => [lines[name], numbers[name]];
    const changes = { x: both("x"), y: both("y"), text: both("text"), textposition: ["middle center", numbers.textposition] };
    Plotly.restyle(place, changes, [0, place.data.length - 1]);
  }

  // what is drawn again stays zoomed
  function followView(name) {
    const place = document.getElementById(name);
    if (place.dataset.follows) fitOrders(name);
    else place.on("plotly_relayout", () => fitOrders(name));
    place.dataset.follows = "yes";
  }

  // a mode's frequency and its crossings with engine orders, in its colour
  function modeTraces(blade, number) {
    const mode = campbell.modes[number];
    const look = { name: modeText(mode), legendgroup: mode, hoverinfo: "text" };
    const color = colourOf(number);
    const values = frequency.row(blade, number);
    const found = { ...look, x: [], y: [], text: [], mode: "markers", marker: { color, size: 6 }, showlegend: false };
    crossing.row(blade, number).forEach((speed, at) => {
      if (!Number.isFinite(speed)) return;
      const order = campbell.orders[at];
      found.x.push(speed * factor());
      found.y.push(order * speed / 2 / Math.PI);
      found.text.push(`${look.name} with engine order ${order}<br>${speedText(speed)}<br>${digits(order * speed / 2 / Math.PI)} Hz`);
    });
    const line = {
      ...look, x: shown(campbellSpeeds), y: values, mode: "lines", line: { color, dash: DASHES[Math.floor(number / COLOURS.length) % 4] },
      text: values.map((value, at) => `${look.name}<br>${speedText(campbellSpeeds[at])}<br>${digits(value)} Hz`),
    };
    return [line, found];
  }

  // looks of the kinds of speeds, each a row of bars; sustained speeds are a line on them
  const KINDS = {
    dangerous: (color) => ({ marker: { color } }),
    unknown: (color) => ({ marker: { color, pattern: { shape: "/", fillmode: "replace", size: 6, solidity: 0.35 } }}),
    sustained: () => ({ marker: { color: theme.colour("text"), line: { color: theme.colour("background"), width: 1 } }, width: 0.3 }),
  };
  const SAY = {
    dangerous: () => "dangerous: above yield, inside the model",
    unknown: (causes) => `unknown: leaves the model first, by ${causes}`,
    sustained: () => "sustained: above yield in most later revolutions",
  };

  // bars below the response: where each of its rows is dangerous, unknown or sustained
  function dangerTraces(rows) {
    return Object.entries(KINDS).map(([kind, look]) => {
      const parts = rows.flatMap(({ name, colour, danger }) => (danger.ranges[kind] ?? []).map((ends) => ({ name, colour, ends, causes: danger.causes })));
      return {
        type: "bar", orientation: "h", yaxis: "y2", name: kind, hoverinfo: "text", cliponaxis: false,
        base: shown(parts.map(({ ends }) => ends[0])), x: shown(parts.map(({ ends }) => ends[1] - ends[0])), y: parts.map(({ name }) => name),
        text: parts.map(({ name, ends, causes }) => `${name}<br>${SAY[kind](causes)}<br>${speedText(ends[0])} to ${speedText(ends[1])}`), textposition: "none",
        ...look(parts.map(({ colour }) => colour)),
      };
    }).filter(({ x }) => x.length);
  }

  function drawResponse() {
    const curve = curves.find((one) => one.name === state.quantity);
    const scene = sceneIndex();
    const blades = state.all ? data.blades.map((_, number) => number) : [bladeIndex()];
    const scenes = state.all ? [scene] : data.scenes.map((_, number) => number);
    const traces = [];
    const crosses = [];
    const rows = [];
    blades.forEach((blade) => scenes.forEach((number) => {
      const places = ran(blade, number);
      const values = curve.values.row(blade, number);
      const lost = places.filter((at) => status.row(blade, number)[at] === DIVERGED);
      // what has no number at all is not computed, unless every run diverged
      if (!places.some((at) => Number.isFinite(values[at])) && (!lost.length || lost.length < places.length)) return;
      const rank = state.all ? blade : number;
      const name = state.all ? data.blades[blade] : data.scenes[number];
      const colour = colourOf(rank);
      rows.push({ name, colour, danger: data.danger[blade][number] });
      traces.push({
        x: shown(places.map((at) => speeds[at])), y: places.map((at) => values[at]), name, mode: "lines+markers", hoverinfo: "text",
        line: { color: colour, dash: DASHES[Math.floor(rank / COLOURS.length) % DASHES.length], width: 1.5 },
        marker: { size: 4, symbol: MARKERS[Math.floor(rank / COLOURS.length) % MARKERS.length] },
        text: places.map((at) => pointText(curve, blade, number, at)),
      });
      if (lost.length) {
        crosses.push({
          x: shown(lost.map((at) => speeds[at])), mode: "markers", name: `${name} diverged`,
          marker: { symbol: "x", size: 9, color: colour }, hoverinfo: "text",
          text: lost.map((at) => pointText(curve, blade, number, at)),
        });
      }
    }));
    // above all that has a number: nothing is worse
    const top = 1.08 * traces.flatMap(({ y }) => y).filter(Number.isFinite).reduce((most, y) => Math.max(most, y), 0) || 1;
    traces.push(...crosses.map((cross) => ({ ...cross, y: cross.x.map(() => top) })));
    const plan = layout(speedAxis(), axis(broken(labelText(curve)), { automargin: true, rangemode: "tozero", title: { text: broken(labelText(curve)), font: { size: 12 } } }));
    if (state.quantity.startsWith("max_von_mises") && yieldStress) markStress(plan, traces, blades, scene);
    const high = Math.min(0.5, 0.065 * rows.length);
    Object.assign(plan, {
      barmode: "overlay", bargap: 0.2,
      yaxis2: { ...theme.axis(), domain: [0, high], type: "category", dtick: 1, categoryarray: rows.map(({ name }) => name), autorange: "reversed", fixedrange: true, automargin: true, tickfont: { size: 10 } },
    });
    plan.yaxis.domain = [high + 0.08, 1];
    Object.assign(plan.xaxis, { anchor: "y2" });
    draw("response", [...traces, ...dangerTraces(rows)], plan);
  }

  // `marks`: speeds that are marked above the map, with a name, a look and a text
  function drawMap(name, { title, unit, say, colorscale, scaled = (column) => column, marks = [] }) {
    const map = maps[name];
    const here = [bladeIndex(), sceneIndex()];
    const values = map && map.values.row(...here);
    if (!map || !values.some(Number.isFinite)) return draw(name, [], null);
    const { values: other } = map.other;
    const across = other.length;
    // where other blades were run and this one was not there is no column; a cell reaches half-way to its neighbours
    const places = map.speeds.values.map((_, at) => at).filter((at) => values.slice(at * across, (at + 1) * across).some(Number.isFinite));
    const columns = places.map((at) => values.slice(at * across, (at + 1) * across));
    const rows = (of) => other.map((_, number) => of.map((column) => column[number]));
    const trace = {
      type: "heatmap", x: shown(places.map((at) => map.speeds.values[at])), y: other, colorscale, zsmooth: false, hoverinfo: "text",
      z: rows(columns.map(scaled)),
      text: rows(columns).map((row, number) => row.map((value, place) => say(map.speeds.values[places[place]], other[number], value))),
      colorbar: { title: { text: unit, side: "right" }, thickness: 12 },
    };
    const plan = layout(speedAxis(), axis(title), { showlegend: false });
    // on dark colours
    plan.shapes[0].line.color = "#fff";
    const marked = ({ mark, of, look, text }) => {
      const at = ran(...here).filter((place) => of(place));
      return at.length ? [{
        type: "scatter", mode: "markers", name: mark, x: shown(at.map((place) => speeds[place])), y: at.map(() => other[across - 1]), hoverinfo: "text",
        text: at.map((place) => `${speedText(speeds[place])}<br>${text(place)}`), marker: { size: 9, ...look }, cliponaxis: false,
      }] : [];
    };
    const diverged = {
      mark: "diverged", of: (at) => status.row(...here)[at] === DIVERGED, text: () => "diverged",
      look: { symbol: "x", color: theme.colour("warning") },
    };
    return draw(name, [trace, ...[diverged, ...marks].flatMap(marked)], plan);
  }

  // below the largest at the same speed: beside a resonance all else would be dark; order 0, the mean, does not count
  function decibels(column) {
    const largest = Math.max(...column.slice(1).filter(Number.isFinite));
    return column.map((value) => Math.max(20 * Math.log10(value / largest), -SPECTRUM_DECIBELS));
  }

  // share of the circumference, of the run at a place among the speeds
  const wornThrough = (at) => curves.find((curve) => curve.name === "worn_through_share").values.row(bladeIndex(), sceneIndex())[at];

  const sayAmplitude = (speed, order, value) => `${speedText(speed)}<br>engine order ${digits(order)}, ${digits(order * speed / 2 / Math.PI)} Hz`
    + `<br>${digits(value, 4)} mm`;
  const sayWear = (speed, degrees, value) => `${speedText(speed)}<br>${digits(degrees)} degrees<br>${digits(value, 4)} mm`;

  function drawStress() {
    const here = [bladeIndex(), sceneIndex()];
    const traces = [];
    const exits = [];
    const plan = layout(axis("revolution"), axis("largest von Mises stress (MPa)"), { shapes: [] });
    history?.speeds.values.forEach((speed, number) => {
      const values = history.values.row(...here, number);
      if (!values.some(Number.isFinite)) return;
      const exit = valueOf("exit_revolution", ...here, speeds.indexOf(speed));
      const near = Math.abs(speed - state.speed) < 1e-6 * speed;
      traces.push({
        x: values.map((_, at) => at + 1), y: values, name: `${digits(speed)} rad/s`, mode: "lines", hoverinfo: "text",
        line: { color: colourOf(number), width: near ? 3 : 1.2, dash: DASHES[Math.floor(number / COLOURS.length) % 4] },
        text: values.map((value, at) => `${speedText(speed)}<br>revolution ${at + 1}<br>${digits(value)} MPa`),
      });
      if (exit > 0) {
        exits.push({
          x: [exit], y: [values[exit - 1]], name: "leaves the model", legendgroup: "exit", showlegend: !exits.length, mode: "markers", hoverinfo: "text",
          marker: { symbol: "x-thin-open", size: 11, color: theme.colour("text") },
          text: [`${speedText(speed)}<br>leaves the model in revolution ${exit}`],
        });
      }
    });
    if (traces.length) markStress(plan, traces, [here[0]], here[1]);
    draw("stress", [...traces, ...exits], plan, false);
  }

  function drawNow() {
    const curve = curves.find((one) => one.name === state.quantity);
    const text = pointText(curve, bladeIndex(), sceneIndex(), nearest(state.speed)).replaceAll("<br>", ", ");
    document.getElementById("now").textContent = text;
    for (const name of ["blade", "scene", "quantity", "unit"]) document.getElementById(name).value = state[name];
    document.getElementById("speed").value = digits(state.speed * factor());
    for (const name of Object.keys(SWITCHES)) document.getElementById(name).checked = state[name];
    const told = new URLSearchParams(Object.entries(state).map(([name, value]) => [name, String(value)]));
    window.history.replaceState(null, "", `#${told}`);
  }

  // a plot, and what of the state it shows beside the cursor
  const DRAWINGS = {
    danger: [drawDanger, ["blade", "scene"]],
    campbell: [drawCampbell, ["blade", "unit"]],
    response: [drawResponse, ["blade", "scene", "quantity", "unit", "all"]],
    spectrum: [() => drawMap("spectrum", {
      title: "engine order", unit: "dB below the largest at that speed", say: sayAmplitude, colorscale: MAGMA, scaled: decibels,
    }), ["blade", "scene", "unit"]],
    wear: [() => drawMap("wear", {
      title: "angle (degrees)", unit: maps.wear && broken(labelText(maps.wear)), say: sayWear, colorscale: "Viridis",
      marks: [{
        mark: "worn through", of: (at) => wornThrough(at) > 0, look: { symbol: "triangle-down", color: theme.colour("text") },
        text: (at) => `worn through to the casing on ${digits(100 * wornThrough(at), 3)}% of the circumference`,
      }],
    }), ["blade", "scene", "unit"]],
    stress: [drawStress, ["blade", "scene", "speed"]],
    links: [drawLinks, ["blade", "scene"]],
  };
  const drawn = {};

  // panels of extensions, tables that decide first and the others below: hidden where they have nothing to show, and not named as missing
  const offered = {
    state, set, factor, shown, digits, speedText, axis, speedAxis, layout, draw, colourOf, MAGMA, muted: () => theme.colour("muted"),
    // limits of the model that runs of a blade in a scene leave before they pass yield
    causes: (blade, scene) => data.danger[data.blades.indexOf(blade)]?.[data.scenes.indexOf(scene)]?.causes ?? "",
    // rows of the verdict, of a run with requirements
    requirements: data.panels?.requirements?.requirements ?? [],
  };
  for (const [extension, contents] of Object.entries(data.panels ?? {})) {
    for (const [name, panel] of Object.entries(panels[extension](await unpackAll(contents), offered))) {
      const section = Object.assign(document.createElement("section"), { className: panel.first ? "wide" : "" });
      section.append(
        Object.assign(document.createElement("h2"), { textContent: panel.title }),
        Object.assign(document.createElement("div"), { id: name, className: panel.first ? "table" : "plot" }),
      );
      if (panel.first) document.querySelector("main").prepend(section);
      else document.getElementById("missing").before(section);
      DRAWINGS[name] = [panel.draw, panel.of];
    }
  }

  // a table has no cursor. Plotly draws all anew where it is told of another place, and the line alone where only its opacity is asked for
  function moveCursor(name) {
    const [cursor] = (!missing.has(name) && document.getElementById(name).layout?.shapes) || [];
    const x = state.speed * factor();
    if (cursor?.name !== "cursor" || cursor.x0 === x) return;
    Object.assign(cursor, { x0: x, x1: x });
    Plotly.relayout(name, { "shapes[0].opacity": 1 });
  }

  // only what is another: a step in speed moves the cursors
  function drawAll() {
    for (const [name, [drawIt, of]] of Object.entries(DRAWINGS)) {
      const wanted = JSON.stringify([theme.dark(), ...of.map((one) => state[one])]);
      if (drawn[name] === wanted) {
        moveCursor(name);
      } else {
        drawn[name] = wanted;
        drawIt();
      }
    }
    drawMissing();
    drawNow();
  }

  // the speed that ran nearest to a wanted one
  function nearest(speed) {
    const places = ran(bladeIndex(), sceneIndex());
    return places.reduce((best, at) => (Math.abs(speeds[at] - speed) < Math.abs(speeds[best] - speed) ? at : best), places[0] ?? 0);
  }

  function set(changes) {
    Object.assign(state, changes);
    if ("speed" in changes || "blade" in changes || "scene" in changes) state.speed = speeds[nearest(state.speed)];
    drawAll();
  }

  const next = (list, value, step) => list[(list.indexOf(value) + step + list.length) % list.length];
  const step = (by) => {
    const places = ran(bladeIndex(), sceneIndex());
    const at = places.indexOf(nearest(state.speed)) + by;
    if (places[at] !== undefined) set({ speed: speeds[places[at]] });
  };
  const KEYS = {
    ArrowLeft: () => step(-1), ArrowRight: () => step(1),
    b: () => set({ blade: next(data.blades, state.blade, 1) }), B: () => set({ blade: next(data.blades, state.blade, -1) }),
    s: () => set({ scene: next(data.scenes, state.scene, 1) }), u: () => set({ unit: state.unit === "rpm" ? "rad/s" : "rpm" }),
    q: () => set({ quantity: next(curves.map((one) => one.name), state.quantity, 1) }), a: () => set({ all: !state.all }),
  };

  function listen() {
    const same = (names) => names.map((name) => new Option(name));
    const options = {
      blade: same(data.blades), scene: same(data.scenes), quantity: curves.map((one) => new Option(labelText(one), one.name)),
    };
    for (const [name, values] of Object.entries(options)) document.getElementById(name).replaceChildren(...values);
    for (const name of ["blade", "scene", "quantity", "unit"]) {
      document.getElementById(name).addEventListener("change", (event) => set({ [name]: event.target.value }));
    }
    document.getElementById("speed").addEventListener("change", (event) => {
      if (Number.isFinite(event.target.valueAsNumber)) set({ speed: event.target.valueAsNumber / factor() });
    });
    for (const name of Object.keys(SWITCHES)) {
      const box = document.getElementById(name);
      box.addEventListener("change", (event) => set({ [name]: event.target.checked }));
    }
    document.getElementById("controls").addEventListener("submit", (event) => event.preventDefault());
    document.addEventListener("keydown", (event) => {
      const typing = ["INPUT", "SELECT"].includes(event.target.tagName);
      if (KEYS[event.key] && !typing && !event.ctrlKey && !event.metaKey && !event.altKey) { event.preventDefault(); KEYS[event.key](); }
    });
    window.addEventListener("hashchange", () => set(fromAddress()));
    theme.onChange(drawAll);
  }

  // what the page opens at, the worst run of all blades and scenes: one that diverged, else the largest stress, or motion without stress
  function worstRun() {
    const loads = ["max_von_mises_inside", "max_von_mises_ever", "rms_normal"].map((name) => curves.find((curve) => curve.name === name)).filter(Boolean);
    let [most, worst] = [[], { speed: speeds[0] }];
    data.blades.forEach((blade, row) => data.scenes.forEach((scene, column) => ran(row, column).forEach((at) => {
      const load = [Number(status.row(row, column)[at] === DIVERGED), ...loads.map((curve) => curve.values.row(row, column)[at])].map((value) => (Number.isFinite(value) ? value : 0));
      const differs = load.findIndex((value, number) => value !== (most[number] ?? -1));
      if (differs >= 0 && load[differs] > (most[differs] ?? -1)) [most, worst] = [load, { blade, scene, speed: speeds[at] }];
    })));
    return worst;
  }

  // what the address asks for, as far as the data have it
  function fromAddress() {
    const told = Object.fromEntries(new URLSearchParams(window.location.hash.slice(1)));
    const known = { blade: data.blades, scene: data.scenes, quantity: curves.map(({ name }) => name), unit: ["rad/s", "rpm"] };
    const wanted = {};
    for (const [name, values] of Object.entries(known)) if (values.includes(told[name])) wanted[name] = told[name];
    if (Number.isFinite(Number.parseFloat(told.speed))) wanted.speed = Number.parseFloat(told.speed);
    for (const [name, usual] of Object.entries(SWITCHES)) wanted[name] = name in told ? told[name] === "true" : usual;
    return wanted;
  }

  const about = Object.entries(data.about).map(([name, value]) => `${name} ${value}`).join(", ");
  document.getElementById("about").append(` ${about}. Maps show the largest amplitude within 0.1 engine orders, and the largest`
    + " wear within two degrees; beyond 400 speeds neighbours are joined. Curves have every speed.");
  listen();
  set({ ...worstRun(), ...fromAddress() });
  document.documentElement.dataset.ready = PLOTS.join(" ");
})();
