// The details of rows: status, checks, metrics, provenance and raw samples, in a dialog.
"use strict";

const rows = (() => {
  const {data, element} = page;
  const close = element("button", {type: "button", class: "close", click: () => dialog.close()}, "Close");
  const content = element("div", {class: "details"});
  const dialog = element("dialog", {id: "details", "aria-label": "Details of a case"}, close, content);
  dialog.addEventListener("click", event => { if (event.target === dialog) dialog.close(); });
  document.body.append(dialog);

  const shown = value => value === null || value === undefined ? ""
    : typeof value === "object" ? JSON.stringify(value) : String(value);

  function tableOf(head, lines) {
    return element("div", {class: "wide"}, element("table", {},
      element("thead", {}, element("tr", {}, ...head.map(text => element("th", {}, text)))),
      element("tbody", {}, ...lines.map(line => element("tr", {}, ...line.map(text => element("td", {}, shown(text))))))));
  }

  function fields(object) {
    return element("dl", {}, ...Object.entries(object).flatMap(([name, value]) =>
      [element("dt", {}, name), element("dd", {}, shown(value))]));
  }

  function folded(title, open, ...children) {
    return element("details", open ? {open: ""} : {}, element("summary", {}, title), ...children);
  }

  /** The lists of times of a row: [{phase, clock, times}]; whole frames first. */
  function samplesOf(row) {
    const lists = [];
    for (const [phase, clocks] of Object.entries(row.samples ?? {}))
      for (const [name, times] of Object.entries(clocks))
        if (times.length) lists.push({phase, clock: name.replace(/_ms$/, ""), times});
    return lists.sort((a, b) => (b.phase === "frame") - (a.phase === "frame"));
  }

  function samplesPart(row) {
    const lists = samplesOf(row);
    if (!lists.length) return [element("p", {class: "soft"}, "The row has no samples.")];
    const summary = tableOf(["phase", "clock", "samples", "median, ms", "least, ms", "most, ms"], lists.map(l =>
      [l.phase, l.clock, l.times.length, page.digits(page.median(l.times)), page.digits(Math.min(...l.times)),
        page.digits(Math.max(...l.times))]));
    const raw = lists.map(l => `${l.phase}, ${l.clock}, ms:\n${l.times.join(" ")}\n`).join("\n");
    const csv = page.csvLine(["phase", "clock", "sample", "ms"]) + lists.map(l =>
      l.times.map((ms, i) => page.csvLine([l.phase, l.clock, i, ms])).join("")).join("");
    const save = element("button", {type: "button", click: () => page.save(`${row.case}.csv`, csv)}, "Samples as CSV");
    return [summary, folded("Raw samples, in the order of measurement", true, element("pre", {class: "raw"}, raw)),
      element("p", {class: "buttons"}, save)];
  }

  function rowPart(row) {
    const {samples, check, metrics, provenance, identity, axes, overrides, ...rest} = row;
    return element("article", {},
      element("h3", {}, `${row.experiment}: ${row.case}`),
      element("p", {class: row.status === "ok" ? "soft" : "bad"},
        [row.status, row.reason, row.device].filter(Boolean).join(" · ")),
      ...samplesPart(row),
      folded("Provenance", true, fields(provenance ?? {})),
      folded("Checks", false, tableOf(["against", "metric", "value", "", "limit"],
        (check ?? []).map(c => [c.against, c.metric, page.digits(c.value), c.sense, page.digits(c.limit)]))),
      folded("Metrics", false, tableOf(["metric", "value", "unit"],
        Object.entries(metrics ?? {}).map(([name, m]) => [name, page.digits(m.value), m.unit]))),
      folded("Case and identity", false, fields({...axes, ...overrides, ...rest, ...identity})),
      element("p", {class: "buttons"}, element("button", {type: "button",
        click: () => page.save(`${row.case}.json`, JSON.stringify(row, null, 2) + "\n")}, "Row as JSON")));
  }

  /** Shows the details of the rows with these indices; `tabs` are other choices: [{label, rows}]. */
  function open(indices, tabs = []) {
    content.replaceChildren();
    if (tabs.length > 1)
      content.append(element("p", {class: "tabs"}, ...tabs.map(tab => element("button", {type: "button",
        "aria-pressed": String(tab.rows === indices), click: () => open(tab.rows, tabs)}, tab.label))));
    content.append(...indices.map(index => rowPart(data.rows[index])));
    if (!dialog.open) dialog.showModal();
    dialog.scrollTop = 0;
  }

  function openCells(part, cells, first) {
    const tabs = cells.map(cell => ({label: data.parts[part].cells[cell].label, rows: data.parts[part].cells[cell].rows}));
    open(tabs[cells.indexOf(first)].rows, tabs);
  }

  /** The cells of the reports that a line of a table shows. */
  const cellsOf = line => [...new Set([...line.querySelectorAll("td[data-cell]")].map(td => Number(td.dataset.cell)))];

  for (const line of document.querySelectorAll("main tbody tr")) {
    if (line.dataset.row === undefined && !cellsOf(line).length) continue;
    line.classList.add("opens");
    const key = line.cells[0], button = element("button", {type: "button", class: "open"});
    button.append(...key.childNodes);
    key.append(button);
  }
  document.querySelector("main").addEventListener("click", event => {
    const line = event.target.closest("tr.opens");
    if (!line || String(getSelection())) return;
    if (line.dataset.row !== undefined) { open([Number(line.dataset.row)]); return; }
    const cells = cellsOf(line), own = event.target.closest("td[data-cell]");
    const key = own && own !== line.cells[0];
    openCells(page.partOf(line), cells, key ? Number(own.dataset.cell) : cells[0]);
  });

  return {open, openCells};
})();
