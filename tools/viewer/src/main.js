// main.js - the page: what is open, where it is, what is picked; and the frame that goes on with all of it.
import * as THREE from 'three';
import Feather from 'feather-physics/module';
import { View } from './scene.js';
import { Instances } from './instances.js';
import { Overlays } from './overlays.js';
import { Timeline } from './timeline.js';
import { Outline } from './outline.js';
import { Inspector } from './inspect.js';
import { Plots } from './plots.js';
import { Scanner } from './scanner.js';
import { Recording } from './recording.js';
import { Playback } from './playback.js';
import { Maker, DEMOS } from './demo.js';
import { TakeOver } from './takeover.js';
import { Comparison } from './ab.js';
import { menus } from './menus.js';
import * as load from './load.js';
import { linkOf, wishOf } from './share.js';
import { SLOT } from './series.js';
import * as keys from './keys.js';

const $ = (id) => document.getElementById(id);
const BEHIND = 1; // s behind what comes live, beyond which it goes there at once
const PHONE = 760; // pixels, below which panels lie over the view
const BUDGET = 12; // ms of a frame that steps may take; a world too heavy for that is shown slower
const PANELS = 90; // ms between two updates of text while it plays

class App {
    constructor(module, workerText) {
        this.parts = new Set(['shapes', 'islands', 'sleep']);
        this.notes = [], this.names = new Map(), this.pins = [];
        this.picked = null, this.playing = false, this.following = null;
        this.taken = new TakeOver(this), this.other = new Comparison(this);
        this.view = new View($('view'));
        this.instances = new Instances();
        this.view.scene.add(this.instances.group);
        this.overlays = new Overlays(this.view.scene);
        this.scanner = new Scanner(this, module, workerText);
        this.timeline = new Timeline(this);
        this.inspector = new Inspector(this);
        this.outline = new Outline(this);
        this.plots = new Plots(this);
        this.owed = 0, this.told = 0;
        menus(this), load.listen(this), keys.listen(this), this.#pointer();
        $('theme').onclick = () => this.theme();
        $('banner-close').onclick = () => ($('banner').hidden = true);
        for (const [button, side] of [['outline-button', 'left'], ['inspect-button', 'right']]) {
            $(button).onclick = () => {
                const on = !document.body.classList.contains(side);
                document.body.classList.remove('left', 'right'), document.body.classList.toggle(side, on);
            };
        }
        for (const id of ['bottom', 'left', 'right']) new ResizeObserver(() => this.layout()).observe($(id));
        addEventListener('resize', () => this.layout());
        this.layout(), this.theme(localStorageOf('theme') ?? 'dark');
        requestAnimationFrame((now) => this.#frame(now));
    }

    // ---- what is open ----
    get scanDone() { return !this.growing && this.scanner.ended; }
    get live() { return this.taken.world !== null; }
    get world() { return this.taken.world ?? this.playback?.world ?? null; }
    get first() { return this.live ? 0 : this.playback?.first ?? 0; }
    get last() { return this.live ? this.taken.steps : Math.max(this.playback?.last ?? 0, this.expected ?? 0); }
    get step() { return this.live ? this.taken.steps : this.playback?.step ?? 0; }
    get dt() { return this.live ? this.taken.dt : this.playback?.dt ?? 1 / 60; }
    get goal() { return this.live ? null : this.playback?.goal; }
    get isEndKnown() { return !this.growing && (!!this.playback?.isEndKnown || this.scanDone); }
    get series() { return this.scanner.series; }
    get scanned() { return this.live ? 0 : this.scanner.scanned ?? 0; }

    // Begins a recording whose bytes come piece by piece, until `end`. `place`: see linkOf. `stop` ends what sends them
    begin(name, { place = null, isLive = false, stop = null } = {}) {
        this.stop?.(), this.stop = stop, this.place = place;
        this.taken.forget(), this.other.end(), this.playback?.destroy();
        const recording = (this.recording = new Recording()), playback = (this.playback = new Playback(recording));
        this.maker = null, this.expected = 0, this.growing = this.fresh = true;
        this.isSocket = this.isFollowingEnd = isLive;
        this.wanted = this.startStep, this.startStep = undefined;
        this.fileName = name, this.scanner.clear(), this.owed = 0, this.playing = true;
        this.#empty();
        $('title').textContent = name, $('facts').textContent = '';
        $('banner').hidden = $('loading').hidden = true;
        const isThis = () => this.recording === recording;
        return {
            get bytes() { return recording.bytes; },
            get isOpen() { return isThis(); },
            push: async (bytes) => {
                const whole = await recording.push(bytes);
                if (!isThis()) return;
                if (whole.length) this.#feed(whole);
                if (recording.broken || playback.error) this.say(this.#sentence(), 'bad');
            },
            end: (why = '') => isThis() && this.#ended(why),
        };
    }
    // Nothing of what was open is seen any more
    #empty() {
        this.notes = [], this.names.clear(), this.timeline.marks = [], this.pins = [], this.following = null;
        this.pick(null), this.instances.clear(), this.overlays.clear(), this.view.origin = [0, 0, 0];
        this.outline.show(), this.plots.names(), this.plots.draw(), this.timeline.draw(), this.view.render();
    }
    #ended(why) {
        const { recording, playback } = this;
        this.growing = false, this.stop = null;
        if (this.scanDone) this.expected = 0;
        recording.broken ||= why;
        if (!playback.ready && !recording.broken && !playback.error) {
            const cut = `cut at byte ${recording.bytes}, within its first keyframe: nothing of it plays`;
            recording.broken = recording.bytes ? cut : 'the file is empty';
        }
        this.#arrive(), this.#judge();
    }
    async open(name, stream, size = 0, place = null) {
        const reader = stream.getReader(), stop = () => reader.cancel().catch(() => {});
        const source = this.begin(name, { place, stop });
        let read = 0, why = '';
        try {
            for (;;) {
                const { value, done } = await reader.read();
                if (done || !source.isOpen) break;
                await source.push(value);
                read += value.length;
                if (size > 4e6 && source.isOpen) $('facts').textContent = `${Math.round((100 * read) / size)} % read`;
            }
        } catch (error) {
            why = `cannot be read from byte ${read} on: ${error.message}`;
        } finally {
            source.end(why);
        }
        return this;
    }
    demo(k) {
        const demo = DEMOS[k];
        if (!demo) return this.say(`There is no demo ${k}: they are 0 to ${DEMOS.length - 1}.`, 'bad');
        const maker = new Maker(demo), source = this.begin(demo.name, { place: { demo: k }, stop: () => maker.end() });
        this.maker = { maker, source, busy: false };
        this.expected = demo.steps, this.from = demo.from;
        return undefined;
    }
    // To the step that a link asks for, when it is there, or the recording is known to end before
    #arrive() {
        const { playback, scanner, wanted } = this;
        if (wanted === undefined || !playback.ready) return;
        if (playback.last < wanted && !this.scanDone && (this.growing || scanner.worker)) return;
        this.pause(), this.seek(wanted);
    }
    #feed(bytes) {
        const { playback, scanner } = this;
        playback.feed(bytes);
        if (playback.ready && this.fresh) {
            this.fresh = false;
            scanner.series.first = scanner.scanned = playback.first;
            this.expected = this.maker ? playback.first + this.expected : 0;
            this.#changed(false);
            if (this.from) this.view.direct(...this.from), (this.from = null);
            this.focus();
            if (this.startLook) this.look(this.startLook), (this.startLook = '');
            if (this.wanted !== undefined) this.pause();
        }
        this.#arrive(), scanner.feed(bytes);
        const isBehind = playback.last - playback.step > BEHIND / playback.dt;
        if (this.isFollowingEnd && this.playing && isBehind) playback.seek(playback.last);
        this.#notes();
        this.timeline.draw(), this.plots.draw();
    }
    #notes() {
        const { playback } = this;
        if (playback.player.info.notes === this.notes.length) return;
        this.notes = playback.player.notes;
        this.timeline.marks = this.timeline.marks.filter((m) => m.kind !== 'note');
        for (const n of this.notes) {
            this.timeline.marks.push({ step: n.step, kind: 'note', text: n.text, body: n.about });
            if (n.about && !this.names.has(n.about)) this.names.set(n.about, n.text);
        }
        this.outline.show();
    }
    #sentence() {
        const { recording, playback } = this, to = playback.ready ? `: plays to step ${this.last}` : '';
        if (recording.broken) return recording.broken + to;
        if (playback.error) return playback.error + to;
        return recording.left ? `cut at byte ${recording.bytes}${to}` : '';
    }
    // The head: what the step that is shown has, since a recording may begin in an empty world
    #facts() {
        const { bytes } = this.recording, size = bytes > 1e6 ? `${(bytes / 1e6).toFixed(1)} MB` : `${Math.ceil(bytes / 1e3)} KB`;
        const c = this.world?.counters; // a world that was taken over is no longer the player's
        $('facts').textContent = c ? `${c.bodies} bodies${c.joints ? `, ${c.joints} joints` : ''} · ${size}` : size;
    }
    #judge() {
        const { recording, playback } = this;
        this.#facts();
        const sentence = this.#sentence();
        if (sentence) this.say(sentence, recording.broken || playback.error ? 'bad' : 'warm');
        else if (playback.ready && playback.player.info.foreign) {
            this.say('a library whose results differ has recorded this: it plays, and may go another way', 'warm');
        }
    }
    scanHeard(events) {
        const { marks } = this.timeline, about = {
            hit: (e) => `${this.nameOf(e[2])} hits ${this.nameOf(e[3])}, ${e[4].toFixed(1)} m/s`,
            break: (e) => `${this.nameOf(e[2], 'joint')} breaks`,
            sleep: (e) => `${this.nameOf(e[2])} sleeps`, wake: (e) => `${this.nameOf(e[2])} wakes`,
        };
        if (marks.length < MOST_MARKS) {
            for (const e of events) {
                const [step, kind] = e, body = kind === 'break' ? e[3] : e[2];
                marks.push({ step, kind, body, text: about[kind]?.(e) ?? kind });
            }
        }
        this.marked = true;
    }
    scanEnded(end, error) {
        this.playback?.knows(end), this.#arrive();
        this.marked = true;
        if (error && !this.playback.error) this.say(error, 'bad');
        if (this.scanDone && this.#sentence()) this.#judge();
        if (this.scanDone) this.expected = 0;
    }
    diverged(d) {
        if (this.timeline.marks.some((m) => m.kind === 'divergence' && m.step === d.step)) return;
        this.timeline.marks.push({ step: d.step, kind: 'divergence', body: d.body, text: d.text });
        this.marked = true;
        this.say(`step ${d.step}: ${d.text}`, 'bad');
    }
    async compare(name, bytes) { await this.other.open(name, bytes); }
    takeOver() { this.taken.toggle(); }

    // ---- time ----
    play() {
        this.wanted = undefined;
        if (!this.live && this.isEndKnown && this.step >= this.last && !this.growing) this.seek(this.first);
        this.playing = true, this.owed = 0;
    }
    pause() { this.playing = false, this.isFollowingEnd = false, this.view.dirty = true; }
    toggle() { this.playing ? this.pause() : this.play(); }
    stepBy(n) {
        if (this.live) return this.pause(), n > 0 && this.taken.advance(n), this.#changed(false);
        this.pause();
        return this.seek((this.goal ?? this.step) + n);
    }
    seek(step) {
        if (this.live || !this.playback) return;
        this.isFollowingEnd = this.isSocket && step >= this.last;
        this.playback.seek(step), this.owed = 0, this.wanted = undefined;
    }
    // To the last step; where more comes, on with it
    toEnd() {
        this.seek(this.last);
        if (this.isFollowingEnd) this.playing = true;
    }

    // At once, however long it takes: for scripts
    jump(step) {
        this.pause(), this.seek(step);
        while (this.goal !== null && this.playback.ready) this.playback.work(1000);
        this.changed();
        return this.step;
    }
    #advance(dt) {
        const until = performance.now() + BUDGET, fine = this.timeline.speed <= 1, pb = this.playback;
        this.owed += (dt * this.timeline.speed) / this.dt;
        let moved = false;
        while (this.owed >= 1) {
            if (performance.now() > until) { this.owed = Math.min(this.owed, 1); break; }
            const went = this.live ? this.taken.advance(1) : pb.advance();
            if (!went) { this.#atEnd(); break; }
            --this.owed, moved = true;
            if (fine) this.#take(true);
        }
        if (moved && !fine) this.#take(false);
        return moved;
    }
    #atEnd() {
        this.owed = 0;
        if (this.growing || this.isFollowingEnd) return;
        if (this.timeline.loop) this.seek(this.first);
        else this.playing = false;
    }
    #frame(now) {
        requestAnimationFrame((next) => this.#frame(next));
        const dt = Math.min((now - (this.before ?? now)) / 1000, 0.1);
        this.before = now;
        this.#make();
        let moved = false;
        if (this.goal !== null && this.goal !== undefined) {
            moved = this.playback.work(BUDGET);
            if (moved) this.#take(false);
        } else if (this.playing && this.world) moved = this.#advance(dt);
        if (moved && this.playback?.divergence && !this.live) this.diverged(this.playback.divergence);
        this.view.controls.update(dt);
        if (this.world) this.#draw(moved, now);
        if (this.marked && now - (this.markedAt ?? 0) > 250) {
            this.marked = false, this.markedAt = now;
            this.timeline.draw(), this.plots.draw(), this.plots.show(), this.outline.show();
        }
    }
    #make() {
        const job = this.maker;
        if (!job || job.busy) return;
        const bytes = job.maker.work(this.playback.ready ? 5 : 8), done = job.maker.left === 0;
        job.busy = true;
        job.source.push(bytes).then(() => {
            job.busy = false;
            if (done && this.maker === job) this.maker = null, job.source.end();
        });
    }

    // ---- what is seen ----
    #take(follows) {
        this.instances.take(this.world, this.view.origin, [...this.parts].filter((p) => COLOURS.has(p)), follows);
        this.other.take();
    }
    // The world, or how it is drawn, is another one
    #changed(follows) {
        if (!this.world) return;
        this.#take(follows), this.#lines(), this.#panels(performance.now(), true);
        this.view.dirty = true;
    }
    changed() { this.#changed(false); }
    #lines() {
        const { world, view, overlays } = this, scale = Math.min(0.5, Math.max(0.05, view.range * 0.06));
        overlays.take(world, view.origin, this.parts, scale);
        const body = this.picked?.body, isThere = body && world.body(body).isValid;
        overlays.pick(world, view.origin, isThere ? body : null, this.isDark ? 0xffffff : 0x10202f);
    }
    #draw(moved, now) {
        const { view } = this, drawsLines = LINES.some((p) => this.parts.has(p));
        if (moved) this.#lines(), this.#panels(now, !this.playing), (view.dirty = true);
        const isBetween = this.playing && this.timeline.speed <= 1 && !drawsLines && this.goal === null;
        const part = isBetween ? Math.min(this.owed, 1) : 1;
        if (this.instances.changed) this.instances.draw(part), (view.dirty = true);
        this.other.draw(part);
        if (this.picked?.body) this.overlays.follow(this.instances, this.picked.body);
        if (this.following) this.#track();
        if (view.rebase()) this.#changed(false), this.instances.draw(1);
        if (view.dirty) view.render();
    }
    #track() {
        const k = this.instances.instancesOf(this.following)[0];
        if (k === undefined) return;
        this.instances.matrixOf(k, matrix), place.setFromMatrixPosition(matrix);
        const by = place.sub(this.view.controls.target);
        this.view.controls.target.add(by), this.view.camera.position.add(by);
    }
    #panels(now, force) {
        if (!force && now - this.told < PANELS) return;
        this.told = now;
        this.timeline.show(), this.inspector.show(), this.plots.show(), this.outline.paint();
        const c = this.world.counters;
        const ms = this.world.profile.step.toFixed(2);
        const isFiltered = this.outline.tab === 'bodies' && $('filter').value !== 'all';
        $('told').textContent = `${c.awakeBodies} awake · ${c.contacts} contacts · ${ms} ms a step`;
        if (c.bodies === this.bodies && c.joints === this.joints && !(force && isFiltered)) return;
        this.bodies = c.bodies, this.joints = c.joints, this.outline.show(), this.#facts();
    }
    panels() { this.#panels(performance.now(), true); }
    layout() {
        document.documentElement.style.setProperty('--bottom', `${$('bottom').offsetHeight}px`);
        const shown = (id) => (getComputedStyle($(id)).display === 'none' ? null : $(id).getBoundingClientRect());
        const wide = innerWidth > PHONE, left = wide && shown('left'), right = wide && shown('right');
        const [top, bottom] = ['top', 'bottom'].map((id) => $(id).getBoundingClientRect());
        this.view.centre(left ? left.right : 0, top.bottom, right ? right.left : innerWidth, bottom.top);
    }
    show(part, on = !this.parts.has(part)) {
        on ? this.parts.add(part) : this.parts.delete(part);
        this.menu?.(), this.changed();
    }
    theme(name = this.isDark ? 'light' : 'dark') {
        this.isDark = name === 'dark', document.documentElement.dataset.theme = name;
        try { localStorage.theme = name; } catch { /* a page from a file may have none */ }
        this.view.look(name), this.timeline.draw(), this.plots.draw();
        if (this.world) this.#lines();
    }
    say(text, kind = '') {
        $('banner').hidden = false, $('banner').className = kind, $('banner-text').textContent = text;
    }
    async copy(text, button) {
        try {
            await navigator.clipboard.writeText(text);
        } catch { // no clipboard without a secure page
            const area = document.createElement('textarea');
            area.value = text, document.body.append(area), area.select(), document.execCommand('copy'), area.remove();
        }
        this.copied = text;
        if (!button) return;
        const old = button.textContent;
        button.textContent = 'Copied', setTimeout(() => (button.textContent = old), 900);
    }

    // ---- sharing ----
    bytes() { return this.taken.bytes() ?? this.recording?.plain() ?? new Uint8Array(0); }
    link() {
        const { camera, controls, origin } = this.view;
        const numbers = [...camera.position.toArray(), ...controls.target.toArray()];
        return linkOf(location.href, this.place, this.step, numbers.map((v, k) => v + origin[k % 3]));
    }
    async copyLink() {
        await this.copy(this.link());
        const without = this.place ? '' : ' It has no recording in it: send the file too, to be dropped there.';
        this.say(`The link is copied.${without}`);
    }
    look(text) {
        const n = text.split('_').map((v, k) => Number(v) - this.view.origin[k % 3]);
        if (n.length !== 6 || !n.every(Number.isFinite)) return;
        const { camera, controls } = this.view;
        camera.position.set(...n.slice(0, 3)), controls.target.set(...n.slice(3)), controls.update();
    }

    // ---- what is picked ----
    pick(what) {
        this.picked = what;
        const { classList } = document.body;
        if (what && innerWidth <= PHONE && !classList.contains('left')) classList.add('right');
        if (!what) classList.remove('right');
        if (!this.world) return this.inspector.show();
        this.#lines(), this.inspector.show(), this.outline.show(), (this.view.dirty = true);
        return undefined;
    }
    pickAt(x, y) {
        const hit = this.world?.raycast(...this.view.ray(x, y));
        this.pick(hit ? { body: hit.body } : null);
        return hit;
    }
    #bodies() {
        const p = this.picked;
        if (p?.body) return [p.body];
        if (!p?.joint || !this.world.joint(p.joint).isValid) return [];
        const { bodyA, bodyB } = this.world.joint(p.joint).getBodies();
        return [bodyA, bodyB].filter(Boolean);
    }
    focus() {
        if (!this.world) return;
        const box = new THREE.Box3();
        for (const body of this.#bodies()) box.union(this.instances.bounds(body));
        const all = this.instances.bounds();
        this.view.range = Math.max(all.getSize(new THREE.Vector3()).length() / 2, 1);
        this.view.frame(box.isEmpty() ? all : box, box.isEmpty() ? 0.95 : 2.2);
    }
    follow() { this.following = this.following || !this.picked?.body ? null : this.picked.body, this.inspector.show(); }
    #pointer() {
        const canvas = $('view'), { taken, view } = this;
        let down = null, holds = null; // where it went down; the pointer that holds a body
        canvas.addEventListener('pointerdown', (e) => {
            for (const menu of document.querySelectorAll('details[open]')) menu.open = false;
            down = { x: e.clientX, y: e.clientY };
            if (!this.live || e.button !== 0 || !taken.grab(e)) return;
            canvas.setPointerCapture(e.pointerId), (holds = e.pointerId); // it may let go outside of the page
            view.controls.enabled = false;
        }, true);
        canvas.addEventListener('pointermove', (e) => this.live && e.pointerId === holds && taken.drag(e));
        const up = (e) => {
            if (e.pointerId === holds) taken.release(), (holds = null), (view.controls.enabled = true);
            const isClick = e.type === 'pointerup' && down && e.button === 0;
            if (isClick && Math.hypot(e.clientX - down.x, e.clientY - down.y) < 5) this.pickAt(e.clientX, e.clientY);
            down = null;
        };
        canvas.addEventListener('pointerup', up);
        canvas.addEventListener('pointercancel', up);
        canvas.addEventListener('dblclick', () => this.picked && this.focus());
    }

    // ---- names and colours ----
    // What a note calls it; else its number in the order of creation, as far as the slot tells it
    nameOf(id, kind = 'body') { return this.names.get(id) ?? `${kind} ${id % SLOT}`; }
    about(id) {
        if (!id || !this.world) return {};
        if (this.world.body(id).isValid) return { body: id };
        return this.world.joint(id).isValid ? { joint: id } : {};
    }
    cssOf(body) {
        const c = this.instances.colourOf(body);
        return `rgb(${c & 255} ${(c >> 8) & 255} ${(c >> 16) & 255})`;
    }
    formOf(body) {
        const list = this.instances.instancesOf(body);
        return list.length === 1 ? this.instances.bucketOf[list[0]].kind : list.length ? `${list.length} shapes` : '';
    }

    // ---- pinned values ----
    #pinOf(path) {
        const p = this.picked;
        return this.pins.find((n) => n.path === path && n.body === p?.body && n.joint === p?.joint);
    }
    isPinned(path) { return !!this.#pinOf(path); }
    pin(path) {
        const found = this.#pinOf(path), p = this.picked;
        const of = this.nameOf(p.body ?? p.joint, p.joint ? 'joint' : 'body');
        const name = `${of} ${path.replace(/^(state|reaction)\./, '')}`;
        if (found) this.pins = this.pins.filter((n) => n !== found), this.plots.on.delete(found.name);
        else this.pins.push({ ...p, path, name }), this.plots.on.add(name);
        this.timeline.marks = this.timeline.marks.filter((m) => KEPT.has(m.kind)); // the worker tells all others again
        this.scanner.pin(this.pins);
        if (!this.plots.open) this.plots.toggle(true);
        this.plots.names(), this.inspector.show();
    }
}
const COLOURS = new Set(['shapes', 'islands', 'sleep']);
const LINES = ['contacts', 'forces', 'joints', 'limits', 'bounds', 'centres', 'trees'];
const MOST_MARKS = 60000, KEPT = new Set(['note', 'divergence']);
const matrix = new THREE.Matrix4(), place = new THREE.Vector3();
const localStorageOf = (key) => { try { return localStorage[key]; } catch { return undefined; } };

async function begin() {
    const packed = Uint8Array.from(atob($('module').textContent.trim()), (c) => c.charCodeAt(0));
    const plain = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
    const module = await WebAssembly.compile(await new Response(plain).arrayBuffer());
    await Feather(module);
    const app = (window.viewer = new App(module, $('worker-text').textContent));
    $('loading').hidden = true;
    const wish = wishOf(location.search, location.hash);
    app.startStep = wish.step, app.startLook = wish.camera;
    if (wish.url !== null) await load.openUrl(app, wish.url);
    else if (wish.ws !== null) load.openSocket(app, wish.ws);
    else if (wish.demo !== 'none') app.demo(Number(wish.demo));
}
begin().catch((error) => {
    $('loading').hidden = false, $('loading').textContent = `The viewer cannot start: ${error.message}`;
});
