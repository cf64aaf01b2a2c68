// the table of interactions: those of what is chosen, or all; sorted by a column
const drawInteractions = (() => {
  const heads = new Map();
  let lines = [];
  let unit = null;

  // rows without a number stay last, whichever way they are sorted
  function compare(name, descending) {
    return ({ row: one }, { row: other }) => {
      const [a, b] = [one[name] ?? null, other[name] ?? null];
      if (a === null || b === null) return Number(a === null) - Number(b === null);
      const order = typeof a === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true });
      return descending ? -order : order;
    };
  }

  // up, down, and back to the order of summary.csv
  const nextSort = (name, sort) => ({ [name]: `-${name}`, [`-${name}`]: "" })[sort] ?? name;

  function head(columns, page) {
    const line = document.createElement("tr");
    columns.forEach((column) => {
      const cell = Object.assign(document.createElement("th"), { scope: "col", className: column.name });
      cell.append(words.button(column, column.title, () => page.set({ sort: nextSort(column.name, page.state.sort) })));
      heads.set(column, cell);
      line.append(cell);
    });
    return line;
  }

  function lineOf(row, columns, { set, valueText, mark }) {
    const line = document.createElement("tr");
    line.tabIndex = 0;
    columns.forEach((column) => {
      const cell = line.insertCell();
      cell.className = column.name;
      cell.textContent = valueText(row, column) + mark(row, column);
    });
    const go = () => set({ blade: row.blade, scene: row.scene, speed: row.peak_speed_rad_s });
    line.addEventListener("click", go);
    line.addEventListener("keydown", (event) => { if (event.key === "Enter") go(); });
    return { row, line };
  }

  return function draw(data, page) {
    const { state } = page;
    const box = document.getElementById("interactions");
    const { columns } = data;
    if (!box.firstChild) {
      const table = document.createElement("table");
      table.createTHead().append(head(columns, page));
      table.createTBody();
      box.append(table);
    }
    if (unit !== state.unit) {
      unit = state.unit;
      lines = data.interactions.map((row) => lineOf(row, columns, page));
    }
    const descending = state.sort.startsWith("-");
    const by = state.sort.replace(/^-/, "");
    heads.forEach((cell, column) => {
      cell.firstChild.textContent = words.headed(column, unit);
      cell.ariaSort = column.name !== by ? "none" : descending ? "descending" : "ascending";
    });
    const shown = lines.filter(({ row }) => state.every || ((state.all || row.blade === state.blade) && row.scene === state.scene));
    if (by) shown.sort(compare(by, descending));
    const [table] = box.children;
    // what is the same in all rows is said once, above them
    table.classList.toggle("of-blade", !state.every && !state.all);
    table.classList.toggle("of-scene", !state.every);
    const { activeElement: focused } = document;
    table.tBodies[0].replaceChildren(...shown.map(({ line }) => line));
    if (focused?.isConnected) focused.focus({ preventScroll: true });
    table.hidden = shown.length === 0;
    // columns without a number in these rows take no room, nor do details
    columns.forEach((column, at) => {
      const hidden = (column.detail && !state.columns && by !== column.name) || shown.every(({ row }) => (row[column.name] ?? "") === "");
      [heads.get(column), ...shown.map(({ line }) => line.cells[at])].forEach((cell) => { cell.hidden = hidden; });
    });
    const where = `${state.all ? "all blades" : state.blade} in ${state.scene}`;
    document.getElementById("shown").textContent = state.every ? `all ${lines.length}` : `${shown.length || "none"} of ${where}`;

    lines.forEach(({ row, line }) => {
      line.classList.toggle("chosen", row.blade === state.blade && row.scene === state.scene && row.peak_speed_rad_s === state.speed);
    });
    // the chosen interaction, else the first of the chosen blade
    const chosen = table.querySelector(".chosen") ?? shown.find(({ row }) => row.blade === state.blade)?.line;
    const above = chosen ? chosen.offsetTop - box.scrollTop : 0;
    if (above < 0 || above + 2 * chosen?.offsetHeight > box.clientHeight) box.scrollTop = chosen.offsetTop - box.clientHeight / 2;
    return shown.map(({ row }) => row);
  };
})();
