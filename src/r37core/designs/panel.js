// designs over two numbers that vary: length above yield in most revolutions, of the chosen blade or scene; a click chooses a design
panels.designs = ({ keys, cells, values, axis: of }, page) => {
  const { state, digits, axis, layout, draw } = page;
  const distinct = (place, rows) => [...new Set(rows.map((row) => row[place]))].sort((one, other) => one - other);
  const text = (value) => digits(value, 4);

  function map() {
    const rows = cells.map((cell, at) => [...cell, values.values[at]])
      .filter(([blade, scene]) => of === "" || (of === "blade" ? blade === state.blade : scene === state.scene));
    if (!rows.length) return draw("designs", [], null);
    const [across, up] = [distinct(2, rows), distinct(3, rows)];
    const cellAt = (x, y) => rows.find((row) => row[2] === x && row[3] === y);
    const grid = (of) => up.map((y) => across.map((x) => { const row = cellAt(x, y); return row ? of(row) : null; }));
    const trace = {
      type: "heatmap", x: across.map(text), y: up.map(text), z: grid((row) => row[4]), colorscale: page.MAGMA, zsmooth: false,
      text: grid(([blade, scene, , , length]) => `${blade} in ${scene}<br>${digits(length, 3)} rad/s above yield in most revolutions`),
      hoverinfo: "text", texttemplate: "%{z:.0f}", colorbar: { title: { text: "above yield (rad/s)", side: "right" }, thickness: 12 },
    };
    const plan = layout(axis(keys[0], { type: "category" }), axis(keys[1], { type: "category" }), { shapes: [], showlegend: false });
    draw("designs", [trace], plan, false);
    const place = document.getElementById("designs");
    if (place.dataset.chooses) return undefined;
    place.dataset.chooses = "yes";
    place.on("plotly_click", (event) => {
      const [column, row] = event.points[0].pointIndex.toReversed();
      const found = cellAt(across[column], up[row]);
      if (found) page.set({ blade: found[0], scene: found[1] });
    });
    return undefined;
  }

  return { designs: { title: "Designs", draw: map, of: ["blade", "scene"] } };
};
