// designs over two numbers that vary: length above yield in most revolutions, of the family that the chosen blade or scene is of; a click
// chooses a design
panels.designs = (families, page) => {
  const { state, digits, axis, layout, draw } = page;
  const distinct = (place, rows) => [...new Set(rows.map((row) => row[place]))].sort((one, other) => one - other);
  const axisOf = (key) => (key.endsWith("_m") ? [`${key.slice(0, -2)} (mm)`, 1e3] : [key, 1]);
  const isOf = (other) => ([blade, scene]) => other === "" || (other === "blade" ? blade === state.blade : scene === state.scene);
  let cellAt = null;

  function chosen() {
    const shown = families.map(({ cells, values, ...family }) => ({
      ...family, rows: cells.map((cell, at) => [...cell, values.values[at]]),
    }));
    const own = shown.find(({ rows }) => rows.some(([blade, scene]) => blade === state.blade && scene === state.scene));
    return own ?? shown[0];
  }

  function map() {
    const { family, keys, other, rows: all } = chosen();
    const rows = all.filter(isOf(other));
    if (!rows.length) return draw("designs", [], null);
    const [across, up] = [distinct(2, rows), distinct(3, rows)];
    cellAt = (column, row) => rows.find((cell) => cell[2] === across[column] && cell[3] === up[row]);
    const grid = (value) => up.map((_, row) => across.map((__, column) => {
      const cell = cellAt(column, row);
      return cell ? value(cell) : null;
    }));
    const [[acrossTitle, acrossFactor], [upTitle, upFactor]] = keys.map(axisOf);
    const trace = {
      type: "heatmap", x: across.map((value) => digits(acrossFactor * value, 4)), y: up.map((value) => digits(upFactor * value, 4)),
      z: grid((cell) => cell[4]), zmin: 0, colorscale: page.MAGMA, zsmooth: false, hoverinfo: "text", texttemplate: "%{z:.0f}",
      text: grid(([blade, scene, , , length]) => `${blade} in ${scene}<br>${digits(length, 3)} rad/s above yield in most revolutions`),
      colorbar: { title: { text: `${family}: above yield (rad/s)`, side: "right" }, thickness: 12 },
    };
    const plan = layout(axis(acrossTitle, { type: "category" }), axis(upTitle, { type: "category" }), { shapes: [], showlegend: false });
    draw("designs", [trace], plan, false);
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
