// ab.js - a second world beside the first: another recording, or the same world with other settings from here on. It is
// drawn see-through, and the first difference is named.
import { compareSnapshots } from 'feather-physics/module';
import { Instances } from './instances.js';
import { Playback } from './playback.js';
import { Recording } from './recording.js';

const GHOST = 86 | (180 << 8) | (233 << 16) | (110 << 24), SLICE = 8; // ms

export class Comparison {
    constructor(app) { this.app = app, this.world = null; }
    async open(name, bytes) {
        const { app } = this, recording = new Recording();
        if (!app.playback?.ready) return app.say('Open a recording first, then the one to compare it with.', 'bad');
        this.end();
        const whole = await recording.push(bytes), playback = new Playback(recording);
        playback.feed(whole);
        if (!playback.ready) return app.say(`${name}: ${recording.broken || playback.error || 'nothing of it plays'}`, 'bad');
        this.playback = playback, this.bytes = whole, this.name = name;
        this.#show();
        return this.#search();
    }
    // From this step on, with twice the substeps, and without the calls that the recording has later
    settings() {
        const { app } = this;
        if (!app.playback?.ready || app.live) return;
        this.end();
        this.isOther = true, this.#make(), this.#show();
        app.say(`See-through: the same world from step ${app.step} on with ${this.world.substeps} substeps instead of ${app.world.substeps}.`);
    }
    #make() {
        const { app } = this, b = new Playback(app.recording);
        b.feed(app.recording.plain()), b.player.seek(app.step);
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
        const { app } = this, ahead = app.step - app.first;
        if (this.isOther) {
            if (app.step < this.at || app.step > this.at + 60) this.#make();
            for (; this.at < app.step; ++this.at) this.world.step(app.dt);
        } else {
            this.playback.seek(this.playback.first + ahead);
            while (this.playback.goal !== null) this.playback.work(1000);
        }
        this.instances.take(this.second, app.view.origin, ['shapes'], false);
    }
    draw(part) { this.instances?.draw(part); }
    // Two players of their own, step by step, until they differ
    async #search() {
        const { app } = this, mine = (this.mark = {}), players = [app.recording.plain(), this.bytes].map((bytes) => { const p = new Playback(new Recording()); p.feed(bytes); return p; });
        const end = () => players.forEach((p) => p.destroy());
        for (let until = performance.now() + SLICE; ; ) {
            const [a, b] = players;
            if (a.world.hash !== b.world.hash) {
                const d = compareSnapshots(a.world.save({ flags: 'assets' }), b.world.save({ flags: 'assets' })), step = a.step;
                end();
                if (d) return this.#tell(step, d);
                return app.say(`The two differ first at step ${step}.`, 'warm');
            }
            const more = players.map((p) => p.advance());
            if (!more[0] || !more[1]) {
                end();
                return app.say(more[0] === more[1] ? `The two are the same, bit for bit, for ${a.step - a.first} steps.` : `The two are the same, bit for bit, as far as the ${more[0] ? 'second' : 'first'} one goes: to step ${more[0] ? b.step : a.step}.`);
            }
            if (performance.now() > until) {
                await new Promise((go) => setTimeout(go));
                if (this.mark !== mine) return end();
                until = performance.now() + SLICE;
            }
        }
    }
    #tell(step, d) {
        const { app } = this, of = d.handle ? app.nameOf(d.handle, d.kind === 'body' ? 'body' : d.kind) : d.kind, element = d.element || /position|velocity|rotation/.test(d.field) ? ` ${'xyzw'[d.element] ?? d.element}` : '';
        this.difference = { step, ...d };
        app.timeline.marks.push({ step, kind: 'divergence', body: d.handle, text: `${of}: ${d.field}${element}` }), (app.marked = true);
        app.say(`The two differ first at step ${step}: ${of}, ${d.field}${element} is ${d.a} here, ${d.b} there.`, 'warm');
        if (d.kind === 'body') app.pick({ body: d.handle });
    }
    end() {
        this.mark = null, this.difference = null;
        if (this.instances) this.app.view.scene.remove(this.instances.group), this.instances.clear(), (this.instances = null);
        if (this.isOther) this.world?.destroy();
        this.playback?.destroy();
        this.world = this.playback = null, this.isOther = false;
    }
}
