// the first panel of a run with requirements: what each blade and scene keeps in operation, and the requirements of the chosen pair
panels.requirements = ({ pairs, requirements }, page) => {
  const { state, digits, speedText } = page;
  const cell = (row, text, className = "") => Object.assign(row.insertCell(), { textContent: text, className });
  const heads = (table, titles) => table.createTHead().insertRow().append(
    ...titles.map((text) => Object.assign(document.createElement("th"), { scope: "col", textContent: text })),
  );
  const number = (value, unit) => (value === null ? "" : `${digits(value, 3)} ${unit === "1" ? "" : unit}`);
  const where = ({ from_rad_s: from, to_rad_s: to }) => {
    if (from === null) return "";
    return from === to ? speedText(from) : `${speedText(from)} to ${speedText(to)}`;
  };

  function all() {
    const table = document.createElement("table");
    heads(table, ["blade", "scene", "verdict", "why"]);
    const body = table.createTBody();
    for (const { blade, scene, verdict, reason } of pairs) {
      const row = body.insertRow();
      row.addEventListener("click", () => page.set({ blade, scene }));
      const choose = Object.assign(document.createElement("button"), { type: "button", className: "choose", textContent: blade });
      row.insertCell().append(choose);
      cell(row, scene);
      cell(row, verdict, verdict);
      cell(row, reason);
      if (blade === state.blade && scene === state.scene) row.className = "chosen";
    }
    document.getElementById("verdict").replaceChildren(table);
  }

  function chosen() {
    const table = document.createElement("table");
    heads(table, ["requirement", "verdict", "value", "limit", "margin", "where", "certainty"]);
    const body = table.createTBody();
    for (const line of requirements.filter(({ blade, scene }) => blade === state.blade && scene === state.scene)) {
      const row = body.insertRow();
      cell(row, line.requirement);
      cell(row, line.verdict, line.verdict);
      cell(row, line.value === null ? line.note ?? "" : number(line.value, line.unit));
      cell(row, number(line.limit, line.unit));
      cell(row, number(line.margin, line.unit));
      cell(row, where(line));
      cell(row, line.certainty);
    }
    document.getElementById("verdict_of_pair").replaceChildren(table);
  }

  return {
    verdict_of_pair: { title: "Requirements of the chosen blade and scene", draw: chosen, of: ["blade", "scene", "unit"], first: true },
    verdict: { title: "Verdict", draw: all, of: ["blade", "scene"], first: true },
  };
};
