// the interactions of all blades in the chosen scene on a Campbell diagram, as circles whose area is the length above yield in most
// revolutions, diamonds for some revolutions and rings for none; what has no engine order on a strip below. A click on one goes to it
const interactionMap = (data, page) => {
  const { state, factor, shown, digits, speedText, axis, speedAxis, layout, draw, colourOf, campbell } = page;
  const [NAME, RING, MOST_LABELS, LETTERS, STRIP] = ["interaction_map", 8, 5, 12, 0.07];
  // sides of a circle on which its label may stand, and how far from it
  const AWAY = [4, 18, 34, 50].flatMap((distance) => [1, -1, 0].flatMap((across) => [1, -1, 0].map((up) => [across, up, distance])))
    .filter(([across, up]) => across || up);
  // ticks of the strip
  const BELOW = Object.fromEntries(["50", "100", "200", "400", "500", "1000"].map((tick) => [`\u2212${tick}`, ""]));
  const pen = document.createElement("canvas").getContext("2d");
  const diameter = (size, largest) => {
    const { clientWidth } = document.getElementById(NAME);
    return Math.max(3, Math.min(40, clientWidth / 12) * Math.sqrt(size / largest || 0));
  };
  const inUnit = (size, unit) => {
    const value = unit === "mm" ? size : size * factor();
    return `${value < 10 ? digits(value, 2) : value.toFixed(0)} ${unit === "mm" ? unit : state.unit}`;
  };
  const amount = ({ size, unit, onward, above, largest_stress_over_yield: times }) => (
    above === "some" ? `up to ${digits(times, 2)} x yield` : `${onward ? "> " : ""}${inUnit(size, unit)}`);
  const MEANINGS = {
    most: "above yield in most revolutions", some: "above yield in some revolutions", never: "below yield in all judged revolutions",
    "": "stress not known",
  };
  const meaning = ({ above, unit }) => (unit === "mm" ? "rms" : MEANINGS[above]);
  // a circle has the area of its length, or of its motion; of other marks the share of the revolutions decides which is worse
  const isCircle = ({ above, unit }) => above === "most" || unit === "mm";
  const isDangerous = (row) => isCircle(row) || row.above === "some";
  const share = (row) => row.share_of_revolutions_above_yield ?? 0;
  const widthOf = (row, largest) => (isCircle(row) ? diameter(row.size, largest) : RING);

  function trace(rows, blade, largest) {
    const colour = colourOf(data.blades.indexOf(blade));
    return {
      x: shown(rows.map((row) => row.peak_speed_rad_s)), y: rows.map((row) => row.height), name: blade, legendgroup: blade, showlegend: false, mode: "markers",
      customdata: rows, hoverinfo: "text", cliponaxis: false,
      text: rows.map((row) => `${blade}, ${row.interaction}<br>${speedText(row.peak_speed_rad_s)}<br>`
        + `${isDangerous(row) ? `${amount(row)}, ` : ""}${meaning(row)}<br>${row.status}`),
      marker: {
        size: rows.map((row) => widthOf(row, largest)), opacity: 1, symbol: rows.map(({ above }) => (above === "some" ? "diamond" : "circle")),
        color: rows.map((row) => (isDangerous(row) ? `${colour}73` : "rgba(0,0,0,0)")),
        line: { color: colour, width: blade === state.blade ? 2.5 : 1 },
      },
    };
  }

  // a named mode: a band from the lowest to the highest blade, with its name at its begin
  function bands(left, top) {
    const speeds = campbell.speeds.values;
    return campbell.modes.map((_, mode) => mode).filter((mode) => ["1B", "1T", "2B"].includes(campbell.modes[mode])).map((mode) => {
      const rows = data.blades.map((_, blade) => campbell.frequency.row(blade, mode));
      const [low, high] = [Math.min, Math.max].map((end) => speeds.map((_, at) => end(...rows.map((row) => row[at]))));
      // simplified, the two edges of one blade lie apart
      const line = { color: theme.colour("muted"), width: 1, simplify: false };
      const at = speeds.findIndex((speed) => speed * factor() >= left);
      return {
        band: {
          x: shown([...speeds, ...speeds.toReversed()]), y: [...high, ...low.toReversed()], mode: "lines", fill: "toself", line,
          fillcolor: `${theme.colour("lines")}55`, hoverinfo: "skip", showlegend: false,
        },
        name: { text: `<b>${campbell.modes[mode]}</b>`, x: left, y: high[Math.max(at, 0)], xanchor: "left", yanchor: "bottom", showarrow: false },
      };
    }).filter(({ name }) => name.y < top);
  }

  // labels of the largest circles, as far as there is room: neither on each other nor on other circles
  function labels(circles, largest) {
    const { xaxis, yaxis } = document.getElementById(NAME)._fullLayout;
    pen.font = `${LETTERS}px sans-serif`;
    const boxes = circles.map((row) => {
      const [x, y, radius] = [xaxis.d2p(row.peak_speed_rad_s * factor()), yaxis.d2p(row.height), widthOf(row, largest) / 2];
      return { row, radius, x, y, box: [x - radius, y - radius, x + radius, y + radius] };
    });
    const overlap = (one, other) => one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3];
    const found = [];
    boxes.filter(({ row }) => isDangerous(row)).forEach((circle) => {
      if (found.length === MOST_LABELS) return;
      const { row, radius, x, y } = circle;
      const title = [...(data.blades.length > 1 ? [row.blade] : []), ...(row.frequency === null ? [] : [row.interaction.replace("engine ", "")])];
      const text = [...(title.length ? [title.join(" ")] : []), amount(row)].join(", ");
      const [width, height] = [pen.measureText(text).width / 2 + 4, LETTERS * 0.75];
      const taken = [...boxes.filter((other) => other !== circle), ...found].map(({ box }) => box);
      for (const [across, up, distance] of AWAY) {
        const [ax, ay] = [across * ((radius + distance) * Math.SQRT1_2 + width), -up * ((radius + distance) * Math.SQRT1_2 + height)];
        const box = [x + ax - width, y + ay - height, x + ax + width, y + ay + height];
        const inside = box[0] >= 0 && box[1] >= 0 && box[2] <= xaxis._length && box[3] <= yaxis._length;
        if (inside && !taken.some((other) => overlap(box, other))) {
          found.push({ box, label: {
            text: text.replaceAll("<", "&lt;"), x: row.peak_speed_rad_s * factor(), y: row.height, ax, ay, arrowhead: 0, arrowwidth: 1,
            arrowcolor: theme.colour("muted"), font: { size: LETTERS }, borderpad: 0, bgcolor: `${theme.colour("background")}aa`,
          } });
          return;
        }
      }
    });
    return found.map(({ label }) => label);
  }

  // what two sizes mean, below the diagram
  function drawKey(rows) {
    const [{ size: largest, unit } = { size: 0 }] = rows.filter(isCircle);
    const toShown = unit === "mm" ? 1 : factor();
    const round = (size) => {
      const power = 10 ** Math.floor(Math.log10(size * toShown));
      return power * [5, 2, 1].find((digit) => digit * power <= size * toShown * (1 + 1e-9)) / toShown;
    };
    const entry = (className, width, text) => {
      const key = Object.assign(document.createElement("span"), { className: "key" });
      const mark = Object.assign(document.createElement("span"), { className });
      mark.style.width = mark.style.height = `${width}px`;
      key.append(mark, text);
      return key;
    };
    const said = unit === "mm" ? "rms" : MEANINGS.most;
    const others = [["some", "circle diamond"], ["never", "circle ring"], ["", "circle ring"]];
    document.getElementById("sizes").replaceChildren(
      ...(largest > 0 ? [largest, 0.15 * largest].map(round).map((size) => entry("circle", diameter(size, largest), `${inUnit(size, unit)} ${said}`)) : []),
      ...others.filter(([above]) => rows.some((row) => row.above === above && !isCircle(row))).map(([above, name]) => entry(name, RING, MEANINGS[above])),
    );
  }

  return function drawMap() {
    const { modes, frequency } = campbell;
    const found = data.interactions.filter(({ scene }) => scene === state.scene);
    const second = data.blades.flatMap((_, blade) => frequency.row(blade, Math.max(modes.indexOf("2B"), 0)));
    const heights = found.map((row) => row.frequency).filter((height) => height !== null);
    const top = Math.min(1.3 * Math.max(...second.filter(Number.isFinite)), heights.length ? 1.15 * Math.max(...heights) : Infinity);
    // at the upper edge what is higher
    const strip = heights.length < found.length ? -STRIP * top : 0;
    const rows = found.map((row) => ({ ...row, height: Math.min(row.frequency ?? strip, top) }))
      .sort((one, other) => other.size - one.size || share(other) - share(one));
    const largest = rows.find(isCircle)?.size ?? 0;
    const x = speedAxis();
    const named = bands(x.range[0], top);
    const diverged = rows.filter(({ status }) => status === "diverged");
    const crosses = {
      x: shown(diverged.map((row) => row.peak_speed_rad_s)), y: diverged.map(({ height }) => height),
      name: "diverged", mode: "markers", cliponaxis: false, customdata: diverged, hoverinfo: "text",
      text: diverged.map((row) => `${row.blade} diverged<br>${speedText(row.peak_speed_rad_s)}`),
      marker: { symbol: "x", size: 9, color: theme.colour("warning") },
    };
    // in the legend blades have their colour alone, whatever the mark of their first row
    const legend = (blade) => ({
      x: [null], y: [null], name: blade, legendgroup: blade, mode: "markers", marker: { size: RING, color: colourOf(data.blades.indexOf(blade)) },
    });
    const traces = data.blades.map((blade) => trace(rows.filter((row) => row.blade === blade && (row.status !== "diverged" || row.size > 0)), blade, largest))
      .filter(({ x: places }) => places.length);
    const plan = layout(x, axis("frequency (Hz)", { range: [2 * strip, top], zeroline: strip < 0, labelalias: BELOW }), { margin: { l: 60, r: 30, t: 10, b: 45 } });
    Object.assign(plan.legend, { itemsizing: "constant", y: 1.06 });
    const [lines, numbers] = page.orderTraces(NAME, x.range, [0, top]);
    const marks = [...named.map(({ band }) => band), ...traces, ...traces.map(({ name }) => legend(name)), ...(diverged.length ? [crosses] : [])];
    draw(NAME, [{ ...lines, showlegend: false }, ...marks, numbers], plan, false);
    page.followView(NAME);
    const below = {
      text: "no engine order", xref: "paper", x: 0, xanchor: "left", y: strip, showarrow: false, font: { color: theme.colour("muted") },
    };
    const none = { text: "no interaction was found", xref: "paper", x: 0.5, yref: "paper", y: 0.5, showarrow: false };
    const annotations = [...named.map(({ name }) => name), ...(strip ? [below] : []), ...(rows.length ? labels(rows, largest) : [none])];
    Plotly.relayout(NAME, { annotations });
    drawKey(rows);
    const place = document.getElementById(NAME);
    if (place.dataset.chooses) return;
    place.dataset.chooses = "yes";
    place.on("plotly_click", ({ points: [{ x: at, customdata: row }] }) => {
      page.set(row ? { blade: row.blade, scene: row.scene, speed: row.peak_speed_rad_s } : { speed: at / factor() });
    });
  };
};
