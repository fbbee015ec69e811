// The pictures: a wipe between two of them.
"use strict";

(() => {
  const {data, element} = page, place = document.getElementById("wipe");
  if (!place) return;

  const pictures = [...document.querySelectorAll("figure[data-picture]")].map((figure, index) => {
    const part = Number(figure.dataset.part), cell = data.parts[part].cells[Number(figure.dataset.picture)];
    const row = data.rows[cell.rows[0]];
    return {index, part, figure, cell, image: figure.querySelector("img"), label: figure.querySelector("figcaption").textContent,
      experiment: cell.experiment, variant: row.variant, axes: row.axes};
  });
  const shape = picture => Math.round(100 * picture.image.getAttribute("width") / picture.image.getAttribute("height"));

  /** How well two pictures compare: the number of equal axes, above all the model; other variants of a case are better
   * than other cases. */
  function likeness(a, b) {
    if (a === b || shape(a) !== shape(b)) return -1;
    const names = Object.keys(a.axes).filter(name => name !== "variant");
    const equal = names.filter(name => a.axes[name] === b.axes[name]).length;
    return 4 * equal + 8 * (a.axes.model === b.axes.model) + 2 * (a.variant !== b.variant) + (a.experiment === b.experiment);
  }
  const best = a => pictures.reduce((found, b) => likeness(a, b) > likeness(a, found) ? b : found, pictures[0]);

  function choices(label, change) {
    const select = element("select", {"aria-label": label, change});
    const groups = new Map();
    for (const picture of pictures) {
      if (!groups.has(picture.experiment)) groups.set(picture.experiment, element("optgroup", {label: picture.experiment}));
      groups.get(picture.experiment).append(element("option", {value: picture.index}, picture.cell.label));
    }
    select.append(...groups.values());
    return select;
  }

  const lower = element("img", {alt: ""}), upper = element("img", {alt: "", class: "upper"});
  const line = element("div", {class: "line"}), stage = element("div", {class: "stage"}, lower, upper, line);
  const range = element("input", {type: "range", min: 0, max: 100, step: 0.5, value: 50,
    "aria-label": "Position of the line between the two pictures", input: move});
  const left = choices("Left picture", show), right = choices("Right picture", show);

  function move() {
    upper.style.clipPath = `inset(0 0 0 ${range.value}%)`;
    line.style.left = `${range.value}%`;
  }
  function show() {
    const [a, b] = [pictures[left.value], pictures[right.value]];
    [lower.src, lower.alt] = [a.image.src, a.label];
    [upper.src, upper.alt] = [b.image.src, b.label];
    stage.style.aspectRatio = `${a.image.getAttribute("width")} / ${a.image.getAttribute("height")}`;
    move();
  }
  function choose(picture, other = best(picture)) {
    left.value = picture.index;
    right.value = other.index;
    show();
  }
  function drag(event) {
    if (event.type === "pointerdown") stage.setPointerCapture(event.pointerId);
    else if (!stage.hasPointerCapture(event.pointerId)) return;
    const box = stage.getBoundingClientRect();
    range.value = 100 * (event.clientX - box.left) / box.width;
    move();
  }
  stage.addEventListener("pointerdown", drag);
  stage.addEventListener("pointermove", drag);

  place.append(
    element("p", {class: "soft"}, "Compare two pictures: move the line with the slider, or drag it on the picture."),
    element("div", {class: "pair"}, left, right), stage, range);
  for (const picture of pictures)
    picture.figure.append(element("p", {class: "buttons"},
      element("button", {type: "button", click: () => { choose(picture); place.scrollIntoView(); }}, "Compare"),
      element("button", {type: "button", click: () => rows.openCells(picture.part, [Number(picture.figure.dataset.picture)],
        Number(picture.figure.dataset.picture))}, "Row")));
  const start = pictures.reduce((a, b) => likeness(b, best(b)) > likeness(a, best(a)) ? b : a, pictures[0]);
  choose(start);
})();
