// Draws the scenes of a report (io/scene.h): orthographic, flat shaded, with a depth buffer, on plain canvases.
//
// A scene is a JSON object in <script type="application/json" class="scene"> inside its <figure>; all arrays are
// base64. Each figure's canvas can be turned: drag or arrow keys; zoomed: pinch, + and -, or the wheel once it has
// been clicked; set back: double click or 0. All scenes of a page share one view. The address "#turn=40,-20" turns
// it by so many degrees to the right and downwards at the start.
"use strict";

(() => {
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

  // Numbers of 7 bits a byte, least first; the top bit says that more follow.
  const readNumbers = (text, count) => {
    const source = bytes(text), result = new Uint32Array(count);
    for (let i = 0, at = 0; i < count; ++i) {
      let value = 0, scale = 1, byte;
      do {
        byte = source[at++];
        value += (byte & 127) * scale;
        scale *= 128;
      } while (byte & 128);
      result[i] = value;
    }
    return result;
  };

  // Indices as distances below the smallest index that has not occurred yet.
  const readIndices = (text, count) => {
    const result = readNumbers(text, count);
    for (let i = 0, fresh = 0; i < count; ++i) {
      const back = result[i];
      result[i] = fresh - back;
      if (back === 0) ++fresh;
    }
    return result;
  };

  // Places in [-1, 1] of the scene's cube.
  const readPlaces = (text) => {
    const source = bytes(text), result = new Float32Array(source.length / 2);
    for (let i = 0; i < result.length; ++i) result[i] = (source[2 * i] + 256 * source[2 * i + 1]) / 32767.5 - 1;
    return result;
  };

  // Directions: two bytes each, the octahedron unfolded onto a square.
  const readNormals = (text) => {
    const source = bytes(text), result = new Float32Array(source.length / 2 * 3);
    for (let i = 0; i < source.length / 2; ++i) {
      let x = source[2 * i] / 127 - 1, y = source[2 * i + 1] / 127 - 1;
      const z = 1 - Math.abs(x) - Math.abs(y);
      if (z < 0) {
        const flipped = (1 - Math.abs(y)) * (x < 0 ? -1 : 1);
        y = (1 - Math.abs(x)) * (y < 0 ? -1 : 1);
        x = flipped;
      }
      const length = Math.hypot(x, y, z);
      result.set([x / length, y / length, z / length], 3 * i);
    }
    return result;
  };

  const shades = 63;
  // From a cool, darker tone in the shadow to one lighter than the colour itself.
  const shade = (colour, light) => colour.map((base, i) =>
    (1 - light) * [0.3, 0.33, 0.42][i] * base + light * (base + 0.55 * (255 - base)));

  const decode = (data) => ({
    places: readPlaces(data.places),
    corners: readIndices(data.corners, 3 * data.triangles),
    normals: readNormals(data.normals),
    edges: data.edges ? bytes(data.edges) : null,  // bit k: the edge from corner k on is drawn
    colours: data.colours ? bytes(data.colours) : null,
    lines: data.lines ? readPlaces(data.lines) : new Float32Array(0),
    dots: data.dots ? readPlaces(data.dots) : new Float32Array(0),
    dotColours: data.dotColours ? bytes(data.dotColours) : null,
    inks: data.palette.map((text) => {
      const colour = [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
      return Array.from({length: shades + 1}, (_, i) => shade(colour, i / shades));
    }),
    backFaces: data.backFaces,
    edgeLength: data.edgeLength,
  });

  // Rotations are 3x3, row by row; the rows are right, up and towards the viewer.
  const times = (a, b) => a.map((_, i) => {
    const row = 3 * Math.floor(i / 3), column = i % 3;
    return a[row] * b[column] + a[row + 1] * b[3 + column] + a[row + 2] * b[6 + column];
  });
  const turned = (rotation, toRight, downwards) => {
    const c = Math.cos(toRight), s = Math.sin(toRight), d = Math.cos(downwards), t = Math.sin(downwards);
    return times(times([1, 0, 0, 0, d, -t, 0, t, d], [c, 0, s, 0, 1, 0, -s, 0, c]), rotation);
  };

  const tiny = 1e-9;  // pixels on an edge are inside; and 0 times infinity is no number
  const edgeInk = [43, 52, 64], featureInk = [200, 40, 40];
  const lightDirection = [-0.413, 0.597, 0.688];

  // A picture of pixels with their depths.
  class Raster {
    constructor(width, height) {
      this.width = width;
      this.height = height;
      this.image = new ImageData(width, height);
      this.depth = new Float32Array(width * height);
    }
    clear() {
      this.image.data.fill(0);
      this.depth.fill(-Infinity);
    }
    put(pixel, ink, cover) {
      const data = this.image.data, at = 4 * pixel;
      for (let k = 0; k < 3; ++k) data[at + k] += (ink[k] - data[at + k]) * cover;
      data[at + 3] = 255;
    }

    // A triangle of three places in pixels (x, y, depth); each edge whose bit is set as a dark line, half of it on
    // this side.
    triangle(p, a, b, c, ink, edges, line) {
      const ax = p[a], ay = p[a + 1], bx = p[b], by = p[b + 1], cx = p[c], cy = p[c + 1];
      const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      if (area === 0) return;
      const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5));
      const right = Math.min(this.width - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
      const top = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5));
      const bottom = Math.min(this.height - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
      // u, v, w: the shares of c, a, b. Over the length of its gradient a share is the distance to the edge across.
      const ux = (ay - by) / area, uy = (bx - ax) / area, vx = (by - cy) / area, vy = (cx - bx) / area;
      const wx = -ux - vx, wy = -uy - vy;
      const du = edges & 1 ? 1 / Math.hypot(ux, uy) : Infinity, dv = edges & 2 ? 1 / Math.hypot(vx, vy) : Infinity,
            dw = edges & 4 ? 1 / Math.hypot(wx, wy) : Infinity;
      const depthA = p[a + 2], depthB = p[b + 2], depthC = p[c + 2], reach = line.half + 0.5, data = this.image.data;
      for (let y = top; y <= bottom; ++y) {
        for (let x = left; x <= right; ++x) {
          const u = ux * (x + 0.5 - ax) + uy * (y + 0.5 - ay), v = vx * (x + 0.5 - bx) + vy * (y + 0.5 - by);
          const w = 1 - u - v;
          if (u < -tiny || v < -tiny || w < -tiny) continue;
          const depth = u * depthC + v * depthA + w * depthB, pixel = y * this.width + x;
          if (depth <= this.depth[pixel]) continue;
          this.depth[pixel] = depth;
          const nearest = edges ? Math.min((u + tiny) * du, (v + tiny) * dv, (w + tiny) * dw) : Infinity;
          const cover = nearest < reach ? Math.min(1, reach - nearest) * line.strength : 0, at = 4 * pixel;
          data[at] = ink[0] + (edgeInk[0] - ink[0]) * cover;
          data[at + 1] = ink[1] + (edgeInk[1] - ink[1]) * cover;
          data[at + 2] = ink[2] + (edgeInk[2] - ink[2]) * cover;
          data[at + 3] = 255;
        }
      }
    }

    // A disk, where nothing is nearer by more than `lift`.
    disk(p, radius, ink, lift) {
      const reach = Math.ceil(radius + 1), cx = Math.floor(p[0]), cy = Math.floor(p[1]);
      for (let y = Math.max(0, cy - reach); y <= Math.min(this.height - 1, cy + reach); ++y) {
        for (let x = Math.max(0, cx - reach); x <= Math.min(this.width - 1, cx + reach); ++x) {
          const cover = Math.min(1, radius + 0.5 - Math.hypot(x + 0.5 - p[0], y + 0.5 - p[1]));
          const pixel = y * this.width + x;
          if (cover > 0 && p[2] + lift >= this.depth[pixel]) this.put(pixel, ink, cover);
        }
      }
    }
    line(p, q, radius, ink, lift) {
      const steps = Math.max(1, Math.ceil(Math.hypot(q[0] - p[0], q[1] - p[1]) / Math.max(1, radius)));
      for (let i = 0; i <= steps; ++i)
        this.disk([0, 1, 2].map((k) => p[k] + (q[k] - p[k]) * i / steps), radius, ink, lift);
    }
  }

  const view = {rotation: null, zoom: 1, first: null};

  class Figure {
    constructor(element) {
      this.scene = decode(JSON.parse(element.querySelector("script.scene").textContent));
      this.canvas = document.createElement("canvas");
      this.canvas.tabIndex = 0;
      this.canvas.setAttribute("role", "img");
      this.canvas.setAttribute("aria-label", element.querySelector("figcaption").textContent);
      element.querySelector("figcaption").before(this.canvas);
      this.projected = new Float32Array(this.scene.places.length);
    }

    // `fine`: pixels of the raster per pixel of the page.
    draw(fine) {
      const width = Math.round(this.canvas.clientWidth * fine), height = Math.round(this.canvas.clientHeight * fine);
      if (!width || !height) return;
      if (!this.raster || this.raster.width !== width || this.raster.height !== height) {
        this.raster = new Raster(width, height);
        this.canvas.width = width;
        this.canvas.height = height;
      }
      this.raster.clear();
      if (!this.fit) this.fit = this.fitting(width, height);
      this.scale = this.fit * Math.min(width, height) * view.zoom;
      const side = Math.min(width, height);
      this.middle = [width / 2 + side * view.shift[0], height / 2 + side * view.shift[1]];
      this.drawTriangles(fine);
      this.drawOverlays(fine);
      this.canvas.getContext("2d").putImageData(this.raster.image, 0, 0);
    }
    // The scale with which the first view fills the picture, in units of its shorter side.
    fitting(width, height) {
      const r = view.first, p = this.scene.places, side = Math.min(width, height);
      let x = 0.5, y = 0.5;
      for (let i = 0; i < p.length; i += 3) {
        x = Math.max(x, Math.abs(r[0] * p[i] + r[1] * p[i + 1] + r[2] * p[i + 2]));
        y = Math.max(y, Math.abs(r[3] * p[i] + r[4] * p[i + 1] + r[5] * p[i + 2]));
      }
      return Math.min(0.62, 0.46 * Math.min(width / side / x, height / side / y));
    }
    pixel(places, i) {
      const r = view.rotation, x = places[i], y = places[i + 1], z = places[i + 2];
      return [this.middle[0] + this.scale * (r[0] * x + r[1] * y + r[2] * z),
              this.middle[1] - this.scale * (r[3] * x + r[4] * y + r[5] * z),
              r[6] * x + r[7] * y + r[8] * z];
    }
    drawTriangles(fine) {
      const s = this.scene, r = view.rotation, p = this.projected, n = s.normals, c = s.corners;
      for (let i = 0; i < s.places.length; i += 3) p.set(this.pixel(s.places, i), i);
      // Lines fade where they would cover the surface.
      const spacing = this.scale * s.edgeLength / fine;
      const line = {half: 0.45 * fine, strength: Math.min(0.85, Math.max(0, (spacing - 1.5) / 6))};
      for (let t = 0; t < c.length; t += 3) {
        const z = r[6] * n[t] + r[7] * n[t + 1] + r[8] * n[t + 2];
        if (z <= 0 && !s.backFaces) continue;
        const x = r[0] * n[t] + r[1] * n[t + 1] + r[2] * n[t + 2], y = r[3] * n[t] + r[4] * n[t + 1] + r[5] * n[t + 2];
        const along = x * lightDirection[0] + y * lightDirection[1] + z * lightDirection[2];
        const light = z < 0 ? 0.45 * (0.5 - 0.5 * along) : 0.5 + 0.5 * along;
        const inks = s.inks[s.colours ? s.colours[t / 3] : 0], edges = s.edges ? s.edges[t / 3] : 7;
        this.raster.triangle(p, 3 * c[t], 3 * c[t + 1], 3 * c[t + 2], inks[Math.round(light * shades)],
                             line.strength > 0 ? edges : 0, line);
      }
    }
    drawOverlays(fine) {
      const s = this.scene, lift = 0.012;
      for (let i = 0; i < s.lines.length; i += 6)
        this.raster.line(this.pixel(s.lines, i), this.pixel(s.lines, i + 3), 0.9 * fine, featureInk, lift);
      const count = s.dots.length / 3;
      const radius = fine * Math.min(3, Math.max(0.7, 60 / Math.sqrt(count + 1))) * Math.sqrt(view.zoom);
      for (let i = 0; i < count; ++i)
        this.raster.disk(this.pixel(s.dots, 3 * i), radius, s.inks[s.dotColours ? s.dotColours[i] : 0][shades >> 1], lift);
    }
  }

  const turnBy = (right, down) => { view.rotation = turned(view.rotation, right, down); };
  // What is in the middle stays there.
  const zoomBy = (factor) => {
    const zoom = Math.min(60, Math.max(0.3, view.zoom * factor));
    view.shift = view.shift.map((s) => s * zoom / view.zoom);
    view.zoom = zoom;
  };
  // In units of a picture's shorter side.
  const shiftBy = (right, down) => { view.shift = [view.shift[0] + right, view.shift[1] + down]; };
  const reset = () => {
    view.rotation = view.first;
    view.zoom = 1;
    view.shift = [0, 0];
  };

  const keys = {
    ArrowLeft: () => turnBy(-0.1, 0), ArrowRight: () => turnBy(0.1, 0), ArrowUp: () => turnBy(0, -0.1),
    ArrowDown: () => turnBy(0, 0.1), "+": () => zoomBy(1.15), "-": () => zoomBy(1 / 1.15), 0: reset,
  };

  const shifts = {
    ArrowLeft: () => shiftBy(-0.05, 0), ArrowRight: () => shiftBy(0.05, 0), ArrowUp: () => shiftBy(0, -0.05),
    ArrowDown: () => shiftBy(0, 0.05),
  };

  const onPointers = (canvas, refresh) => {
    const pointers = new Map();
    const gap = () => {
      const [p, q] = [...pointers.values()];
      return Math.hypot(p[0] - q[0], p[1] - q[1]);
    };
    canvas.addEventListener("pointerdown", (event) => {
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const last = pointers.get(event.pointerId);
      if (!last) return;
      const before = pointers.size === 2 ? gap() : 0, now = [event.clientX, event.clientY];
      const side = Math.min(canvas.clientWidth, canvas.clientHeight);
      const right = now[0] - last[0], down = now[1] - last[1];
      pointers.set(event.pointerId, now);
      if (before > 0) {
        shiftBy(right / side / 2, down / side / 2);
        zoomBy(gap() / before);
      } else if (event.shiftKey || event.buttons & 2) shiftBy(right / side, down / side);
      else turnBy(right / 120, down / 120);
      refresh();
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    for (const name of ["pointerup", "pointercancel"])
      canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  };

  const onKeysAndWheel = (canvas, refresh) => {
    canvas.addEventListener("wheel", (event) => {
      if (document.activeElement !== canvas) return;
      event.preventDefault();
      zoomBy(Math.exp(-event.deltaY / 500));
      refresh();
    }, {passive: false});
    canvas.addEventListener("dblclick", () => {
      reset();
      refresh();
    });
    canvas.addEventListener("keydown", (event) => {
      const action = event.shiftKey && shifts[event.key] || keys[event.key];
      if (!action) return;
      event.preventDefault();
      action();
      refresh();
    });
  };

  const figures = [...document.querySelectorAll("figure.scene")].map((element) => new Figure(element));
  if (figures.length === 0) return;
  view.first = JSON.parse(document.getElementById("view").textContent).rotation;
  reset();
  const wish = /turn=(-?[\d.]+),(-?[\d.]+)/.exec(location.hash);
  if (wish) turnBy(wish[1] * Math.PI / 180, wish[2] * Math.PI / 180);

  const drawAll = () => {
    for (const figure of figures) figure.draw(Math.min(3, 2 * Math.max(1, window.devicePixelRatio || 1)));
    document.documentElement.dataset.drawn = figures.length;
  };
  // While it moves, the figure at hand is drawn coarsely; all of them once it rests.
  let pending = 0, rest = 0;
  const refreshing = (figure) => () => {
    clearTimeout(rest);
    rest = setTimeout(drawAll, 120);
    if (pending) return;
    pending = requestAnimationFrame(() => {
      pending = 0;
      figure.draw(1);
    });
  };
  for (const figure of figures) {
    onPointers(figure.canvas, refreshing(figure));
    onKeysAndWheel(figure.canvas, refreshing(figure));
  }
  window.addEventListener("resize", () => {
    clearTimeout(rest);
    rest = setTimeout(drawAll, 100);
  });
  drawAll();
})();
