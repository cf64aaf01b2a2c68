// the first panel: which blade? Bars for each blade and scene, above yield in most revolutions, in some and ever; thin ones by the worst
// motion and, with a limit to compare it to, in operation; and the other numbers
const drawRanking = (() => {
  const KINDS = { length_most_revolutions_rad_s: "certain", length_some_revolutions_rad_s: "possible", length_ever_rad_s: "ever" };
  const [WORST, REST, OPERATING] = ["worst", "rest", "operating"].map((name) => `length_most_revolutions_${name}_rad_s`);
  const THIN = { [WORST]: "worst", [OPERATING]: "inside" };
  const element = (tag, className, text = "") => Object.assign(document.createElement(tag), { className, textContent: text });
  const heading = (scope, ...content) => {
    const cell = Object.assign(document.createElement("th"), { scope });
    cell.append(...content);
    return cell;
  };
  let drawn = null;

  // blades that cannot be told apart share a rank
  const rankOf = (data, { scene, contact, rank }) => {
    const tied = data.ranking.filter((row) => row.scene === scene && row.contact === contact && row.rank === rank).length > 1;
    return rank === null ? "" : `${rank}${tied ? " =" : ""}`;
  };
  const rowOf = (data, blade, scene) => data.ranking.find((row) => row.blade === blade && row.scene === scene);
  const barsOf = (data) => data.ranking_columns.filter(({ name }) => name in KINDS);
  // the limit (rad/s) of the length in operation, of a run with requirements
  const limitOf = ({ requirements }) => requirements.find(({ requirement }) => requirement === "above_yield")?.limit ?? null;
  const thinOf = (data, page) => data.ranking_columns
    .filter(({ name }) => name in THIN && (name !== OPERATING || limitOf(page) !== null) && data.ranking.some((row) => row[name] !== null));
  const scenesOf = (data) => data.scenes.filter((scene) => data.ranking.some((row) => row.scene === scene));

  // rows are by scene, contact and rank
  const bladesOf = (data) => [...new Set(data.ranking.map(({ blade }) => blade))];

  // from the left end to a value, with the range of the members on it, or the value from rest or the limit that it is compared to; the
  // `longest` of the scene fills the line
  function bar(row, name, longest, limit) {
    const share = (value) => `${(100 * value) / longest}%`;
    const line = element("span", name in THIN ? "bar thin" : "bar");
    const filled = element("span", KINDS[name] ?? THIN[name]);
    const tick = { [WORST]: ["rest", row[REST]], [OPERATING]: ["limit", limit] }[name];
    if (tick && Number.isFinite(tick[1]) && tick[1] <= longest) {
      const mark = element("span", tick[0]);
      mark.style.left = share(tick[1]);
      line.append(mark);
    }
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

  function tableOfBars(data, page) {
    const { set, valueText } = page;
    const [bars, thin, limit] = [barsOf(data), thinOf(data, page), limitOf(page)];
    const ranked = data.ranking_columns.some(({ name }) => name === "rank");
    // scenes differ by an order of magnitude: each has its own scale
    const longest = (scene) => Math.max(Number.MIN_VALUE, ...data.ranking.filter((row) => row.scene === scene)
      .flatMap((row) => [...bars, ...thin].flatMap(({ name }) => [row[name], row[`${name}_high`], row[REST]])).filter(Number.isFinite));
    // with its limit, unless that is far off
    const scale = (scene) => (limit !== null && limit < 3 * longest(scene) ? Math.max(limit * 1.02, longest(scene)) : longest(scene));
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
        if (ranked) cell.append(element("span", "rank", rankOf(data, row)));
        const lines = element("span", "bars");
        lines.append(...[...bars, ...thin].map(({ name }) => bar(row, name, scale(scene), limit)));
        cell.append(lines, element("span", "numbers", bars.map((column) => valueText(row, column) || "no stress").join(" / ")));
      });
    });
    return table;
  }

  function keys(data, page) {
    const { unit } = page.state;
    const key = (className, column) => {
      const entry = element("span", "key");
      entry.append(element("span", className), words.button(column, words.headed(column, unit)));
      return entry;
    };
    const thin = thinOf(data, page);
    const of = (name) => data.ranking_columns.find((column) => column.name === name);
    const limit = { title: "limit in operation", meaning: "the longest that requirements.above_yield_at_most_rad_s allows", unit: "rad/s" };
    return [
      ...(of("rank") ? [words.button(of("rank"), of("rank").title)] : []),
      ...barsOf(data).map((column) => key(KINDS[column.name], column)),
      ...thin.map((column) => key(THIN[column.name], column)),
      ...(thin.includes(of(WORST)) && of(REST) ? [key("rest", of(REST))] : []),
      ...(thin.includes(of(OPERATING)) ? [key("limit", limit)] : []),
    ];
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
      document.getElementById("keys").replaceChildren(...keys(data, page));
    }
    panel.querySelectorAll("#bars tbody tr").forEach((line) => {
      line.classList.toggle("chosen", line.dataset.blade === state.blade);
      line.querySelectorAll("td").forEach((cell) => cell.classList.toggle("here", cell.dataset.scene === state.scene));
    });
    document.getElementById("numbers-of").textContent = `All numbers of ${state.blade}`;
    document.getElementById("numbers").replaceChildren(tableOfNumbers(data, page));
  };
})();
