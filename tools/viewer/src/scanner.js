// scanner.js - the worker of scan.js, and what it has found: series, events, the end, divergences.
import { COLUMNS, Series } from './series.js';

export class Scanner {
    constructor(app, module, text) {
        this.app = app, this.series = new Series();
        this.generation = 0, this.pins = [], this.fed = 0, this.ended = false;
        try {
            this.worker = new Worker(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })));
        } catch {
            this.worker = null; // a page that allows no workers plays all the same, without plots
            return;
        }
        this.worker.onmessage = ({ data }) => this.#hear(data);
        this.worker.postMessage({ module });
    }
    clear(first = 0) {
        ++this.generation, this.series = new Series(first), this.pins = [];
        this.scanned = first, this.fed = 0, this.ended = false;
        this.worker?.postMessage({ clear: true });
    }
    feed(bytes) { ++this.fed, this.ended = false, this.worker?.postMessage({ feed: bytes }); }
    pin(pins) {
        ++this.generation, this.pins = pins, this.ended = false;
        this.series = new Series(this.series.first);
        this.worker?.postMessage({ pins: pins.map(({ body, joint, path }) => ({ body, joint, path })) });
    }
    #hear(data) {
        const { app } = this;
        if (data.divergence) return app.diverged(data.divergence);
        if (data.error) return (this.ended = true), app.scanEnded(data.end, data.error);
        if (data.generation !== this.generation) return;
        const width = COLUMNS.length + this.pins.length;
        data.steps.forEach((step, k) => this.series.put(step, data.rows, k * width, width));
        if (data.steps.length) this.scanned = data.steps.at(-1);
        app.scanHeard(data.events);
        // The end of what it was fed: more may be on its way
        if (data.end !== undefined) this.ended = data.fed === this.fed, app.scanEnded(data.end);
    }
}
