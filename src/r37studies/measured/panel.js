// measurements of the chosen blade and scene: measured values with two standard deviations, and simulated ones at the same speeds or angles
panels.measured = (measurements, page) => {
  const { state, axis, speedAxis, layout, draw, colourOf, shown } = page;
  const own = () => measurements.filter(({ blade, scene }) => blade === state.blade && scene === state.scene);

  function curves() {
    const [first] = own();
    if (!first) return draw("measured", [], null);
    // those on another axis stand in the figures
    const together = own().filter((each) => each.axis === first.axis && each.unit === first.unit);
    const overAngle = first.axis === "angle_deg";
    const traces = together.flatMap((each, number) => {
      const places = Array.from(each[each.axis].values);
      const x = overAngle ? places : shown(places);
      const scaled = (values, factor) => Array.from(values, (value) => (Number.isFinite(value) ? factor * value : null));
      const factor = each.unit === "m" ? 1e3 : 1;
      const deviations = scaled(each.measured_uncertainty.values, 2 * factor);
      const color = colourOf(number);
      return [
        { x, y: scaled(each.simulated.values, factor), mode: "lines+markers", line: { color }, name: `simulated: ${each.title}`, hovertext: each.words },
        { x, y: scaled(each.measured.values, factor), error_y: { type: "data", array: deviations }, mode: "markers", marker: { color, symbol: "square-open" }, name: `measured: ${each.words.split("; ")[0]}` },
      ];
    });
    const unit = { m: " (mm)", "rad s-1": " (rad/s)" }[first.unit] ?? "";
    const across = overAngle ? axis("casing angle (degrees)") : speedAxis();
    return draw("measured", traces, layout(across, axis(`value${unit}`, { rangemode: "tozero" })), false);
  }

  return { measured: { title: "Measurements", draw: curves, of: ["blade", "scene", "unit"] } };
};
