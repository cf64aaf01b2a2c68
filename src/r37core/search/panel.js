// a search: its objectives against each other, all numbers of each design on parallel axes, and a table of the best
panels.search = (search, page) => {
  const MOST_BEST = 10;
  const NARROW = 700;
  const { digits, axis, layout, draw } = page;
  const { designs, objectives, constraints, variables } = search;
  const all = designs.map((_, at) => at);
  const start = designs.indexOf("start");
  const value = (number) => (number === null ? "" : digits(number, 4));
  const plain = (label) => label.replace("\n", "");
  const scattered = ({ values, scatter }, at) => value(values[at]) + (scatter[at] ? ` ± ${digits(scatter[at], 2)}` : "");

  function text(at) {
    const lines = objectives.map((quantity) => `${quantity.label}: ${scattered(quantity, at)}`);
    lines.push(...[...constraints, ...variables].map(({ label, values }) => `${plain(label)}: ${value(values[at])}`));
    return [`<b>${designs[at]}</b>${at === start ? "" : `, round ${search.round[at]}`}`, ...lines].join("<br>");
  }

  // a single objective over the designs in the order in which they were tried
  function pairs() {
    const [first, second] = objectives;
    const across = second ? first.values : all;
    const up = second ? second.values : first.values;
    const scatter = (second ?? first).scatter;
    const points = (name, places, marker, more = {}) => ({
      name, x: places.map((at) => across[at]), y: places.map((at) => up[at]), text: places.map(text), hoverinfo: "text", mode: "markers", marker,
      error_y: { array: places.map((at) => scatter[at] ?? 0), thickness: 1, width: 0 }, ...more,
    });
    const tried = all.filter((at) => at !== start);
    const front = all.filter((at) => search.front[at]).sort((one, other) => across[one] - across[other] || up[other] - up[one]);
    const traces = [
      points("breaks a constraint", tried.filter((at) => !search.feasible[at] && !search.refused[at]), { color: page.muted(), size: 6, symbol: "circle-open" }),
      points("keeps all constraints", tried.filter((at) => search.feasible[at] && !search.front[at]), { color: page.colourOf(0), size: 7 }),
      points("none is better in all", front.filter((at) => at !== start), { color: page.colourOf(1), size: 9 }, second ? {} : { visible: "legendonly" }),
      points("start", [start], { color: page.colourOf(2), size: 11, symbol: "square" }),
    ];
    const [x, y] = second ? [axis(first.label), axis(second.label)] : [axis("design"), axis(first.label)];
    draw("search_objectives", traces.filter((trace) => trace.x.length), layout(x, y, { shapes: [] }), false);
  }

  function parallel() {
    const places = all.filter((at) => [...variables, ...objectives].every(({ values }) => values[at] !== null));
    const dimension = ({ label, values }) => ({ label: plain(label), values: places.map((at) => values[at]) });
    const [{ values }] = objectives;
    const trace = {
      type: "parcoords", dimensions: [...variables, ...objectives].map(dimension), labelfont: { size: 9 }, tickfont: { size: 9 },
      line: { color: places.map((at) => Math.sqrt(Math.max(values[at], 0))), colorscale: "Viridis", reversescale: true },
      labelangle: -30,
    };
    const plan = layout(axis(""), axis(""), { shapes: [], margin: { l: 60, r: 40, t: 90, b: 20 } });
    draw("search_designs", places.length ? [trace] : [], plan, false);
  }

  function best() {
    const ordered = all.filter((at) => search.order[at] > 0).sort((one, other) => search.order[one] - search.order[other]);
    const places = [start, ...ordered.slice(0, MOST_BEST)];
    const columns = [
      ["design", places.map((at) => designs[at])],
      ...objectives.map((quantity) => [quantity.label, places.map((at) => scattered(quantity, at))]),
      ...constraints.map(({ label, values }) => [label, places.map((at) => value(values[at]))]),
      // on a narrow screen the numbers of a design are in the plot above
      ...(window.innerWidth < NARROW ? [] : variables).map(({ label, values }) => [label.replace("\n", "<br>"), places.map((at) => value(values[at]))]),
    ];
    const look = { align: "left", line: { color: page.muted() }, fill: { color: layout(axis(""), axis("")).paper_bgcolor } };
    const font = { color: layout(axis(""), axis("")).font.color, size: 11 };
    const trace = {
      type: "table", header: { values: columns.map(([label]) => label), ...look, font }, cells: { values: columns.map(([, cells]) => cells), ...look, font },
    };
    draw("search_best", [trace], layout(axis(""), axis(""), { shapes: [], margin: { l: 5, r: 5, t: 10, b: 5 } }), false);
  }

  return {
    search_objectives: { title: "Search: objectives", draw: pairs, of: [] },
    search_designs: { title: "Search: designs", draw: parallel, of: [] },
    search_best: { title: "Search: the best", draw: best, of: [] },
  };
};
