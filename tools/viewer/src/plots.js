// plots.js - numbers over the time axis. A curve has its own scale: forms are compared, values are read at the line.
import { COLUMNS, colourOf } from './series.js';
const SCALES = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, '']];
function short(v) {
    const [scale, letter] = SCALES.find(([s]) => Math.abs(v) >= s) ?? [1, ''];
    return Number.isInteger(v) && Math.abs(v) < 1e5 ? String(v) : (v / scale).toPrecision(3) + letter;
}
const $ = (id) => document.getElementById(id);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export class Plots {
    constructor(app) {
        this.app = app, this.canvas = $('plot');
        this.on = new Set(['kinetic energy', 'deepest overlap', 'awake bodies']);
        $('plots-button').onclick = () => this.toggle();
        const area = $('plot-area');
        area.onpointerdown = (e) => {
            area.setPointerCapture(e.pointerId);
            this.held = true, app.pause(), this.#go(e);
        };
        area.onpointermove = (e) => this.held && this.#go(e);
        area.onpointerup = area.onpointercancel = () => (this.held = false);
        new ResizeObserver(() => this.draw()).observe(area);
    }
    get open() { return !$('plots').hidden; }
    toggle(on = !this.open) {
        $('plots').hidden = !on, $('plots-button').setAttribute('aria-pressed', on);
        this.app.layout(), this.names(), this.draw();
    }
    #go(e) {
        const r = this.canvas.getBoundingClientRect(), part = Math.min(Math.max((e.clientX - r.left) / r.width, 0), 1);
        this.app.seek(this.app.first + part * (this.app.last - this.app.first));
    }
    all() {
        const pins = this.app.pins.map((p) => ({ name: p.name, unit: p.unit ?? '', pinned: p }));
        return [...COLUMNS, ...pins].map((c, k) => ({ ...c, k, colour: colourOf(k) }));
    }
    names() {
        if (!this.open) return;
        $('plot-names').replaceChildren(...this.all().map((c) => {
            const [b, dot, out] = ['button', 'i', 'output'].map((name) => document.createElement(name));
            const on = this.on.has(c.name);
            dot.style.background = on ? c.colour : '', b.setAttribute('aria-pressed', on), out.dataset.k = c.k;
            b.append(dot, c.name, out);
            b.onclick = () => { on ? this.on.delete(c.name) : this.on.add(c.name), this.names(), this.draw(); };
            return b;
        }));
        this.show();
    }
    // The values where the world is
    show() {
        if (!this.open) return;
        const { app } = this, all = this.all();
        for (const out of $('plot-names').querySelectorAll('output')) {
            const c = all[Number(out.dataset.k)], v = app.series.at(app.step, c.k);
            out.textContent = Number.isNaN(v) ? '' : `${short(v)} ${c.unit}`;
        }
        $('plot-line').style.left = `${100 * app.timeline.part(app.step)}%`;
    }
    draw() {
        if (!this.open) return;
        const { clientWidth: w, clientHeight: h } = this.canvas, ratio = devicePixelRatio;
        const g = this.canvas.getContext('2d'), { series, first, last } = this.app;
        this.canvas.width = w * ratio, this.canvas.height = h * ratio;
        g.scale(ratio, ratio), g.lineWidth = 1.5, g.lineJoin = 'round';
        g.strokeStyle = css('--line');
        for (let k = 0; k <= 4; ++k) {
            const y = 4.5 + Math.round((k * (h - 9)) / 4);
            g.beginPath(), g.moveTo(0, y), g.lineTo(w, y), g.stroke();
        }
        const span = Math.max(last - first, 1);
        for (const c of this.all()) {
            if (this.on.has(c.name) && c.k < series.width) this.#curve(g, w, h, series, first, span, c);
        }
    }
    #range(series, k) {
        let low = Infinity, high = -Infinity;
        for (let s = 0; s < series.count; ++s) {
            const v = series.data[s * series.width + k];
            if (v < low) low = v;
            if (v > high) high = v;
        }
        if (low > 0 && low < 0.5 * high) low = 0;
        return [low, high];
    }
    // Of each column of pixels the least and the largest value
    #curve(g, w, h, series, first, span, { k, colour, scale }) {
        let [low, high] = this.#range(series, scale ? COLUMNS.findIndex((c) => c.name === scale) : k);
        if (scale) low = 0; // parts of it, which may be nothing
        if (!(high >= low)) return;
        const y = (v) => h - 4.5 - (high > low ? (v - low) / (high - low) : 0.5) * (h - 9);
        g.strokeStyle = colour, g.beginPath();
        const each = Math.max(1, Math.floor(span / w));
        let drawn = false;
        for (let s = 0; s < series.count; s += each) {
            let a = Infinity, b = -Infinity;
            for (let j = s; j < Math.min(s + each, series.count); ++j) {
                const v = series.data[j * series.width + k];
                if (v < a) a = v;
                if (v > b) b = v;
            }
            if (!(b >= a)) { drawn = false; continue; }
            const x = ((series.first + s - first) / span) * w;
            if (drawn) g.lineTo(x, y(a)); else g.moveTo(x, y(a));
            if (b !== a) g.lineTo(x, y(b));
            drawn = true;
        }
        g.stroke();
    }
}
