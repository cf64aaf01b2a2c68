// words with a meaning, from the glossary in the data: a tooltip, and below the heading of their panel on a tap or by keyboard
const words = (() => {
  const shownIn = (element) => element.closest("section").querySelector(".meaning");
  const text = ({ title, meaning }) => `${title}: ${meaning}.`;
  // a button named by a word
  function button(word, label, act = () => {}) {
    const element = Object.assign(document.createElement("button"), { type: "button", className: "word", title: text(word) });
    element.textContent = label;
    const say = () => { shownIn(element).textContent = text(word); };
    element.addEventListener("focus", say);
    element.addEventListener("click", () => { say(); act(); });
    return element;
  }
  // with the unit in which it is shown; speeds are in that of the page
  const headed = ({ title, unit }, speedUnit) => (unit ? `${title} (${unit === "rad/s" ? speedUnit : unit})` : title);
  return { button, headed };
})();
