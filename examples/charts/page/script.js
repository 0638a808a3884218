// Choosing a scene and an error, hiding methods, sorting tables. Without it the page shows everything.
(() => {
  "use strict";
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  document.documentElement.classList.add("js");
  all(".controls").forEach((element) => { element.hidden = false; });
  all("details.others").forEach((element) => { element.open = true; });

  const place = document.getElementById("choose-place");
  const metric = document.getElementById("choose-metric");
  const showPlace = () => all("section.place").forEach((section) => {
    section.hidden = place.value !== "all" && section.id !== place.value;
  });
  // A place without the chosen figure shows the one that leads there.
  const showMetric = () => all("section.place").forEach((section) => {
    const charts = all(".against[data-metric]", section);
    const chosen = charts.find((chart) => chart.dataset.metric === metric.value) || charts[0];
    charts.forEach((chart) => { chart.hidden = chart !== chosen; });
  });
  if (place && metric) {
    place.addEventListener("change", () => { showPlace(); window.scrollTo({ top: 0 }); });
    metric.addEventListener("change", showMetric);
    // A link to a place that is hidden shows it.
    const follow = () => {
      const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
      if (target && target.hidden) {
        place.value = target.id;
        showPlace();
        target.scrollIntoView();
      }
    };
    window.addEventListener("hashchange", follow);
    showPlace();
    showMetric();
    follow();
  }

  const hidden = new Set();
  const showMethods = () => all("[data-m]").forEach((element) => {
    const hide = hidden.has(element.dataset.m);
    element.toggleAttribute("hidden", hide);
    element.style.display = hide ? "none" : "";
  });
  all(".legend [data-method]").forEach((item) => {
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = true;
    box.addEventListener("change", () => {
      hidden[box.checked ? "delete" : "add"](item.dataset.method);
      showMethods();
    });
    label.append(box, ...item.childNodes);
    item.append(label);
  });

  const value = (row, column) => {
    const cell = row.cells[column];
    if (!cell) return "";
    return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
  };
  const order = (a, b) => (typeof a === "number" && typeof b === "number" ? (a < b ? -1 : a > b ? 1 : 0)
    : String(a).localeCompare(String(b), undefined, { numeric: true }));
  all("table.sortable").forEach((table) => all("thead th", table).forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const falling = head.getAttribute("aria-sort") === "ascending";
      all("thead th", table).forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", falling ? "descending" : "ascending");
      const rows = [...table.tBodies[0].rows];
      rows.sort((a, b) => order(value(a, column), value(b, column)) * (falling ? -1 : 1));
      table.tBodies[0].append(...rows);
    });
  }));

  let closed = [];
  window.addEventListener("beforeprint", () => {
    closed = all("details:not([open])");
    closed.forEach((element) => { element.open = true; });
  });
  window.addEventListener("afterprint", () => closed.forEach((element) => { element.open = false; }));
})();
