// Sorting of the tables by a click on a heading, and the filter of the table of all rows.
"use strict";

(() => {
  /** Returns what the page sorts a cell by: its exact value if it has one, else its text. */
  function sortText(cell) {
    if (!cell) return "";
    const text = (cell.dataset.sort ?? cell.textContent).trim();
    return text === "–" || text === "-" ? "" : text;
  }

  /** Orders numbers by value and other texts by the numbers in them. Empty texts come last in both directions. */
  function compare(a, b, direction) {
    if (a === "" || b === "") return (a === "") - (b === "");
    const x = Number(a), y = Number(b);
    const order = Number.isNaN(x) || Number.isNaN(y) ? a.localeCompare(b, "en", {numeric: true}) : x - y;
    return direction * order;
  }

  function sort(table, heads, column) {
    const direction = heads[column].getAttribute("aria-sort") === "ascending" ? -1 : 1;
    heads.forEach(head => head.removeAttribute("aria-sort"));
    heads[column].setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
    const body = table.tBodies[0];
    const lines = [...body.rows].map(row => ({row, text: sortText(row.cells[column])}));
    lines.sort((a, b) => compare(a.text, b.text, direction));
    body.append(...lines.map(line => line.row));
  }

  for (const table of document.querySelectorAll("main table")) {
    const heads = [...table.tHead.rows[table.tHead.rows.length - 1].cells];
    heads.forEach((head, column) => {
      const button = page.element("button", {type: "button", class: "sort", click: () => sort(table, heads, column)});
      button.append(...head.childNodes);
      if (!button.textContent.trim()) button.setAttribute("aria-label", `column ${column + 1}`);
      head.append(button);
    });
  }

  const filter = document.getElementById("filter"), rows = document.getElementById("rows");
  function show() {
    const words = filter.value.toLowerCase().split(/\s+/);
    let count = 0;
    for (const row of rows.tBodies[0].rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every(word => text.includes(word));
      count += !row.hidden;
    }
    document.getElementById("shown").textContent = `${count} of ${rows.tBodies[0].rows.length} rows`;
  }
  if (filter) {   // the page of `pelage reproduce` has no list of all rows
    filter.addEventListener("input", show);
    show();
  }
})();
