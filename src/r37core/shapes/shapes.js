(() => {
  const { shapes, explorer_in_report: explorer } = JSON.parse(document.getElementById("data").textContent);
  // the archive of Snakemake's report has each page in a folder of its own, and no files beside it
  const IN_REPORT = /\/data\/raw\/[0-9a-f]+\/[^/]+$/.test(window.location.pathname);
  // plotly's own choice has a button that uploads
  const OPTIONS = { responsive: true, displaylogo: false, displayModeBar: true, modeBarButtons: [["toImage", "resetCameraDefault3d"]] };
  const plot = document.getElementById("shape");
  const which = document.getElementById("which");
  const phase = document.getElementById("phase");
  const state = { shape: null, time: 0, playing: !window.matchMedia("(prefers-reduced-motion: reduce)").matches, last: null };

  // the parts of a .glb file that src/r37core/shapes/gltf.py writes, turned back to the blade's axes
  function read(base64) {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const length = new DataView(bytes.buffer).getUint32(12, true);
    const content = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
    const array = (number) => {
      const { bufferView, componentType, count, type } = content.accessors[number];
      const kind = { 5126: Float32Array, 5125: Uint32Array }[componentType];
      const width = { SCALAR: 1, VEC3: 3 }[type];
      return new kind(bytes.slice(28 + length + content.bufferViews[bufferView].byteOffset).buffer, 0, count * width);
    };
    const columns = (values) => [1, 2, 0].map((axis) => Float32Array.from({ length: values.length / 3 }, (_, at) => values[3 * at + axis]));
    const [primitive] = content.meshes[0].primitives;
    const [sampler] = content.animations[0].samplers;
    const triangles = array(primitive.indices);
    return {
      points: columns(array(primitive.attributes.POSITION)),
      targets: primitive.targets.map((target) => columns(array(target.POSITION))),
      corners: [0, 1, 2].map((corner) => Array.from({ length: triangles.length / 3 }, (_, at) => triangles[3 * at + corner])),
      values: array(primitive.attributes._VALUE), times: array(sampler.input), weights: array(sampler.output),
    };
  }

  const duration = () => state.shape.times[state.shape.times.length - 1];

  // coordinates at a time, weights interpolated as glTF viewers do
  function moved(shape, time) {
    const { points, targets, times, weights } = shape;
    let after = 1;
    while (after < times.length - 1 && times[after] < time) after += 1;
    const share = Math.min(Math.max((time - times[after - 1]) / (times[after] - times[after - 1]), 0), 1);
    const now = targets.map((_, k) => (1 - share) * weights[(after - 1) * targets.length + k] + share * weights[after * targets.length + k]);
    return points.map((column, axis) => column.map((value, at) => targets.reduce((sum, target, k) => sum + now[k] * target[axis][at], value)));
  }

  function draw() {
    const { shape } = state;
    const scale = shape.unit === "Pa" ? 1e-6 : 1;
    const unit = shape.unit === "Pa" ? " (MPa)" : "";
    const [x, y, z] = moved(shape, state.time);
    const values = shape.values.map((value) => scale * value);
    const trace = {
      type: "mesh3d", x, y, z, i: shape.corners[0], j: shape.corners[1], k: shape.corners[2], intensity: values,
      cmin: 0, cmax: scale * shape.largest_shown, colorscale: "Viridis", flatshading: false, hoverinfo: "text",
      text: Array.from(values, (value) => `${Number(value.toPrecision(4))}${unit}`),
      lighting: { ambient: 0.75, diffuse: 0.4, specular: 0.05 }, colorbar: { title: { text: shape.quantity + unit, side: "right" }, thickness: 14 },
    };
    const pad = 0.12 * (Math.max(...shape.points[0]) - Math.min(...shape.points[0]));
    const range = (axis) => [Math.min(...shape.points[axis]) - pad, Math.max(...shape.points[axis]) + pad];
    const axis = (name, number) => ({ ...theme.axis(), title: { text: name }, range: range(number), showspikes: false });
    const layout = {
      ...theme.layout(), margin: { l: 0, r: 0, t: 0, b: 0 }, uirevision: "blade",
      scene: {
        xaxis: axis("x", 0), yaxis: axis("y", 1), zaxis: axis("z", 2), aspectmode: "data", uirevision: "blade",
        camera: { up: { x: 1, y: 0, z: 0 }, eye: { x: 0.6, y: -1.5, z: -0.5 } },
      },
    };
    document.getElementById("now").textContent = shape.title;
    document.getElementById("files").replaceChildren("Files: ", ...links(shape));
    return Plotly.react(plot, [trace], layout, OPTIONS);
  }

  function links({ files, glb }) {
    const inside = { href: `data:model/gltf-binary;base64,${glb}`, download: files[0].split("/").pop(), textContent: files[0] };
    const all = IN_REPORT ? [inside] : files.map((file) => ({ href: file, textContent: file }));
    return all.flatMap((about) => [Object.assign(document.createElement("a"), about), " "]);
  }

  function place() {
    phase.value = state.time / duration();
    const [x, y, z] = moved(state.shape, state.time);
    return Plotly.restyle(plot, { x: [x], y: [y], z: [z] }, [0]);
  }

  function choose(number) {
    const entry = shapes[(number + shapes.length) % shapes.length];
    state.shape = { ...entry, ...read(entry.glb) };
    state.time = entry.worst_s || 0;
    which.value = String(shapes.indexOf(entry));
    window.history.replaceState(null, "", `#shape=${entry.name}`);
    return draw().then(place);
  }

  // by name, or the interaction of a scene nearest to a speed
  function wanted() {
    const words = new URLSearchParams(window.location.hash.slice(1));
    const named = shapes.findIndex((one) => one.name === words.get("shape"));
    if (named >= 0) return named;
    const off = shapes.map((one) => (one.scene === words.get("scene") ? Math.abs(one.speed_rad_s - Number(words.get("speed"))) : Infinity));
    const nearest = off.indexOf(Math.min(...off));
    return Number.isFinite(off[nearest]) ? nearest : 0;
  }

  const play = (on) => { state.playing = on; state.last = null; document.getElementById("play").textContent = on ? "Pause" : "Play"; };
  const move = (by) => { play(false); state.time = (state.time + by * duration() + duration()) % duration(); place(); };

  async function tick(now) {
    if (state.playing && state.last !== null) {
      state.time = (state.time + (now - state.last) / 1000) % duration();
      await place();
    }
    state.last = state.playing ? now : null;
    window.requestAnimationFrame(tick);
  }

  which.replaceChildren(...shapes.map((one, at) => new Option(one.title.split(":")[0], at)));
  which.addEventListener("change", () => choose(Number(which.value)));
  phase.addEventListener("input", () => { play(false); state.time = phase.valueAsNumber * duration(); place(); });
  document.getElementById("play").addEventListener("click", () => play(!state.playing));
  document.getElementById("controls").addEventListener("submit", (event) => event.preventDefault());
  // what a test may ask for: x, y and z of all points as they are drawn
  window.shown = () => ["x", "y", "z"].map((name) => Array.from(plot.data[0][name]));
  const KEYS = {
    ArrowDown: () => choose(Number(which.value) + 1), ArrowUp: () => choose(Number(which.value) - 1),
    ArrowLeft: () => move(-0.02), ArrowRight: () => move(0.02), " ": () => play(!state.playing),
  };
  document.addEventListener("keydown", (event) => {
    const typing = ["INPUT", "SELECT", "BUTTON"].includes(event.target.tagName);
    if (KEYS[event.key] && !typing && !event.ctrlKey && !event.metaKey && !event.altKey) { event.preventDefault(); KEYS[event.key](); }
  });
  window.addEventListener("hashchange", () => choose(wanted()));
  theme.onChange(() => draw().then(place));
  if (IN_REPORT) document.getElementById("explorer").href = encodeURI(explorer);
  play(state.playing);
  choose(wanted()).then(() => { document.documentElement.dataset.ready = "yes"; window.requestAnimationFrame(tick); });
})();
