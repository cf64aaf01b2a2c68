// designs over two numbers that vary, with the values of their figure, of the family that the chosen blade or scene is of; a click
// chooses a design. A length with unknown speeds has both ends of its bracket. Lines go round the designs that do not fail a requirement, and those that meet all have a mark
panels.designs = (families, page) => {
  const { state, digits, axis, layout, draw } = page;
  const distinct = (place, rows) => [...new Set(rows.map((row) => row[place]))].sort((one, other) => one - other);
  const isOf = (other) => ([blade, scene]) => other === "" || (other === "blade" ? blade === state.blade : scene === state.scene);
  let cellAt = null;

  function chosen() {
    const shown = families.map(({ cells, values, unknown, ...family }) => ({
      ...family, rows: cells.map((cell, at) => [...cell, values.values[at], unknown.values[at]]),
    }));
    const own = shown.find(({ rows }) => rows.some(([blade, scene]) => blade === state.blade && scene === state.scene));
    return own ?? shown[0];
  }

  const verdicts = (cell, name) => page.requirements
    .filter(({ blade, scene, requirement }) => cell && blade === cell[0] && scene === cell[1] && (name ?? requirement) === requirement)
    .map(({ verdict }) => verdict);
  const meets = (cell) => {
    const found = verdicts(cell);
    return found.length > 0 && found.every((verdict) => ["meets", "does not apply"].includes(verdict));
  };

  // sides of cells between designs that fail a requirement and others; none to cells without a design
  function limits(columns, rows) {
    return [...new Set(page.requirements.map(({ requirement }) => requirement))].flatMap((name, number) => {
      const keeps = (column, row) => {
        const [verdict] = verdicts(column < columns && row < rows ? cellAt(column, row) : null, name);
        return verdict === undefined ? null : verdict !== "fails";
      };
      const differ = (one, other) => one !== null && other !== null && one !== other;
      const sides = [];
      for (let row = 0; row < rows; row += 1) {
        for (let column = 0; column < columns; column += 1) {
          const here = keeps(column, row);
          if (differ(here, keeps(column + 1, row))) sides.push([column + 0.5, row - 0.5, column + 0.5, row + 0.5]);
          if (differ(here, keeps(column, row + 1))) sides.push([column - 0.5, row + 0.5, column + 0.5, row + 0.5]);
        }
      }
      const line = { color: page.colourOf(1 + number), width: 4, dash: number % 2 ? "dash" : "solid" };
      return sides.map(([x0, y0, x1, y1], side) => ({ type: "line", x0, y0, x1, y1, line, name: `limit of ${name.replaceAll("_", " ")}`, showlegend: side === 0 }));
    });
  }

  function map() {
    const { family, axes, other, label, digits: decimals, rows: all } = chosen();
    const rows = all.filter(isOf(other));
    if (!rows.length) return draw("designs", [], null);
    const [across, up] = [distinct(2, rows), distinct(3, rows)];
    cellAt = (column, row) => rows.find((cell) => cell[2] === across[column] && cell[3] === up[row]);
    const grid = (value) => up.map((_, row) => across.map((__, column) => {
      const cell = cellAt(column, row);
      return cell ? value(cell) : null;
    }));
    const [[acrossTitle, acrossFactor], [upTitle, upFactor]] = axes;
    const bracket = (value, unknown) => `${value.toFixed(decimals)}${unknown && !decimals ? ` to ${(value + unknown).toFixed(0)}` : ""}`;
    const marks = ([blade, scene]) => (meets([blade, scene]) ? " \u2713" : "");
    const trace = {
      type: "heatmap", x: across.map((value) => digits(acrossFactor * value, 4)), y: up.map((value) => digits(upFactor * value, 4)),
      z: grid((cell) => cell[4]), zmin: 0, colorscale: page.MAGMA, zsmooth: false, hoverinfo: "text", texttemplate: "%{text}",
      text: grid((cell) => (Number.isFinite(cell[4]) ? `${bracket(cell[4], cell[5])}${marks(cell)}` : "")),
      hovertext: grid(([blade, scene, , , value, unknown]) => `${blade} in ${scene}<br>${label}: ${digits(value, 3)}`
        + `${unknown ? `<br>unknown at ${digits(unknown, 3)} rad/s more: the model is left first ${page.causes(blade, scene)}` : ""}${meets([blade, scene]) ? "<br>meets all requirements" : ""}`),
      colorbar: { title: { text: `${family}: ${label}`, side: "right" }, thickness: 12 },
    };
    const plan = layout(axis(acrossTitle, { type: "category" }), axis(upTitle, { type: "category" }), {
      shapes: limits(across.length, up.length), showlegend: true,
    });
    const mark = (name) => ({ x: [null], y: [null], mode: "markers", marker: { color: "rgba(0,0,0,0)" }, name });
    draw("designs", [
      trace, ...(page.requirements.length ? [mark("\u2713 meets all requirements")] : []),
      ...(rows.some((cell) => cell[5]) ? [mark("... to ...: the model is left first at some speeds")] : []),
    ], plan, false);
    const place = document.getElementById("designs");
    if (place.dataset.chooses) return undefined;
    place.dataset.chooses = "yes";
    place.on("plotly_click", (event) => {
      const [column, row] = event.points[0].pointIndex.toReversed();
      const cell = cellAt(column, row);
      if (cell) page.set({ blade: cell[0], scene: cell[1] });
    });
    return undefined;
  }

  return { designs: { title: "Designs", draw: map, of: ["blade", "scene"] } };
};
