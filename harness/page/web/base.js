// The data of the page and functions that the other scripts use. The texts of the results reach the page only as text
// nodes and attribute values, never as HTML.
"use strict";

const page = (() => {
  document.documentElement.classList.add("js");
  const data = JSON.parse(document.getElementById("data").textContent);

  /** Returns a new element. A function in `attributes` is an event listener; null leaves an attribute out. */
  function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
      if (typeof value === "function") made.addEventListener(name, value);
      else if (value !== null) made.setAttribute(name, value);
    }
    made.append(...children);
    return made;
  }

  /** Lets the browser save a text as a file. */
  function save(name, text) {
    const url = URL.createObjectURL(new Blob([text], {type: "text/plain;charset=utf-8"}));
    element("a", {href: url, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(url), 1000);
  }

  /** Returns one line of CSV. Texts that a spreadsheet could read as a formula get an apostrophe. */
  function csvLine(fields) {
    return fields.map(field => {
      let text = field === null || field === undefined ? "" : String(field);
      if (typeof field === "string" && /^[=+@\t\r-]/.test(text)) text = "'" + text;
      return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
    }).join(",") + "\n";
  }

  /** Returns the number with three significant digits; numbers from 1000 keep their digits before the point. */
  function digits(value) {
    if (typeof value !== "number") return String(value ?? "");
    if (value === 0) return "0";
    const size = Math.abs(value);
    if (size >= 1000) return size < 1e7 ? Math.round(value).toString() : value.toExponential(2);
    return size < 1e-4 ? value.toExponential(2) : Number(value.toPrecision(3)).toString();
  }

  /** Returns the index of the report that contains the element. */
  function partOf(inside) {
    return Number(inside.closest("[data-part]").dataset.part);
  }

  function median(values) {
    const sorted = [...values].sort((a, b) => a - b), half = sorted.length >> 1;
    return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  }

  // On wide screens, the contents stand beside the text. On others, they would fill the first screen.
  document.querySelector("#contents details").open = matchMedia("(min-width: 100rem)").matches;

  document.addEventListener("click", event => {
    const button = event.target.closest("button[data-file]");
    if (!button) return;
    const name = button.dataset.file;
    if (name === "rows.jsonl") save(name, data.rows.map(row => JSON.stringify(row) + "\n").join(""));
    else save(name, data.parts[partOf(button)].files[name]);
  });

  return {data, element, save, csvLine, digits, partOf, median};
})();
