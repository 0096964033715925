// player.js - a world that does what a recording says.
import { x, pool, u32, scratch, ok, reset, init, make, bytesIn, listOut, long, wrong, dead, free, dispose } from './runtime.js';
import { World, Store, endOrphans } from './hand.js';
import { $player_def, $player_info, $divergence, AT, NOTE_BYTES, readPlayerInfo, readDivergence, readNote } from './api.js';

const END = 3; // FE_END

export class Player {
    #world; // what `world` gave, until that one is handed over
    constructor(recording, options) {
        reset();
        const { store, ...rest } = options ?? {}, def = make($player_def, scratch + 16, rest, 'options');
        u32[(def + AT.playerPool) >> 2] = pool;
        if (store !== undefined) u32[(def + AT.playerStore) >> 2] = store instanceof Store ? store._s() : wrong('options.store', 'a Store', store);
        ok(x.fe_player_create(def, scratch));
        const p = this._p = u32[scratch >> 2];
        this._shared = store; // lives as long
        free.register(this, () => { x.fe_player_destroy(p); endOrphans(); }, this);
        if (recording !== undefined && recording !== null) this.feed(recording);
    }
    #at() { return this._p || dead('player'); }
    feed(bytes) { reset(); ok(x.fe_player_feed(this.#at(), ...bytesIn(bytes, 'bytes'))); }
    // False: there is no more yet
    step() { return ok(x.fe_player_step(this.#at())) !== END; }
    seek(step) { return ok(x.fe_player_seek(this.#at(), long(step, 'step'))) !== END; }
    *[Symbol.iterator]() { while (this.step()) yield this.world; }
    get world() {
        ok(x.fe_player_get_world(this.#at(), scratch));
        return (this.#world ??= new World({ _p: u32[scratch >> 2], _player: this }));
    }
    release() {
        const { world } = this;
        ok(x.fe_player_release(this.#at(), scratch));
        world._own();
        world._shared = this._shared;
        this.#world = undefined;
        return world;
    }
    get info() { const at = init($player_info, scratch); ok(x.fe_player_get_info(this.#at(), at)); return readPlayerInfo(at); }
    get notes() { reset(); return listOut(NOTE_BYTES, readNote, (at, n) => x.fe_player_get_notes(this.#at(), at, NOTE_BYTES, n)); }
    // The first difference, or null
    get divergence() {
        if (!this.info.hasDiverged) return null;
        const at = init($divergence, scratch);
        ok(x.fe_player_get_divergence(this.#at(), at));
        return readDivergence(at);
    }
    destroy() {
        ok(x.fe_player_destroy(this.#at()));
        free.unregister(this);
        if (this.#world) this.#world._end();
        this._p = 0;
    }
    [dispose]() { if (this._p) this.destroy(); }
}
