// timeline.js - the bar at the bottom: where the world is, what happened when, and buttons to go elsewhere.
const SPEEDS = [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16];
const $ = (id) => document.getElementById(id);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export class Timeline {
    constructor(app) {
        this.app = app, this.bar = $('timeline'), this.canvas = $('marks'), this.speed = 1, this.loop = false;
        this.marks = []; // { step, kind, text, about }
        const select = $('speed');
        for (const s of SPEEDS) select.add(new Option(s < 1 ? `1/${1 / s} ×` : `${s} ×`, s, s === 1, s === 1));
        select.onchange = () => (this.speed = Number(select.value), select.blur());
        $('play').onclick = () => app.toggle();
        $('first').onclick = () => app.seek(app.first);
        $('back').onclick = () => app.stepBy(-1);
        $('forth').onclick = () => app.stepBy(1);
        $('loop').onclick = () => this.setLoop(!this.loop);
        let resume = false;
        const go = (e) => app.seek(this.stepAt(e.clientX));
        this.bar.onpointerdown = (e) => {
            this.bar.setPointerCapture(e.pointerId);
            resume = app.playing, app.pause(), go(e), (this.held = true);
        };
        this.bar.onpointermove = (e) => {
            if (this.held) go(e);
            this.#hover(e);
        };
        this.bar.onpointerup = this.bar.onpointercancel = () => {
            if (this.held && resume) app.play();
            this.held = false;
        };
        this.bar.onpointerleave = () => ($('hover').hidden = true);
        new ResizeObserver(() => this.draw()).observe(this.bar);
    }
    setLoop(on) { this.loop = on, $('loop').setAttribute('aria-pressed', on); }
    setSpeed(by) {
        const k = Math.min(Math.max(SPEEDS.indexOf(this.speed) + by, 0), SPEEDS.length - 1);
        this.speed = SPEEDS[k], $('speed').value = this.speed;
    }
    stepAt(x) {
        const r = this.bar.getBoundingClientRect(), part = Math.min(Math.max((x - r.left) / r.width, 0), 1);
        return Math.round(this.app.first + part * (this.app.last - this.app.first));
    }
    part(step) {
        const { first, last } = this.app;
        return last > first ? (step - first) / (last - first) : 0;
    }
    #hover(e) {
        const hover = $('hover'), r = this.bar.getBoundingClientRect(), step = this.stepAt(e.clientX);
        const reach = (6 / r.width) * (this.app.last - this.app.first);
        const near = this.marks.filter((m) => m.text && Math.abs(m.step - step) <= reach);
        const [mark] = near.sort((a, b) => RANK[b.kind] - RANK[a.kind]);
        hover.hidden = false;
        hover.textContent = mark ? `${mark.step}  ${mark.text}` : `${step}`;
        const x = e.clientX - r.left, right = x > r.width - 180;
        hover.style.left = right ? '' : `${x}px`, hover.style.right = right ? `${r.width - x + 16}px` : '';
    }
    // What is marked has changed, or the size
    draw() {
        const { clientWidth: w, clientHeight: h } = this.bar, ratio = devicePixelRatio;
        const c = this.canvas, g = c.getContext('2d');
        c.width = w * ratio, c.height = h * ratio;
        g.scale(ratio, ratio);
        const { app } = this, x = (step) => this.part(step) * w;
        g.fillStyle = css('--line');
        for (const step of app.recording?.keyframes ?? []) g.fillRect(x(step), h - 9, 1, 6);
        const hits = new Float32Array(Math.ceil(w / 3) + 1);
        for (const m of this.marks) if (m.kind === 'hit') hits[Math.floor(x(m.step) / 3)] += 1;
        g.fillStyle = css('--faint');
        hits.forEach((n, k) => {
            const tall = Math.min(1, Math.log2(1 + n) / 7) * (h - 12);
            if (n) g.fillRect(3 * k, h - 4 - tall, 2, tall);
        });
        for (const m of this.marks) {
            if (m.kind === 'hit' || m.kind === 'sleep' || m.kind === 'wake') continue;
            g.fillStyle = css(m.kind === 'note' ? '--warm' : '--red');
            const at = x(m.step);
            if (m.kind === 'divergence') g.fillRect(at, 0, 3, h);
            g.beginPath(), g.moveTo(at - 4, 1), g.lineTo(at + 4, 1), g.lineTo(at, 8), g.fill();
        }
    }
    show() {
        const { app } = this, part = this.part(app.goal ?? app.step);
        const percent = (v) => `${(100 * Math.min(v, 1)).toFixed(3)}%`;
        $('head').style.left = percent(part), $('played').style.width = percent(this.part(app.step));
        $('ready').style.width = percent(this.part(app.scanned));
        $('step').textContent = app.step;
        $('of').textContent = app.live ? 'live' : `/ ${app.last}${app.isEndKnown ? '' : ' +'}`;
        $('seconds').textContent = `${((app.step - app.first) * app.dt).toFixed(2)} s`;
        $('play').firstElementChild.firstElementChild.setAttribute('d', app.playing ? PAUSE : PLAY);
        const values = { min: app.first, max: app.last, now: app.step };
        for (const [name, value] of Object.entries(values)) this.bar.setAttribute(`aria-value${name}`, value);
    }
}
const PLAY = 'M4 2.5v11L13.5 8z', PAUSE = 'M4 3h3v10H4zM9 3h3v10H9z';
const RANK = { hit: 0, sleep: 0, wake: 0, note: 1, break: 2, divergence: 3 };
