// playback.js - a player, and where it is on its way: seeks are cut into slices, so that the page never stands still.
import { Player } from 'feather-physics/module';

const SECONDS = 1 / 60; // of a step, when the recording does not say it

export class Playback {
    constructor(recording) {
        this.recording = recording, this.player = new Player(), this.goal = null;
        this.first = 0, this.step = 0, this.last = 0, this.isEndKnown = false, this.ended = false;
        this.divergence = null, this.error = '';
    }
    get dt() { return this.recording.dt || SECONDS; }
    get world() { return this.ready ? this.player.world : null; }

    feed(bytes) {
        if (!bytes.length || this.error) return;
        this.#try(() => this.player.feed(bytes));
        const info = this.player.info;
        this.ended = false;
        if (!this.ready && info.keyframes) {
            this.first = info.firstStep;
            this.ready = this.#try(() => this.player.seek(info.firstStep)) !== undefined;
        }
        this.#note();
    }
    // What the library refuses is told once; what stood before it plays. Undefined: this call was refused
    #try(call) {
        try {
            return call();
        } catch (error) {
            if (error.code === 'FE_ERROR_DIVERGED') return (this.divergence ??= this.player.divergence), true;
            if (!error.code) throw error;
            this.error ||= error.message;
            return undefined;
        }
    }
    #note() {
        const info = this.player.info;
        this.step = info.step, this.last = Math.max(this.last, info.lastStep, info.step);
        if (this.ended) this.last = info.step, this.isEndKnown = true;
    }
    // Another one has found where it ends
    knows(end) { this.last = Math.max(this.last, end); }

    // One step. False at the end
    advance() {
        if (!this.ready) return false;
        const went = this.#try(() => this.player.step());
        this.ended = !went;
        this.#note();
        return !!went;
    }
    // What is no number is no place
    seek(step) {
        const goal = Math.min(Math.max(Math.round(step), this.first), this.last);
        if (!Number.isNaN(goal)) this.goal = goal;
    }
    // Towards the goal for `ms`. True when the world is another one
    work(ms) {
        if (this.goal === null || !this.ready) return false;
        const until = performance.now() + ms, goal = this.goal;
        const frame = this.recording.keyframes.findLast((k) => k <= goal) ?? this.first;
        let moved = false;
        if (goal < this.step || frame > this.step) {
            const went = this.#try(() => this.player.seek(Math.min(frame, goal)));
            this.ended = false, this.#note();
            this.ended = went === undefined, moved = true; // refused on the way: where it ends is not known by that
        }
        while (!this.ended && this.step < goal && performance.now() < until && this.advance()) moved = true;
        if (this.step >= goal || this.ended) this.goal = null;
        return moved;
    }
    // At once, however long it takes
    goTo(step) {
        this.seek(step);
        while (this.goal !== null && this.ready) this.work(1000);
    }
    destroy() { this.player.destroy(), this.ready = false; }
}
