// The plots: Chart.js draws them from the page's data when they come into view.
"use strict";

const charts = (() => {
  if (typeof Chart === "undefined") return null;
  const {data, element, digits} = page;
  // Colour-blind readers can distinguish these colours of Okabe and Ito. Lines beyond the seventh have other markers.
  // On a dark page they are lighter.
  const ON_LIGHT = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#777777"];
  const ON_DARK = ["#3F9BE0", "#F08040", "#2BBF92", "#DB94BC", "#9AD4F5", "#F2B632", "#AAAAAA"];
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const colour = index => (dark.matches ? ON_DARK : ON_LIGHT)[index % ON_LIGHT.length];
  const MARKERS = ["circle", "rect", "triangle", "rectRot", "crossRot", "star", "rectRounded"];
  const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const short = value => Math.abs(value) >= 1e6 ? `${digits(value / 1e6)}M`
    : Math.abs(value) >= 1e4 ? `${digits(value / 1e3)}k` : digits(value);

  /** Draws the intervals of the points, and the guide of the plot. */
  const intervals = {
    id: "intervals",
    afterDatasetsDraw(chart) {
      const {ctx, scales: {x, y}, chartArea} = chart;
      ctx.save();
      const guide = chart.options.plugins.intervals.guide;
      if (guide !== null) {
        ctx.strokeStyle = style("--soft");
        ctx.beginPath();
        ctx.moveTo(chartArea.left, y.getPixelForValue(guide));
        ctx.lineTo(chartArea.right, y.getPixelForValue(guide));
        ctx.stroke();
      }
      chart.data.datasets.forEach((set, i) => {
        if (!chart.isDatasetVisible(i)) return;
        ctx.strokeStyle = set.borderColor;
        for (const point of set.data) {
          if (point.low === null || point.high === null) continue;
          const at = x.getPixelForValue(point.x), low = y.getPixelForValue(point.low), high = y.getPixelForValue(point.high);
          ctx.beginPath();
          ctx.moveTo(at, low);
          ctx.lineTo(at, high);
          for (const end of [low, high]) { ctx.moveTo(at - 3, end); ctx.lineTo(at + 3, end); }
          ctx.stroke();
        }
      });
      ctx.restore();
    },
  };

  /** The text of a point when the pointer is near it. */
  function pointText(spec, line, point) {
    const atLeast = line.mark === "published" && point.low !== null && point.high === null;
    const interval = point.low !== null && point.high !== null ? ` [${digits(point.low)}, ${digits(point.high)}]` : "";
    return `${spec.yLabel}: ${atLeast ? "at least " : ""}${digits(point.y)}${interval}`;
  }

  const all = spec => spec.panels.flatMap(panel => panel.lines);
  const names = (spec, field) => [...new Set(all(spec).map(line => line[field]))];

  function datasets(spec, panel) {
    const keys = names(spec, "key"), labels = names(spec, "label");
    return panel.lines.map(line => {
      const index = keys.indexOf(line.key), own = colour(index);
      const shift = spec.categories.length ? 0.7 / labels.length * (labels.indexOf(line.label) - (labels.length - 1) / 2) : 0;
      const published = line.mark === "published";
      return {
        label: line.label, line, borderColor: own, backgroundColor: published ? style("--back") : own,
        pointStyle: MARKERS[(index + Math.floor(index / ON_LIGHT.length)) % MARKERS.length], radius: 3.5, hoverRadius: 6,
        borderWidth: 1.5, showLine: line.mark === "line" || (published && !spec.categories.length),
        borderDash: published ? [5, 4] : [],
        data: line.points.map(([x, y, low, high, cell]) => ({x: x + shift, value: x, y, low, high, cell})),
      };
    });
  }

  /** Returns the limits of y that all panels share. */
  function limits(spec) {
    const values = all(spec).flatMap(line => line.points.flatMap(([, y, low, high]) => [y, low ?? y, high ?? y]));
    if (spec.guide !== null) values.push(spec.guide);
    const least = Math.min(...values), most = Math.max(...values);
    if (spec.yScale === "log") return {min: least / 1.25, max: most * 1.25};
    return {min: least >= 0 ? 0 : least - 0.05 * (most - least), max: most + 0.05 * (most - Math.min(0, least))};
  }

  function scale(kind, title, more) {
    const soft = style("--soft"), line = style("--line");
    return {
      type: kind === "log" ? "logarithmic" : "linear", grid: {color: line, borderColor: soft},
      title: {display: title !== "", text: title, color: soft}, ...more,
      ticks: {color: soft, includeBounds: false, maxRotation: 55, autoSkipPadding: 6, callback: value => short(value), ...more.ticks},
    };
  }

  /** Returns about four evenly spaced numbers from least to most: multiples of 1, 2 or 5 times a power of ten. */
  function even(least, most) {
    const rough = (most - least) / 4, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find(factor => factor * power >= rough);
    const first = Math.ceil(least / step), count = Math.floor(most / step) - first + 1;
    return Array.from({length: count}, (_, i) => Number(((first + i) * step).toPrecision(12)));
  }

  /**
   * Ticks of a logarithmic scale: 1, 2 and 5 of each decade, or only 1 if there are many decades. If fewer than two of
   * these numbers lie on the scale, the ticks are evenly spaced numbers.
   */
  const decades = {afterBuildTicks: axis => {
    const kept = axis.max / axis.min > 3000 ? /^1e/ : /^[125]e/;
    const ticks = axis.ticks.filter(tick => tick.value >= axis.min && tick.value <= axis.max
      && kept.test(Number(tick.value.toPrecision(6)).toExponential()));
    axis.ticks = ticks.length > 1 ? ticks : even(axis.min, axis.max).map(value => ({value}));
  }};

  function scaleX(spec, panel) {
    const names = spec.categories;
    if (names.length)
      return scale("linear", "", {min: -0.6, max: names.length - 0.4, ticks: {autoSkip: false, callback: v => names[v] ?? ""},
        afterBuildTicks: axis => { axis.ticks = names.map((_, value) => ({value})); }});
    const values = [...new Set(panel.lines.flatMap(line => line.points.map(point => point[0])))].sort((a, b) => a - b);
    const log = spec.xScale === "log", least = values[0], most = values[values.length - 1];
    const room = log ? 1.1 : 0.04 * (most - least || 1);
    const limits = log ? {min: least / room, max: most * room} : {min: least - room, max: most + room};
    // The values themselves are the ticks if their labels do not overlap.
    const places = values.map(value => log ? Math.log(value / limits.min) / Math.log(limits.max / limits.min)
      : (value - limits.min) / (limits.max - limits.min));
    const apart = places.every((place, i) => i === 0 || place - places[i - 1] > 0.09);
    const ticks = apart ? {afterBuildTicks: axis => { axis.ticks = values.map(value => ({value})); }} : log ? decades : {};
    return scale(spec.xScale, panel.xLabel, {...limits, ...ticks});
  }

  function drawPanel(spec, part, panel, canvas) {
    return new Chart(canvas, {
      type: "scatter",
      data: {datasets: datasets(spec, panel)},
      plugins: [intervals],
      options: {
        animation: false, responsive: true, maintainAspectRatio: false,
        interaction: {mode: "nearest", intersect: false},
        onClick: (event, items, chart) => {
          if (!items.length) return;
          const {cell} = chart.data.datasets[items[0].datasetIndex].data[items[0].index];
          if (cell >= 0) rows.openCells(part, [cell], cell);
        },
        scales: {x: scaleX(spec, panel), y: scale(spec.yScale, spec.yLabel, {...limits(spec), ...(spec.yScale === "log" ? decades : {})})},
        plugins: {
          legend: {display: false}, intervals: {guide: spec.guide},
          tooltip: {displayColors: false, callbacks: {
            title: items => items[0].dataset.label || spec.title,
            label: item => {
              const point = item.raw, cell = data.parts[part].cells[point.cell];
              const x = spec.categories[point.value] ?? `${panel.xLabel}: ${digits(point.value)}`;
              return [pointText(spec, item.dataset.line, point), x, ...(cell ? [cell.label] : [])];
            },
          }},
        },
      },
    });
  }

  function legend(spec, drawn) {
    const labels = names(spec, "label");
    if (labels.length < 2) return "";
    const keys = names(spec, "key");
    return element("p", {class: "legend"}, ...labels.map(label => {
      const line = all(spec).find(one => one.label === label);
      const mark = element("span", {class: `mark ${line.mark}`});
      mark.style.setProperty("--colour", colour(keys.indexOf(line.key)));
      const button = element("button", {type: "button", "aria-pressed": "true", click: () => {
        const on = button.getAttribute("aria-pressed") !== "true";
        button.setAttribute("aria-pressed", String(on));
        for (const chart of drawn) {
          chart.data.datasets.forEach((set, i) => { if (set.label === label) chart.setDatasetVisibility(i, on); });
          chart.update();
        }
      }}, mark, label || "all cases");
      return button;
    }));
  }

  function csv(spec, part) {
    const lines = [["panel", "line", "kind", "x", "y", "low", "high", "case"]];
    for (const panel of spec.panels)
      for (const line of panel.lines)
        for (const [x, y, low, high, cell] of line.points)
          lines.push([panel.title || panel.xLabel, line.label, line.mark === "published" ? "published" : "measured",
            spec.categories[x] ?? x, y, low, high, data.parts[part].cells[cell]?.label ?? ""]);
    return lines.map(page.csvLine).join("");
  }

  function draw(figure) {
    const part = page.partOf(figure), spec = data.parts[part].charts[Number(figure.dataset.chart)], drawn = [];
    const panels = element("div", {class: spec.panels.length > 1 ? "panels" : "panels single"});
    const text = csv(spec, part);
    const shown = element("details", {}, element("summary", {}, "Values"), element("pre", {class: "raw"}, text));
    const save = element("button", {type: "button", click: () => page.save(`${spec.stem}.csv`, text)}, "CSV of the plot");
    figure.append(element("p", {class: "soft"}, spec.note), panels);
    for (const panel of spec.panels) {
      const canvas = element("canvas", {role: "img", "aria-label": `${spec.title}. ${panel.title}. Its values follow below.`});
      panels.append(element("div", {class: "panel"}, element("p", {}, panel.title), element("div", {}, canvas)));
      drawn.push(drawPanel(spec, part, panel, canvas));
    }
    figure.append(legend(spec, drawn), element("p", {class: "buttons"}, save), shown);
    figure.charts = drawn;
  }

  function erase(figure) {
    figure.charts?.forEach(chart => chart.destroy());
    figure.replaceChildren(figure.querySelector("figcaption"));
  }

  const figures = [...document.querySelectorAll("figure.chart")];
  const seen = new IntersectionObserver(entries => {
    for (const {isIntersecting, target} of entries)
      if (isIntersecting && !target.charts) draw(target);
  }, {rootMargin: "400px"});
  figures.forEach(figure => seen.observe(figure));
  addEventListener("beforeprint", () => figures.forEach(figure => figure.charts || draw(figure)));
  // The colours of the axes depend on the colour scheme.
  dark.addEventListener("change", () => {
    for (const figure of figures) if (figure.charts) { erase(figure); draw(figure); }
  });
  return {colour, scale};
})();

/** Draws the samples of a row in the order of measurement. */
function drawSamples(figure, lists) {
  if (!charts) return;
  const shown = lists.filter(list => list.phase === "frame");
  const canvas = page.element("canvas", {role: "img", "aria-label": "Samples in the order of measurement; the numbers follow."});
  figure.append(page.element("div", {}, canvas));
  new Chart(canvas, {
    type: "scatter",
    data: {datasets: (shown.length ? shown : lists).map((list, i) => ({
      label: `${list.phase}, ${list.clock}`, data: list.times.map((y, x) => ({x, y})), radius: 2.5,
      borderColor: charts.colour(i), backgroundColor: charts.colour(i),
    }))},
    options: {
      animation: false, responsive: true, maintainAspectRatio: false, interaction: {mode: "nearest", intersect: false},
      scales: {x: charts.scale("linear", "sample", {}), y: charts.scale("linear", "ms", {})},
      plugins: {legend: {labels: {color: getComputedStyle(document.body).color, boxWidth: 12}},
        tooltip: {callbacks: {label: item => `${item.dataset.label}: sample ${item.raw.x}, ${item.raw.y} ms`}}},
    },
  });
}
