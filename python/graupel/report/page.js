// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

// What needs a script: values under the pointer, and the choice of a flow case. Without it
// the page shows all cases.
(() => {
  "use strict";
  const reach = 14; // of the pointer, in the figure's own units
  const tip = document.createElement("div");
  tip.className = "tip";
  tip.hidden = true;
  document.body.append(tip);
  let chosen = null;

  const format = (value) => {
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-3 || size >= 1e5)
      ? value.toExponential(3) : String(Number(value.toPrecision(5)));
    return text.replace("-", "\u2212");
  };
  const show = (lines, event) => {
    tip.replaceChildren(...lines.filter((line) => line).map((line) => {
      const row = document.createElement("div");
      row.textContent = line;
      return row;
    }));
    tip.hidden = false;
    const left = Math.min(event.pageX + 14, window.scrollX + document.documentElement.clientWidth - tip.offsetWidth - 4);
    tip.style.left = `${left}px`;
    tip.style.top = `${event.pageY + 14}px`;
  };
  const isChosen = (one) => chosen === null || one.case === null || one.case === chosen;

  const nearest = (curves, x, y) => {
    let best = null, least = reach * reach;
    for (const curve of curves.filter(isChosen))
      for (let k = 0; k < curve.at.length; k += 2) {
        const distance = (curve.at[k] - x) ** 2 + (curve.at[k + 1] - y) ** 2;
        if (distance < least) {
          least = distance;
          best = [curve, k];
        }
      }
    return best;
  };
  const pixel = (images, x, y) => {
    for (const image of images) {
      const [left, bottom, right, top] = image.at;
      if (x < left || x > right || y < top || y > bottom)
        continue;
      const [rows, columns] = image.shape;
      const across = (x - left) / (right - left), up = (bottom - y) / (bottom - top);
      const column = Math.min(columns - 1, Math.floor(across * columns));
      const row = Math.min(rows - 1, Math.floor(up * rows));
      image.bytes ??= atob(image.steps);
      const step = image.bytes.charCodeAt(row * columns + column);
      if (step === 255)
        return null;
      const [low, high] = image.range, [x0, y0, x1, y1] = image.extent;
      const along = (from, to, share) => {
        const place = from + (to - from) * share;
        return format(Math.abs(place) < 1e-6 * Math.abs(to - from) ? 0 : place);
      };
      return [`${image.label || "value"}: ${format(low + (high - low) * step / 254)}`,
              `${image.axes[0]}: ${along(x0, x1, across)}`,
              `${image.axes[1]}: ${along(y0, y1, up)}`];
    }
    return null;
  };

  for (const data of document.querySelectorAll("script.hover")) {
    const svg = data.parentElement.querySelector("svg");
    const shown = JSON.parse(data.textContent);
    svg.addEventListener("pointermove", (event) => {
      const box = svg.getBoundingClientRect(), view = svg.viewBox.baseVal;
      const x = (event.clientX - box.left) * view.width / box.width;
      const y = (event.clientY - box.top) * view.height / box.height;
      const found = nearest(shown.curves, x, y);
      const lines = found
        ? [found[0].label, `${found[0].axes[0]}: ${format(found[0].values[found[1]])}`,
           `${found[0].axes[1]}: ${format(found[0].values[found[1] + 1])}`]
        : pixel(shown.images, x, y);
      if (lines)
        show(lines, event);
      else
        tip.hidden = true;
    });
    svg.addEventListener("pointerleave", () => { tip.hidden = true; });
  }

  const chooser = document.getElementById("chooser");
  if (!chooser)
    return;
  const choose = (number) => {
    chosen = number;
    for (const button of chooser.querySelectorAll("button"))
      button.setAttribute("aria-pressed", button.value === (number === null ? "" : String(number)));
    for (const part of document.querySelectorAll('svg [id*=".case-"]'))
      part.classList.toggle("other", number !== null && !part.id.endsWith(`.case-${number}`));
    for (const row of document.querySelectorAll("tr[data-case]"))
      row.classList.toggle("other", number !== null && row.dataset.case !== String(number));
  };
  chooser.hidden = false;
  for (const button of chooser.querySelectorAll("button"))
    button.addEventListener("click", () => choose(button.value === "" ? null : Number(button.value)));
  const asked = /case=(\d+)/.exec(window.location.hash);
  choose(asked ? Number(asked[1]) : null);
})();
