// recorder.js - a recording of a world while it grows.
import { x, u64, scratch, ok, reset, temp, bytesWritten, textIn, handle, dead, free, dispose } from './runtime.js';

export class Recorder {
    constructor(world, p) {
        this.world = world, this._p = p;
        free.register(this, () => x.fe_recorder_destroy(p), this);
    }
    #at() { return this._p || dead('recorder'); }
    read(into) {
        const p = this.#at(), call = (at, n) => (ok(x.fe_recorder_read(p, at, BigInt(n), scratch)), Number(u64[scratch >> 3]));
        reset();
        const size = call(0, 0), at = temp(size);
        return bytesWritten(at, size && call(at, size), into, 'into');
    }
    note(text, about) {
        reset();
        ok(x.fe_recorder_note(this.#at(), handle(about, 'about'), textIn(text, 'text')));
    }
    destroy() {
        ok(x.fe_recorder_destroy(this.#at()));
        free.unregister(this);
        this._p = 0;
    }
    [dispose]() { if (this._p) this.destroy(); }
}
