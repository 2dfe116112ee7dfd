"use strict";
// Figures show the values under the pointer and zoom; pictures turn. Without this script all of it stands still.
(() => {
  const NEAR = 40, DRAG = 6, NUMBERS = 5, PLACE = 0.45;
  const tip = document.createElement("div");
  tip.className = "reading";
  tip.setAttribute("role", "status");
  tip.hidden = true;
  document.body.append(tip);

  const raised = (digits) => digits.replace(/./g, (one) => (one === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[one]));

  function number(value) {
    const [head, power] = String(value).replace("+", "").split("e");
    const front = head === "1" && power ? "" : head.replace("-", "−") + (power ? " · " : "");
    return power ? `${front}10${raised(power)}` : front;
  }

  // One coordinate in words, with its unit or, on an axis of names, the nearest name.
  function inWords(axis, value, uncertainty) {
    const near = (axis.places ?? []).find(([place]) => Math.abs(place - value) < PLACE);
    if (near) return near[1];
    const bar = uncertainty ? " ± " + number(uncertainty) : "";
    return `${axis.name}: ${number(value)}${bar}${axis.unit ? " " + axis.unit : ""}`;
  }

  function show(words, x, y) {
    tip.textContent = words.filter(Boolean).join("\n");
    tip.hidden = false;
    tip.style.left = Math.max(4, Math.min(x + 14, innerWidth - tip.offsetWidth - 8)) + "px";
    tip.style.top = (y + tip.offsetHeight + 30 > innerHeight ? y - tip.offsetHeight - 12 : y + 16) + "px";
  }

  function pointOf(panel, series, i) {
    const [left, top, x, y, bar] = series.points.slice(NUMBERS * i, NUMBERS * (i + 1));
    const words = [panel.title, series.label];
    words.push(inWords(panel.x, x, series.of === "x" ? bar : 0), inWords(panel.y, y, series.of === "y" ? bar : 0));
    return { left, top, words };
  }

  function nearest(panels, place, reach) {
    let best = null, least = reach;
    for (const panel of panels) for (const series of panel.series) {
      for (let i = 0; i < series.points.length / NUMBERS; i++) {
        const away = Math.hypot(series.points[NUMBERS * i] - place.x, series.points[NUMBERS * i + 1] - place.y);
        if (away < least) { least = away; best = { panel, series, i }; }
      }
    }
    return best && { ...pointOf(best.panel, best.series, best.i), away: least };
  }

  function cellOf(panels, place) {
    for (const panel of panels) {
      const [left, top, width, height] = panel.box, map = panel.map;
      const column = map ? Math.floor(((place.x - left) / width) * map.columns) : -1;
      const row = map ? Math.floor(((place.y - top) / height) * map.rows) : -1;
      if (column < 0 || row < 0 || column >= map.columns || row >= map.rows) continue;
      const value = map.values[row * map.columns + column];
      const words = value === null ? `${map.name}: none` : inWords(map, value);
      return { left: place.x, top: place.y, words: [panel.title, words] };
    }
    return null;
  }

  const digitsOf = (step) => Math.max(0, -Math.floor(Math.log10(step)));

  // About four round values of an axis between two places, which are fractions of its length, with their places.
  function ticksOf(axis, low, high) {
    const log = axis.scale === "log", [from, to] = log ? axis.limits.map(Math.log10) : axis.limits;
    if (axis.places || (!log && axis.scale !== "linear")) return [];
    const [a, b] = [from + low * (to - from), from + high * (to - from)].sort((x, y) => x - y);
    const [first, last] = log && b - a < 2 ? [10 ** a, 10 ** b] : [a, b];
    const rough = (last - first) / 4, power = 10 ** Math.floor(Math.log10(rough));
    const step = (log && b - a >= 2) ? Math.ceil(rough) : power * [1, 2, 5, 10].find((one) => one * power >= rough);
    const found = [];
    for (let value = Math.ceil(first / step) * step; value <= last; value += step) {
      const shown = log && b - a >= 2 ? "1e" + value : value.toFixed(Math.min(digitsOf(step), 12));
      const place = log ? (b - a < 2 ? Math.log10(value) : value) : value;
      found.push([(place - from) / (to - from), number(shown)]);
    }
    return found;
  }

  function readable(svg) {
    const whole = svg.getAttribute("viewBox").split(" ").map(Number);
    let view = whole, panels = null, start = null, cursor = null;
    const draw = (name, entries) => {
      const mark = document.createElementNS(svg.namespaceURI, name);
      for (const [key, value] of Object.entries(entries)) mark.setAttribute(key, value);
      mark.style.display = "none";
      return svg.appendChild(mark);
    };
    const ring = draw("circle", { class: "ring" }), frame = draw("rect", { class: "frame" });
    const ticks = svg.appendChild(document.createElementNS(svg.namespaceURI, "g"));
    ticks.setAttribute("class", "scales");
    const read = () => (panels ??= JSON.parse(svg.querySelector("metadata.readings").textContent));
    const placeOf = (event) => new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const scale = () => view[2] / whole[2];
    const hide = () => { tip.hidden = true; ring.style.display = "none"; };
    // The values along the lower and the left edge of what is seen of the panel in the middle.
    const scales = () => {
      ticks.replaceChildren();
      const [x, y] = [view[0] + view[2] / 2, view[1] + view[3] / 2];
      const inside = ({ box: [left, top, width, height] }) =>
        x >= left && x <= left + width && y >= top && y <= top + height;
      const panel = scale() < 1 && read().find(inside);
      if (!panel) return;
      const [left, top, width, height] = panel.box, size = 10 * scale();
      const ends = [Math.max(view[0], left), Math.min(view[0] + view[2], left + width)];
      const sides = [Math.max(view[1], top), Math.min(view[1] + view[3], top + height)];
      const write = (x, y, words, anchor) => {
        const text = document.createElementNS(svg.namespaceURI, "text");
        for (const [key, value] of Object.entries({ x, y, "font-size": size, "text-anchor": anchor })) {
          text.setAttribute(key, value);
        }
        text.textContent = words;
        ticks.append(text);
      };
      const room = 0.04 * view[2];  // so that no number is cut at an edge
      for (const [place, words] of ticksOf(panel.x, (ends[0] + room - left) / width, (ends[1] - room - left) / width)) {
        write(left + place * width, sides[1] - size / 3, words, "middle");
      }
      const [low, high] = [1 - (sides[1] - 2 * size - top) / height, 1 - (sides[0] + size - top) / height];
      for (const [place, words] of ticksOf(panel.y, low, high)) {
        write(ends[0] + size / 4, top + (1 - place) * height + size / 3, words, "start");
      }
    };
    const zoom = (next) => {
      const size = Math.min(next[2], whole[2]), tall = (size / whole[2]) * whole[3];
      const within = (low, least, room) => Math.max(least, Math.min(low, least + room));
      view = [within(next[0], whole[0], whole[2] - size), within(next[1], whole[1], whole[3] - tall), size, tall];
      svg.setAttribute("viewBox", view.join(" "));
      svg.classList.toggle("zoomed", size < whole[2]);
      scales();
    };
    const mark = (found, x, y) => {
      ring.style.display = found.away === undefined ? "none" : "";
      ring.setAttribute("r", 4 * scale());
      ring.setAttribute("cx", found.left);
      ring.setAttribute("cy", found.top);
      show(found.words, x, y);
    };
    const hover = (event) => {
      const place = placeOf(event);
      const over = read().filter(({ box: [left, top, width, height] }) =>
        place.x >= left - 3 && place.x <= left + width + 3 && place.y >= top - 3 && place.y <= top + height + 3);
      const point = nearest(over, place, NEAR * scale()), cell = cellOf(over, place);
      const found = point && (!cell || point.away < 10 * scale()) ? point : cell;
      if (found) mark(found, event.clientX, event.clientY); else hide();
    };
    const move = (event) => {
      if (!start) return hover(event);
      const place = placeOf(event);
      const [x, y] = [Math.min(place.x, start.x), Math.min(place.y, start.y)];
      const size = { x, y, width: Math.abs(place.x - start.x), height: Math.abs(place.y - start.y) };
      for (const [key, value] of Object.entries(size)) frame.setAttribute(key, value);
      frame.style.display = "";
      return hide();
    };
    svg.addEventListener("pointermove", (event) => { if (event.pointerType !== "touch") move(event); });
    svg.addEventListener("pointerleave", () => { hide(); });
    svg.addEventListener("pointerdown", (event) => {
      if (event.pointerType === "touch") hover(event);
      else if (event.button === 0) { start = placeOf(event); svg.setPointerCapture(event.pointerId); }
    });
    svg.addEventListener("pointerup", (event) => {
      const end = start && placeOf(event), [x, y] = end ? [Math.abs(end.x - start.x), Math.abs(end.y - start.y)] : [0, 0];
      if (Math.max(x, y) > DRAG) {
        const size = Math.max(x, (y / whole[3]) * whole[2]);
        const middle = [(start.x + end.x) / 2, (start.y + end.y) / 2];
        zoom([middle[0] - size / 2, middle[1] - ((size / whole[2]) * whole[3]) / 2, size]);
      }
      start = null;
      frame.style.display = "none";
    });
    svg.addEventListener("dblclick", () => zoom(whole));
    svg.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.shiftKey) return;
      event.preventDefault();
      const place = placeOf(event), by = (event.deltaY || event.deltaX) > 0 ? 1.25 : 0.8;
      zoom([place.x - (place.x - view[0]) * by, place.y - (place.y - view[1]) * by, view[2] * by]);
    }, { passive: false });
    svg.addEventListener("keydown", (event) => {
      const all = read().flatMap((panel) => panel.series.map((series) => ({ panel, series })));
      const turn = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [-1, 0] }[event.key];
      if (event.key === "Escape") { zoom(whole); hide(); }
      if (!turn || !all.length) return;
      event.preventDefault();
      cursor = cursor ? [(cursor[0] + turn[0] + all.length) % all.length, turn[0] ? 0 : cursor[1] + turn[1]] : [0, 0];
      const { panel, series } = all[cursor[0]], count = series.points.length / NUMBERS;
      cursor[1] = (cursor[1] + count) % count;
      const found = { ...pointOf(panel, series, cursor[1]), away: 0 };
      const place = new DOMPoint(found.left, found.top).matrixTransform(svg.getScreenCTM());
      mark(found, place.x, place.y);
    });
    svg.addEventListener("blur", hide);
    svg.setAttribute("tabindex", "0");
    svg.classList.add("readable");
    svg.parentElement.classList.add("read");
  }

  const bytesOf = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

  // The chunk of a PNG file that holds its scene, in base64.
  function sceneOf(image) {
    const bytes = bytesOf(image.src.split(",")[1]), view = new DataView(bytes.buffer);
    for (let at = 8; at < bytes.length; at += 12 + view.getUint32(at)) {
      const size = view.getUint32(at);
      if (String.fromCharCode(...bytes.subarray(at + 4, at + 8)) !== "scEn") continue;
      let text = "";
      for (let i = at + 8; i < at + 8 + size; i += 8192) {
        text += String.fromCharCode(...bytes.subarray(i, Math.min(i + 8192, at + 8 + size)));
      }
      return btoa(text);
    }
    return "";
  }

  async function viewerPage(scene) {
    const packed = new Blob([bytesOf(document.getElementById("viewer").textContent)]).stream();
    const page = await new Response(packed.pipeThrough(new DecompressionStream("gzip"))).text();
    const load = `function loadDataSet() { OfflineLocalView.load(document.body, { base64Str: "${scene}" }); }`;
    return page.replace("</head>", () => `<script>${load}<\/script></head>`);
  }

  function turning(image) {
    const button = document.createElement("button");
    button.className = "turn";
    button.textContent = "turn it";
    button.addEventListener("click", async () => {
      const frame = document.createElement("iframe");
      frame.title = image.alt;
      frame.srcdoc = await viewerPage(sceneOf(image));
      image.after(frame);
      image.classList.add("turned");
      button.remove();
    });
    image.after(button);
  }

  document.querySelectorAll('img[src^="data:image/png;scene"]').forEach(turning);
  document.querySelectorAll("svg:has(> metadata.readings)").forEach(readable);
})();
