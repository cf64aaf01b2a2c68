// the interactions of all blades in the chosen scene on a Campbell diagram, as circles whose area is the length above yield; a click on
// one goes to it
const interactionMap = (data, page) => {
  const { state, factor, shown, digits, speedText, axis, speedAxis, layout, draw, colourOf, campbell } = page;
  const [NAME, RING, MOST_LABELS, LETTERS] = ["interaction_map", 8, 6, 12];
  // sides of a circle on which its label may stand, and how far from it
  const AWAY = [4, 18, 34, 50].flatMap((distance) => [1, -1, 0].flatMap((across) => [1, -1, 0].map((up) => [across, up, distance])))
    .filter(([across, up]) => across || up);
  const pen = document.createElement("canvas").getContext("2d");
  const diameter = (size, largest) => {
    const { clientWidth } = document.getElementById(NAME);
    return size > 0 ? Math.max(3, Math.min(40, clientWidth / 12) * Math.sqrt(size / largest)) : RING;
  };
  const inUnit = (size, unit) => {
    const value = unit === "mm" ? size : size * factor();
    return `${value < 10 ? digits(value, 2) : value.toFixed(0)} ${unit === "mm" ? unit : state.unit}`;
  };
  const amount = ({ size, unit, onward }) => `${onward ? "> " : ""}${inUnit(size, unit)}`;

  function trace(rows, blade, largest) {
    const colour = colourOf(data.blades.indexOf(blade));
    return {
      x: shown(rows.map((row) => row.peak_speed_rad_s)), y: rows.map((row) => row.frequency), name: blade, mode: "markers",
      customdata: rows, hoverinfo: "text", cliponaxis: false,
      text: rows.map((row) => `${blade}, ${row.interaction}<br>${speedText(row.peak_speed_rad_s)}<br>${amount(row)} `
        + `${row.unit === "mm" ? "rms" : "above yield in most revolutions"}<br>${row.status}`),
      marker: {
        size: rows.map(({ size }) => diameter(size, largest)), opacity: 1,
        color: rows.map(({ size }) => (size > 0 ? `${colour}73` : "rgba(0,0,0,0)")),
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
      const [x, y, radius] = [xaxis.d2p(row.peak_speed_rad_s * factor()), yaxis.d2p(row.frequency), diameter(row.size, largest) / 2];
      return { row, radius, x, y, box: [x - radius, y - radius, x + radius, y + radius] };
    });
    const overlap = (one, other) => one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3];
    const found = [];
    boxes.filter(({ row }) => row.size > 0).forEach((circle) => {
      if (found.length === MOST_LABELS) return;
      const { row, radius, x, y } = circle;
      const text = `${data.blades.length > 1 ? `${row.blade} ` : ""}${row.interaction.replace("engine ", "")}, ${amount(row)}`;
      const [width, height] = [pen.measureText(text).width / 2 + 4, LETTERS * 0.75];
      const taken = [...boxes.filter((other) => other !== circle), ...found].map(({ box }) => box);
      for (const [across, up, distance] of AWAY) {
        const [ax, ay] = [across * ((radius + distance) * Math.SQRT1_2 + width), -up * ((radius + distance) * Math.SQRT1_2 + height)];
        const box = [x + ax - width, y + ay - height, x + ax + width, y + ay + height];
        const inside = box[0] >= 0 && box[1] >= 0 && box[2] <= xaxis._length && box[3] <= yaxis._length;
        if (inside && !taken.some((other) => overlap(box, other))) {
          found.push({ box, label: {
            text: text.replaceAll("<", "&lt;"), x: row.peak_speed_rad_s * factor(), y: row.frequency, ax, ay, arrowhead: 0, arrowwidth: 1,
            arrowcolor: theme.colour("muted"), font: { size: LETTERS }, borderpad: 0, bgcolor: `${theme.colour("background")}aa`,
          } });
          return;
        }
      }
    });
    return found.map(({ label }) => label);
  }

  // what two sizes mean, below the diagram
  function drawKey(circles, leftOut) {
    const [{ size: largest, unit } = { size: 0 }] = circles;
    const toShown = unit === "mm" ? 1 : factor();
    const round = (size) => {
      const power = 10 ** Math.floor(Math.log10(size * toShown));
      return power * [5, 2, 1].find((digit) => digit * power <= size * toShown * (1 + 1e-9)) / toShown;
    };
    const circle = (size, text) => {
      const key = Object.assign(document.createElement("span"), { className: "key" });
      const mark = Object.assign(document.createElement("span"), { className: "circle" });
      mark.style.width = mark.style.height = `${diameter(size, largest)}px`;
      key.append(mark, text);
      return key;
    };
    const said = unit === "mm" ? "rms" : "above yield";
    document.getElementById("sizes").replaceChildren(
      ...(largest > 0 ? [largest, 0.15 * largest].map(round).map((size) => circle(size, `${inUnit(size, unit)} ${said}`)) : []),
      ...(circles.some(({ size }) => size === 0) ? [circle(0, "not above yield from rest")] : []),
      ...(leftOut ? [`${leftOut} not shown: higher, or without an engine order`] : []),
    );
  }

  return function drawMap() {
    const { modes, frequency } = campbell;
    const rows = data.interactions.filter(({ scene }) => scene === state.scene);
    const second = data.blades.flatMap((_, blade) => frequency.row(blade, Math.max(modes.indexOf("2B"), 0)));
    const heights = rows.map((row) => row.frequency).filter((height) => height !== null);
    const top = Math.min(1.3 * Math.max(...second.filter(Number.isFinite)), heights.length ? 1.15 * Math.max(...heights) : Infinity);
    const circles = rows.filter((row) => row.frequency !== null && row.frequency <= top).sort((one, other) => other.size - one.size);
    const largest = circles[0]?.size ?? 0;
    const x = speedAxis();
    const named = bands(x.range[0], top);
    const diverged = rows.filter(({ status }) => status === "diverged");
    const crosses = {
      x: shown(diverged.map((row) => row.peak_speed_rad_s)), y: diverged.map((row) => Math.min(row.frequency ?? top, top)),
      name: "diverged", mode: "markers", cliponaxis: false, customdata: diverged, hoverinfo: "text",
      text: diverged.map((row) => `${row.blade} diverged<br>${speedText(row.peak_speed_rad_s)}`),
      marker: { symbol: "x", size: 9, color: theme.colour("warning") },
    };
    const traces = data.blades.map((blade) => trace(circles.filter((row) => row.blade === blade), blade, largest))
      .filter(({ x: places }) => places.length);
    const plan = layout(x, axis("frequency (Hz)", { range: [0, top] }), { margin: { l: 60, r: 30, t: 10, b: 45 } });
    Object.assign(plan.legend, { itemsizing: "constant", y: 1.06 });
    const [lines, numbers] = page.orderTraces(NAME, x.range, [0, top]);
    const marks = [...named.map(({ band }) => band), ...traces, ...(diverged.length ? [crosses] : [])];
    draw(NAME, [{ ...lines, showlegend: false }, ...marks, numbers], plan, false);
    page.followView(NAME);
    const none = { text: "no interaction was found", xref: "paper", x: 0.5, yref: "paper", y: 0.5, showarrow: false };
    const annotations = [...named.map(({ name }) => name), ...(rows.length ? labels(circles, largest) : [none])];
    Plotly.relayout(NAME, { annotations });
    drawKey(circles, rows.filter((row) => !circles.includes(row) && !diverged.includes(row)).length);
    const place = document.getElementById(NAME);
    if (place.dataset.chooses) return;
    place.dataset.chooses = "yes";
    place.on("plotly_click", ({ points: [{ x: at, customdata: row }] }) => {
      page.set(row ? { blade: row.blade, scene: row.scene, speed: row.peak_speed_rad_s } : { speed: at / factor() });
    });
  };
};
