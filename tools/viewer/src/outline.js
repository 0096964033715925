// outline.js - the left panel: bodies, joints, events, notes, as a list of which only the visible rows are made.
const $ = (id) => document.getElementById(id);
const FILTERS = { bodies: ['all', 'awake', 'asleep', 'dynamic', 'static', 'kinematic', 'fast', 'deep'], joints: ['all'], events: ['all', 'hit', 'break', 'sleep', 'wake'], notes: ['all'] };
const FAST = 10, DEEP = 0.005; // m/s, m
const STEP_TYPES = ['hit', 'break', 'sleep', 'wake'];

export class Outline {
    constructor(app) {
        this.app = app, this.tab = 'bodies', this.rows = [], this.box = $('outline'), this.room = $('outline-room');
        this.box.onscroll = () => this.paint();
        new ResizeObserver(() => this.paint()).observe(this.box);
        $('search').oninput = $('filter').onchange = () => this.show();
        this.room.onclick = (e) => {
            const row = e.target.closest('.row');
            if (row) this.#choose(this.rows[Number(row.dataset.k)]);
        };
        this.room.ondblclick = () => app.focus();
        this.box.onkeydown = (e) => {
            if (e.key !== 'ArrowDown' && e.key !== 'ArrowUp') return;
            e.preventDefault(), e.stopPropagation();
            const at = this.rows.findIndex((r) => this.#isChosen(r)), to = this.rows[Math.min(Math.max(at + (e.key === 'ArrowDown' ? 1 : -1), 0), this.rows.length - 1)];
            if (to) this.#choose(to), this.box.scrollTop = Math.max(0, this.rows.indexOf(to) * this.height - this.box.clientHeight / 2);
        };
        this.choose('bodies');
    }
    get height() { return innerWidth <= 760 ? 34 : 26; }
    choose(tab) {
        this.tab = tab;
        const filter = $('filter');
        filter.replaceChildren(...FILTERS[tab].map((name) => new Option(name, name)));
        filter.hidden = FILTERS[tab].length < 2;
        this.box.scrollTop = 0, this.show();
    }
    #choose(row) {
        if (!row) return;
        if (row.step !== undefined) this.app.pause(), this.app.seek(row.step);
        if (row.joint) this.app.pick({ joint: row.joint });
        else if (row.body) this.app.pick({ body: row.body });
    }
    #isChosen(r) { const p = this.app.picked; return !!p && (r.joint ? p.joint === r.joint : r.body === p.body && r.step === undefined); }
    #counts() {
        const { app } = this, c = app.world?.counters;
        return { bodies: c?.bodies ?? 0, joints: c?.joints ?? 0, events: app.timeline.marks.filter((m) => STEP_TYPES.includes(m.kind)).length, notes: app.notes.length };
    }
    show() {
        const { app } = this, counts = this.#counts(), tabs = $('tabs');
        tabs.replaceChildren(...Object.keys(FILTERS).map((name) => {
            const b = document.createElement('button');
            b.setAttribute('role', 'tab'), b.setAttribute('aria-selected', name === this.tab);
            b.innerHTML = `${name}<small>${counts[name] > 9999 ? `${Math.round(counts[name] / 1000)}k` : counts[name] || ''}</small>`, b.onclick = () => this.choose(name);
            return b;
        }));
        if (!app.world) this.rows = [];
        else this.rows = this.#filtered(this.#all());
        this.paint();
    }
    #all() {
        const { app } = this, { world } = app;
        if (this.tab === 'bodies') return world.bodies.map((body) => ({ body, text: app.nameOf(body) }));
        if (this.tab === 'joints') return world.joints.map((joint) => ({ joint, text: app.nameOf(joint, world.joint(joint).type) }));
        if (this.tab === 'notes') return app.notes.map((n) => ({ step: n.step, ...app.about(n.about), text: n.text, more: n.step }));
        return app.timeline.marks.filter((m) => STEP_TYPES.includes(m.kind)).map((m) => ({ step: m.step, body: m.body, kind: m.kind, text: m.text, more: m.step }));
    }
    #filtered(rows) {
        const { world } = this.app, text = $('search').value.trim().toLowerCase(), filter = $('filter').value;
        const passes = {
            all: () => true, awake: (b) => b.awake, asleep: (b) => !b.awake && b.type === 'dynamic', fast: (b) => { const v = b.linearVelocity; return Math.hypot(v.x, v.y, v.z) > FAST; },
            deep: (b) => b.contacts.some((c) => c.points.slice(0, c.pointCount).some((p) => p.separation < -DEEP)),
            ...Object.fromEntries(['dynamic', 'static', 'kinematic'].map((t) => [t, (b) => b.type === t])),
        }[filter];
        if (text) rows = rows.filter((r) => r.text.toLowerCase().includes(text));
        if (this.tab === 'events' && filter !== 'all') rows = rows.filter((r) => r.kind === filter);
        if (this.tab === 'bodies' && filter !== 'all') rows = rows.filter((r) => passes(world.body(r.body)));
        return rows;
    }
    paint() {
        const { app, height } = this, from = Math.max(0, Math.floor(this.box.scrollTop / height) - 4), to = Math.min(this.rows.length, from + Math.ceil(this.box.clientHeight / height) + 8);
        this.room.style.height = `${this.rows.length * height + 8}px`;
        const out = [];
        for (let k = from; k < to; ++k) {
            const r = this.rows[k], row = document.createElement('div'), dot = document.createElement('i'), text = document.createElement('span'), more = document.createElement('small');
            row.className = 'row', row.dataset.k = k, row.style.top = `${k * height + 4}px`, row.setAttribute('aria-selected', this.#isChosen(r));
            dot.style.background = r.step !== undefined ? MARKS[r.kind] ?? 'var(--warm)' : r.joint ? '#56b4e9' : app.cssOf(r.body);
            text.textContent = r.text, more.textContent = r.more ?? (r.body ? app.formOf(r.body) : '');
            row.append(dot, text, more), out.push(row);
        }
        if (!this.rows.length) {
            const none = document.createElement('div');
            none.className = 'empty', none.textContent = app.world ? `no ${this.tab}${$('search').value ? ' of that name' : ''}` : 'nothing open';
            out.push(none);
        }
        this.room.replaceChildren(...out);
    }
}
const MARKS = { hit: 'var(--faint)', break: 'var(--red)', sleep: '#687080', wake: '#e69f00' };
