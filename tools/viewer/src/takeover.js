// takeover.js - the recording is left: its world goes on by itself, and can be grabbed and thrown at. What happens from
// here on is a recording of its own.
const HERTZ = 4, DAMPING = 1, FORCE = 400, TORQUE = 40; // of the hand: 1/s, 1, N and N m a kg
const SPEED = 25; // m/s of what is thrown

export class TakeOver {
    constructor(app) { this.app = app, this.world = null, this.steps = 0, this.grip = null, this.parts = []; }
    toggle() { this.world ? this.back() : this.begin(); }
    begin() {
        const { app } = this, { playback } = app;
        if (!playback?.ready) return;
        this.from = playback.step, this.dt = playback.dt;
        this.world = playback.player.release();
        this.recorder = this.world.createRecorder(), this.parts = [], this.steps = 0;
        app.playing = true, app.owed = 0;
        app.say(`Taken over at step ${this.from}: drag bodies, V throws a box, G goes back.`, 'warm');
        app.changed();
    }
    // To the recording, where it was left
    back() {
        const { app, from } = this;
        this.end();
        app.playback.goal = null, app.playback.player.seek(from), app.playback.step = from;
        app.pause(), app.changed(), app.say(`Back at step ${from} of the recording. What you did can still be saved.`);
    }
    end() {
        if (!this.world) return;
        this.grip = null, this.#read();
        this.recorder.destroy(), this.world.destroy();
        this.world = null;
    }
    // Another recording is opened: what was done belongs to the last one
    forget() { this.end(), this.parts = []; }
    #read() { const bytes = this.recorder.read(); if (bytes.length) this.parts.push(bytes); }
    bytes() {
        if (this.world) this.#read();
        if (!this.parts.length) return null;
        const out = new Uint8Array(this.parts.reduce((n, p) => n + p.length, 0));
        this.parts.reduce((at, p) => (out.set(p, at), at + p.length), 0);
        return out;
    }
    advance(n) {
        for (let k = 0; k < n; ++k) {
            this.world.step(this.dt), ++this.steps;
            if (this.grip) this.grip.hand.linearVelocity = [0, 0, 0]; // until the pointer moves again
        }
        if (this.steps % 60 === 0) this.#read();
        return true;
    }
    grab(e) {
        if (this.grip) return false;
        const [from, to] = this.app.view.ray(e.clientX, e.clientY), hit = this.world.raycast(from, to);
        const body = hit && this.world.body(hit.body);
        if (body?.type !== 'dynamic') return false;
        const hand = this.world.createBody({ type: 'kinematic', position: hit.point });
        this.world.addMotorJoint(hand, body, HERTZ, DAMPING, FORCE * body.mass, TORQUE * body.mass);
        this.grip = { hand, far: hit.fraction };
        return true;
    }
    drag(e) {
        if (!this.grip) return;
        const [from, to] = this.app.view.ray(e.clientX, e.clientY);
        this.grip.hand.setTarget({ position: from.map((v, k) => v + to[k] * this.grip.far) }, this.dt);
    }
    release() {
        this.grip?.hand.destroy(); // its joint goes with it
        this.grip = null;
    }
    throw() {
        if (!this.world) return;
        const { view } = this.app, [from, to] = view.ray(view.width / 2, view.height / 2, 1);
        const size = Math.max(0.15, Math.min(1, view.range * 0.035));
        const box = this.world.createBody({
            position: from.map((v, k) => v + to[k] * 2 * size),
            linearVelocity: to.map((v) => v * SPEED), angularVelocity: [1, 2, 3],
        });
        box.addBox(size, size, size, { density: 1000 });
        this.app.play();
    }
}
