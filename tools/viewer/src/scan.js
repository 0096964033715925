// scan.js - a worker that plays the recording by itself, as fast as it can, and tells of each step what the plots show.
// It has a module of its own. Numbers of a step: those of COLUMNS in series.js, then the pinned ones.
import Feather, { Player } from 'feather-physics/module';
import { x, u32, f32, u64, scratch, temp, reset } from 'feather-physics/core.js';
import { COLUMNS, readPin } from './series.js';

const BATCH = 60, MS = 40; // steps, ms between two messages at most
// Of fe_contact and fe_joint_state, bytes
const CONTACT = 272, POINT_COUNT = 60, POINTS = 64, POINT = 40, SEPARATION = 24, LINEAR_ERROR = 60, JOINT_STATE = 68;
const MOST_JOINTS = 4000, PHASES = COLUMNS.filter((c) => c.phase).map((c) => c.phase);

let player, pins = [], generation = 0, running = false, dead = false, begun = false, queue = Promise.resolve();
const fed = [];

// The deepest overlap of what moved, m
function deepest(world, moved) {
    let least = 0;
    reset();
    const room = 64, at = temp(CONTACT * room);
    for (let k = 0; k < moved.count; ++k) {
        const n = Math.min(x.fe_body_get_contacts(world._w(), BigInt(moved.ids[k]), at, CONTACT, room), room);
        for (let c = 0; c < n; ++c) {
            const from = at + c * CONTACT, points = u32[(from + POINT_COUNT) >> 2];
            for (let p = 0; p < points; ++p) {
                least = Math.min(least, f32[(from + POINTS + p * POINT + SEPARATION) >> 2]);
            }
        }
    }
    return -least;
}
function widest(world) {
    const joints = world.counters.joints;
    if (joints > MOST_JOINTS) return NaN; // it would take longer than the step: no value, not a small one
    let most = 0;
    for (const joint of world.joints) {
        u32[scratch >> 2] = JOINT_STATE;
        if (x.fe_joint_get_state(world._w(), BigInt(joint), scratch) < 0) continue;
        most = Math.max(most, f32[(scratch + LINEAR_ERROR) >> 2]);
    }
    return most;
}
function numbers(world) {
    const c = world.counters, e = world.energy, moved = world.getMoved();
    const p = world.getMomentum([0, 0, 0]).linear;
    const { profile } = world, list = [
        e.kinetic, e.potential, deepest(world, moved) * 1e3, widest(world) * 1e3, c.awakeBodies, c.contacts,
        Math.hypot(p.x, p.y, p.z), profile.step, world.hitEvents.length,
        ...PHASES.map((phase) => profile[phase]),
    ];
    for (const pin of pins) list.push(readPin(world, pin));
    return list;
}
function step() {
    try {
        return player.step();
    } catch (error) {
        if (error.code !== 'FE_ERROR_DIVERGED') throw error;
        postMessage({ generation, divergence: player.divergence });
        return true;
    }
}
function begin() {
    const { info } = player;
    if (!info.keyframes) return false;
    player.seek(info.firstStep);
    return true;
}
async function run() {
    if (running || !player) return;
    running = true;
    const mine = generation;
    let rows = [], steps = [], events = [], last = performance.now();
    const send = (end) => {
        if (steps.length || end) postMessage({ generation: mine, steps, rows, events, end, fed: fed.length });
        rows = [], steps = [], events = [], last = performance.now();
    };
    const tell = () => {
        const { world } = player, at = player.info.step, row = numbers(world);
        steps.push(at), rows.push(...row);
        for (const e of world.jointEvents) events.push([at, 'break', e.joint, e.bodyA, e.bodyB]);
        for (const e of world.bodyEvents) events.push([at, e.kind, e.body]);
        for (const e of world.hitEvents) events.push([at, 'hit', e.bodyA, e.bodyB, e.speed, e.impulse]);
    };
    try {
        if (!begun) {
            if (!begin()) { running = false; return; }
            begun = true, tell();
        }
        for (;;) {
            const more = step();
            if (more) tell();
            if (!more) { send(player.info.step); break; }
            if (steps.length >= BATCH || performance.now() - last > MS) {
                send();
                await new Promise((go) => setTimeout(go));
                if (mine !== generation) break;
            }
        }
    } catch (error) {
        dead = true, send(); // what it has found up to there
        postMessage({ generation: mine, error: error.message, end: player.info.step });
    }
    running = false;
    if (mine !== generation && !dead) run();
}
function renew() {
    player?.destroy();
    player = new Player(), begun = false;
    for (const bytes of fed) give(bytes);
}
function give(bytes) {
    try {
        player.feed(bytes);
    } catch (error) {
        if (!error.code) throw error; // what the library refuses the page has heard from its own player
    }
}
// What cannot go on at all: the page makes another worker
const fail = (error) => postMessage({ failed: error.message });

async function hear(data) {
    if (data.module) await Feather(data.module);
    if (data.generation !== undefined) generation = data.generation, pins = data.pins, dead = false;
    if (data.clear) fed.length = 0;
    if (data.generation !== undefined) renew();
    if (data.feed) fed.push(data.feed), give(data.feed);
    if (fed.length) run().catch(fail);
}
onmessage = ({ data }) => (queue = queue.then(() => hear(data)).catch(fail)); // in their order, the module first
