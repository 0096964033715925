// scanner.js - the worker of scan.js, and what it has found: series, events, the end, divergences.
import { COLUMNS, Series } from './series.js';

export class Scanner {
    constructor(app, module, text) {
        this.app = app, this.module = module, this.series = new Series();
        this.generation = 0, this.pins = [], this.scanned = this.fed = 0, this.ended = this.failed = false;
        this.address = URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
        this.#begin();
    }
    #begin() {
        try {
            this.worker = new Worker(this.address);
        } catch {
            this.worker = null; // a page that allows no workers plays all the same, without plots
            return;
        }
        this.worker.onmessage = ({ data }) => this.#hear(data);
        this.worker.onerror = (e) => this.#fail(e.message);
        this.worker.postMessage({ module: this.module });
    }
    // Nothing more of this recording is plotted; the next one has a new worker
    #fail(why) {
        if (this.failed) return;
        this.worker.terminate(), this.#begin();
        this.failed = this.ended = true;
        this.app.scanEnded(this.scanned, `Plots end at step ${this.scanned}: their worker has failed: ${why}`);
    }
    // All messages after this one are about another recording, or have other pins
    #renew(message) { this.worker?.postMessage({ ...message, generation: ++this.generation }); }
    clear(first = 0) {
        this.series = new Series(first), this.pins = [], this.scanned = first, this.fed = 0;
        this.ended = this.failed = false;
        this.#renew({ clear: true, pins: [] });
    }
    feed(bytes) {
        ++this.fed;
        if (!this.failed) this.ended = false, this.worker?.postMessage({ feed: bytes });
    }
    pin(pins) {
        if (this.failed) return;
        this.pins = pins, this.ended = false;
        this.series = new Series(this.series.first);
        this.#renew({ pins: pins.map(({ body, joint, path }) => ({ body, joint, path })) });
    }
    #hear(data) {
        const { app } = this;
        if (data.failed) return this.#fail(data.failed);
        if (data.generation !== this.generation) return;
        if (data.divergence) return app.diverged(data.divergence);
        if (data.error) return (this.ended = true), app.scanEnded(data.end, data.error);
        const width = COLUMNS.length + this.pins.length;
        data.steps.forEach((step, k) => this.series.put(step, data.rows, k * width, width));
        if (data.steps.length) this.scanned = data.steps.at(-1);
        app.scanHeard(data.events);
        // The end of what it was fed: more may be on its way
        if (data.end !== undefined) this.ended = data.fed === this.fed, app.scanEnded(data.end);
    }
}
