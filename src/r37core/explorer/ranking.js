// the first panel: which blade? Two bars for each blade and scene, above yield in most and in some revolutions, and the other numbers
const drawRanking = (() => {
  const KINDS = { length_most_revolutions_rad_s: "certain", length_some_revolutions_rad_s: "possible" };
  const element = (tag, className, text = "") => Object.assign(document.createElement(tag), { className, textContent: text });
  const heading = (scope, ...content) => {
    const cell = Object.assign(document.createElement("th"), { scope });
    cell.append(...content);
    return cell;
  };
  let drawn = null;

  const rowOf = (data, blade, scene) => data.ranking.find((row) => row.blade === blade && row.scene === scene);
  const barsOf = (data) => data.ranking_columns.filter(({ name }) => name in KINDS);
  const scenesOf = (data) => data.scenes.filter((scene) => data.ranking.some((row) => row.scene === scene));

  // rows are by scene, contact and rank
  const bladesOf = (data) => [...new Set(data.ranking.map(({ blade }) => blade))];

  // from the left end to a value, with the range of the members on it; the `longest` of the scene fills the line
  function bar(row, name, longest) {
    const share = (value) => `${(100 * value) / longest}%`;
    const line = element("span", "bar");
    const filled = element("span", KINDS[name]);
    filled.style.width = share(row[name] ?? 0);
    line.append(filled);
    const [low, high] = [row[`${name}_low`], row[`${name}_high`]];
    if (Number.isFinite(low) && Number.isFinite(high)) {
      const range = element("span", "range");
      range.style.left = share(low);
      range.style.width = share(high - low);
      line.append(range);
    }
    return line;
  }

  function tableOfBars(data, { set, valueText }) {
    const bars = barsOf(data);
    const ranked = data.ranking_columns.some(({ name }) => name === "rank");
    // scenes differ by an order of magnitude: each has its own scale
    const longest = (scene) => Math.max(Number.MIN_VALUE, ...data.ranking.filter((row) => row.scene === scene)
      .flatMap((row) => bars.flatMap(({ name }) => [row[name], row[`${name}_high`]])).filter(Number.isFinite));
    const table = document.createElement("table");
    table.createTHead().insertRow().append(...["blade", ...scenesOf(data)].map((text) => heading("col", text)));
    const body = table.createTBody();
    bladesOf(data).forEach((blade) => {
      const line = body.insertRow();
      line.dataset.blade = blade;
      line.addEventListener("click", ({ target }) => {
        const { scene } = target.closest("td")?.dataset ?? {};
        set({ blade, ...(scene && { scene }) });
      });
      line.append(heading("row", Object.assign(element("button", "choose", blade), { type: "button" })));
      scenesOf(data).forEach((scene) => {
        const cell = line.insertCell();
        const row = rowOf(data, blade, scene);
        cell.dataset.scene = scene;
        if (!row) return;
        if (ranked) cell.append(element("span", "rank", `${row.rank ?? ""}`));
        const lines = element("span", "bars");
        lines.append(...bars.map(({ name }) => bar(row, name, longest(scene))));
        cell.append(lines, element("span", "numbers", bars.map((column) => valueText(row, column) || "no stress").join(" / ")));
      });
    });
    return table;
  }

  function keys(data, unit) {
    const ofBars = barsOf(data).map((column) => {
      const key = element("span", "key");
      key.append(element("span", KINDS[column.name]), words.button(column, words.headed(column, unit)));
      return key;
    });
    const rank = data.ranking_columns.find(({ name }) => name === "rank");
    return [...(rank ? [words.button(rank, rank.title)] : []), ...ofBars];
  }

  // what else is known of a blade, a line for each number
  function tableOfNumbers(data, { state, valueText }) {
    const value = (scene, column) => valueText(rowOf(data, state.blade, scene) ?? {}, column);
    const table = document.createElement("table");
    table.createTHead().insertRow().append(...["", ...scenesOf(data)].map((text) => heading("col", text)));
    const body = table.createTBody();
    data.ranking_columns.forEach((column) => {
      const texts = scenesOf(data).map((scene) => value(scene, column));
      if (!texts.some(Boolean)) return;
      const line = body.insertRow();
      line.append(heading("row", words.button(column, words.headed(column, state.unit))));
      texts.forEach((text) => { line.insertCell().textContent = text; });
    });
    return table;
  }

  return function draw(data, page) {
    const panel = document.getElementById("ranking");
    panel.hidden = !data.ranking;
    if (!data.ranking) return;
    const { state } = page;
    if (drawn !== state.unit) {
      drawn = state.unit;
      document.getElementById("bars").replaceChildren(tableOfBars(data, page));
      document.getElementById("keys").replaceChildren(...keys(data, state.unit));
    }
    panel.querySelectorAll("#bars tbody tr").forEach((line) => {
      line.classList.toggle("chosen", line.dataset.blade === state.blade);
      line.querySelectorAll("td").forEach((cell) => cell.classList.toggle("here", cell.dataset.scene === state.scene));
    });
    document.getElementById("numbers-of").textContent = `All numbers of ${state.blade}`;
    document.getElementById("numbers").replaceChildren(tableOfNumbers(data, page));
  };
})();
