// recording.js - the bytes of a recording, as they come: whole chunks out of pieces of any size, deflated ones
// unpacked, keyframes and the time step found on the way. The bytes are told in src/recording/recorder.h.
import { chunkSum } from './sum.js';

const HEADER = 40, CHUNK = 32, DEFLATED = 1, MAGIC = [0x46, 0x45, 0x41, 0x52, 0x45, 0x43, 0x4f, 0x1a];
const STEP_OP = 1, HAS_DT = 1;
const MOST = 2 ** 31; // bytes of a chunk, for the module

const inflate = async (bytes) => {
    const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Uint8Array(await new Response(plain).arrayBuffer());
};
const join = (parts) => {
    const out = new Uint8Array(parts.reduce((n, p) => n + p.length, 0));
    let at = 0;
    for (const p of parts) out.set(p, at), at += p.length;
    return out;
};

export class Recording {
    bytes = 0; // that came, whole chunks and not
    keyframes = []; // their steps
    dt = 0; // s, of the first step that tells it
    broken = ''; // why no more is taken
    #tail = new Uint8Array(0);
    #plain = []; // what a player is fed
    #begun = false;

    get left() { return this.#tail.length; } // bytes of a chunk that is not whole yet
    plain() { return (this.#plain = [join(this.#plain)])[0]; }

    // Takes bytes, and gives those that a player may be fed
    async push(piece) {
        if (this.broken) return new Uint8Array(0);
        const given = new Uint8Array(piece), out = [];
        const all = this.#tail.length ? join([this.#tail, given]) : given;
        this.bytes += given.length;
        let at = 0;
        if (!this.#begun) {
            const wrong = MAGIC.findIndex((byte, k) => k < all.length && all[k] !== byte);
            if (wrong >= 0) return this.#break('this is no recording of Feather: its first bytes are others');
            if (all.length < HEADER) return this.#keep(all, 0, out);
            this.#begun = true, at = HEADER;
            out.push(all.subarray(0, HEADER));
        }
        const view = new DataView(all.buffer, all.byteOffset, all.length);
        while (at + CHUNK <= all.length) {
            const type = String.fromCharCode(...all.subarray(at, at + 4)), flags = view.getUint32(at + 4, true);
            const size = Number(view.getBigUint64(at + 8, true)), place = this.bytes - all.length + at;
            if (size > MOST) return this.#break(`the chunk at byte ${place} is said to have ${size} bytes`, out);
            const end = at + CHUNK + Math.ceil(size / 8) * 8;
            if (end > all.length) break;
            let chunk = all.subarray(at, end);
            if (flags & DEFLATED) {
                try {
                    chunk = await this.#unpacked(chunk, size);
                } catch {
                    return this.#break(`the chunk at byte ${place} cannot be unpacked`, out);
                }
            }
            this.#learn(type, Number(view.getBigInt64(at + 24, true)), chunk.subarray(CHUNK));
            out.push(chunk), at = end;
        }
        return this.#keep(all, at, out);
    }
    #keep(all, at, out) {
        this.#tail = all.slice(at);
        const whole = join(out);
        if (whole.length) this.#plain.push(whole);
        return whole;
    }
    #break(why, out = []) {
        this.broken = why;
        return this.#keep(new Uint8Array(0), 0, out);
    }
    async #unpacked(chunk, size) {
        const content = await inflate(chunk.slice(CHUNK, CHUNK + size));
        const plain = new Uint8Array(CHUNK + Math.ceil(content.length / 8) * 8);
        plain.set(chunk.subarray(0, CHUNK)), plain.set(content, CHUNK);
        const view = new DataView(plain.buffer);
        view.setUint32(4, view.getUint32(4, true) & ~DEFLATED, true);
        view.setBigUint64(8, BigInt(content.length), true);
        view.setBigUint64(16, chunkSum(view, content.length), true);
        return plain;
    }
    #learn(type, step, content) {
        if (type === 'KEYF' && this.keyframes.at(-1) !== step) this.keyframes.push(step);
        // The first step of a chunk tells its dt. Where other calls stand before it, that of another chunk will do.
        if (type === 'OPS ' && !this.dt && content[0] === STEP_OP && content[1] & HAS_DT) {
            this.dt = new DataView(content.buffer, content.byteOffset).getFloat32(2, true);
        }
    }
}
