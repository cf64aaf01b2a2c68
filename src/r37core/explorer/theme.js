"use strict";
// light or dark, as the browser prefers: what plots take from the page's style
const theme = (() => {
  const preference = window.matchMedia("(prefers-color-scheme: dark)");
  const colour = (name) => window.getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return {
    colour,
    dark: () => preference.matches,
    // of a plot: plotly's own are those of white paper
    layout: () => ({
      paper_bgcolor: colour("background"), plot_bgcolor: colour("background"), font: { color: colour("text") },
      hoverlabel: { bordercolor: colour("text") },
      modebar: { bgcolor: "rgba(0,0,0,0)", color: colour("muted"), activecolor: colour("text") },
    }),
    axis: () => ({ gridcolor: colour("grid"), linecolor: colour("grid"), zerolinecolor: colour("grid") }),
    onChange: (draw) => preference.addEventListener("change", draw),
  };
})();
