// ab.js - a second world beside the first: another recording, or the same world with other settings from here on. It is
// drawn see-through, and the first difference is named.
import { compareSnapshots } from 'feather-physics/module';
import { Instances } from './instances.js';
import { Playback } from './playback.js';
import { Recording } from './recording.js';

const GHOST = 86 | (180 << 8) | (233 << 16) | (110 << 24), SLICE = 8; // ms

export class Comparison {
    constructor(app) { this.app = app, this.world = null, this.shift = 0, this.told = ''; }
    async open(name, bytes) {
        const { app } = this, recording = new Recording();
        if (!app.playback?.ready) return app.say('Open a recording first, then the one to compare it with.', 'bad');
        this.end();
        const whole = await recording.push(bytes), playback = new Playback(recording);
        playback.feed(whole);
        const why = recording.broken || playback.error || 'nothing of it plays';
        if (!playback.ready) return app.say(`${name}: ${why}`, 'bad');
        this.playback = playback, this.bytes = whole, this.name = name;
        this.#align();
        this.#show();
        return this.#search();
    }
    // The same step of both; where neither has a step of the other, as many steps from its own first
    #align() {
        const { app, playback: b } = this, meet = b.first <= app.last && app.first <= b.last;
        this.shift = meet ? 0 : b.first - app.first;
        const told = `The two have no step in common: step ${app.first} here is shown beside ${b.first} there. `;
        this.told = meet ? '' : told;
    }
    // From this step on, with twice the substeps, and without the calls that the recording has later
    settings() {
        const { app } = this;
        if (!app.playback?.ready || app.live) return;
        this.end();
        this.isOther = true, this.#make(), this.#show();
        const { substeps } = this.world;
        const how = `with ${substeps} substeps instead of ${app.world.substeps}`;
        app.say(`See-through: the same world from step ${app.step} on ${how}.`);
    }
    #make() {
        const { app } = this, b = new Playback(app.recording);
        b.feed(app.recording.plain()), b.knows(app.step), b.goTo(app.step);
        this.world?.destroy();
        this.world = b.player.release(), b.destroy();
        this.world.substeps = 2 * this.world.substeps;
        this.at = app.step;
    }
    #show() {
        this.instances = new Instances(GHOST);
        this.app.view.scene.add(this.instances.group);
        this.take();
    }
    get second() { return this.isOther ? this.world : this.playback?.world; }
    // The first world has gone on, or elsewhere
    take() {
        if (!this.instances || this.app.live) return;
        const { app } = this;
        if (this.isOther) {
            if (app.step < this.at || app.step > this.at + 60) this.#make();
            for (; this.at < app.step; ++this.at) this.world.step(app.dt);
        } else {
            const step = app.step + this.shift;
            this.playback.knows(step), this.playback.goTo(step);
        }
        this.instances.take(this.second, app.view.origin, ['shapes'], false);
    }
    draw(part) { this.instances?.draw(part); }
    // Two players of their own, step by step, until they differ
    async #search() {
        const { app, shift } = this, mine = (this.mark = {}), start = Math.max(app.first, this.playback.first - shift);
        const of = (recording, bytes, step) => {
            const p = new Playback(recording);
            p.feed(bytes), p.knows(step), p.seek(step);
            return p;
        };
        const a = of(app.recording, app.recording.plain(), start);
        const b = of(this.playback.recording, this.bytes, start + shift);
        const players = [a, b], end = () => players.forEach((p) => p.destroy());
        for (let until = performance.now() + SLICE; ; ) {
            const late = players.find((p) => p.goal !== null); // on its way to where both begin
            if (late) late.work(SLICE);
            else if (a.world.hash !== b.world.hash) {
                const [left, right] = players.map((p) => p.world.save({ flags: 'assets' })), { step } = a;
                end();
                const d = compareSnapshots(left, right);
                if (d) return this.#tell(step, d);
                return app.say(`${this.told}The two differ first at step ${step}.`, 'warm');
            } else {
                const more = players.map((p) => p.advance());
                if (!more[0] || !more[1]) return end(), app.say(this.told + sentence(more, a.step - start, players));
            }
            if (performance.now() > until) {
                await new Promise((go) => setTimeout(go));
                if (this.mark !== mine) return end();
                until = performance.now() + SLICE;
            }
        }
    }
    #tell(step, d) {
        const { app } = this, of = d.handle ? app.nameOf(d.handle, d.kind) : d.kind;
        const isVector = d.element || /position|velocity|rotation/.test(d.field);
        const field = d.field + (isVector ? ` ${'xyzw'[d.element] ?? d.element}` : '');
        this.difference = { step, ...d };
        app.timeline.marks.push({ step, kind: 'divergence', body: d.handle, text: `${of}: ${field}` });
        app.marked = true;
        const told = `${this.told}The two differ first at step ${step}: `;
        app.say(`${told}${of}, ${field} is ${d.a} here, ${d.b} there.`, 'warm');
        if (d.kind === 'body') app.pick({ body: d.handle });
    }
    end() {
        this.mark = null, this.difference = null;
        if (this.instances) {
            this.app.view.scene.remove(this.instances.group), this.instances.clear();
            this.instances = null;
        }
        if (this.isOther) this.world?.destroy();
        this.playback?.destroy();
        this.world = this.playback = null, this.isOther = false;
    }
}
// Of two that are alike; `more` tells which of them goes on
function sentence(more, steps, [a, b]) {
    if (more[0] === more[1]) return `The two are the same, bit for bit, for ${steps} steps.`;
    const [which, end] = more[0] ? ['second', b.step] : ['first', a.step];
    return `The two are the same, bit for bit, as far as the ${which} one goes: to step ${end}.`;
}
