// inspect.js - the right panel: every value of the body or joint that is picked, with its unit.
import { codeOf } from './code.js';
import { testOf } from './testcode.js';

const DEGREES = 180 / Math.PI;
const escape = (s) => String(s).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
// As many digits as help; all of them are in the tooltip
export function shown(v) {
    if (typeof v !== 'number') return escape(v);
    if (!Number.isFinite(v)) return v > 0 ? '∞' : v < 0 ? '−∞' : '–';
    const a = Math.abs(v);
    if (a >= 1e15) return '∞';
    const text = Number.isInteger(v) && a < 1e7 ? String(v) : a === 0 ? '0' : a >= 1e6 || a < 1e-4 ? v.toExponential(2) : v.toFixed(a >= 1000 ? 1 : a >= 100 ? 2 : a >= 10 ? 3 : 4);
    return text.replace('-', '−');
}
// The numbers of a vector with as many decimals as the largest of them deserves
const xyz = (v) => {
    const keys = ['x', 'y', 'z', 'w'].filter((k) => k in v), most = Math.max(...keys.map((k) => Math.abs(v[k])));
    if (!(most < 1e5) || (most < 1e-3 && most > 0)) return keys.map((k) => shown(v[k])).join('&ensp;');
    const digits = most === 0 || keys.every((k) => Number.isInteger(v[k])) ? 0 : most >= 1000 ? 1 : most >= 100 ? 2 : most >= 10 ? 3 : 4;
    return keys.map((k) => v[k].toFixed(digits).replace(/^-(0\.?0*)$/, '$1').replace('-', '−')).join('&ensp;');
};
const raw = (v) => (typeof v === 'object' ? ['x', 'y', 'z', 'w'].filter((k) => k in v).map((k) => v[k]).join(', ') : v);
const length = (v) => Math.hypot(v.x, v.y, v.z);
export function eulerOf({ x, y, z, w }) { // about x, then y, then z
    return { x: Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)) * DEGREES, y: Math.asin(Math.max(-1, Math.min(1, 2 * (w * y - z * x)))) * DEGREES,
        z: Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) * DEGREES };
}
const axes = (bits) => ['X', 'Y', 'Z'].filter((_, k) => bits & (1 << k)).join(' ') || 'none';
const hex = (n) => '0x' + (n >>> 0).toString(16);

const TEST_BUTTON = '<button data-do="test" title="a C program: it plays the recording to this step and compares">Copy as a test</button>';

export class Inspector {
    constructor(app) {
        this.app = app, this.box = document.getElementById('inspector'), this.html = '';
        this.box.onclick = (e) => {
            const to = e.target.closest('[data-body], [data-joint], [data-pin], [data-do]');
            if (!to) return;
            const { body, joint, pin } = to.dataset;
            if (pin) app.pin(pin);
            else if (to.dataset.do) this.#act(to.dataset.do, to);
            else app.pick(body ? { body: Number(body) } : { joint: Number(joint) });
        };
    }
    show() {
        const { app } = this, { picked, world } = app;
        let html = '';
        if (picked && world) {
            try {
                const thing = picked.body ? world.body(picked.body) : world.joint(picked.joint);
                html = !thing.isValid ? `<h2>${escape(app.nameOf(picked.body ?? picked.joint))}</h2><div class="under">is not there at step ${app.step}</div>` : picked.body ? this.#body(thing) : this.#joint(thing);
            } catch (error) {
                html = `<div class="under">${escape(error.message)}</div>`;
            }
        } else if (world) html = this.#world(world);
        if (html !== this.html) this.box.innerHTML = this.html = html;
    }
    #value(name, text, unit, path, exact) {
        const pin = path && this.app.picked ? `<button data-pin="${path}" aria-pressed="${this.app.isPinned(path)}" title="Plot it">◉</button>` : '';
        return `<div class="value">${pin}<label>${name}</label><output title="${escape(exact ?? '')}">${text}${unit ? `<small>${unit}</small>` : ''}</output></div>`;
    }
    #number(name, v, unit, path) { return this.#value(name, shown(v), unit, path, raw(v)); }
    #vector(name, v, unit, path) { return this.#value(name, xyz(v), unit, path, raw(v)); }
    #go(id, kind = 'body') { return id ? `<a class="go" data-${kind}="${id}">${escape(this.app.nameOf(id, kind === 'joint' ? 'joint' : undefined))}</a>` : 'the world'; }

    #world(world) {
        const c = world.counters, e = world.energy, p = world.profile, { app } = this;
        return `<h2>World</h2><div class="under">click on a body to see its values</div>
${this.#number('bodies', c.bodies)}${this.#number('awake', c.awakeBodies)}${this.#number('shapes', c.shapes)}${this.#number('joints', c.joints)}
${this.#number('pairs', c.pairs)}${this.#number('contacts', c.contacts)}${this.#number('islands', c.islands)}
<h3>Energy</h3>${this.#number('kinetic', e.kinetic, 'J')}${this.#number('potential', e.potential, 'J')}
<h3>Settings</h3>${this.#vector('gravity', world.gravity, 'm/s²')}${this.#number('substeps', world.substeps)}${this.#number('time step', app.dt * 1e3, 'ms')}
${Object.entries(world.tuning).map(([k, v]) => this.#number(k.replace(/[A-Z]/g, (l) => ' ' + l.toLowerCase()), typeof v === 'boolean' ? (v ? 'yes' : 'no') : v)).join('')}
<h3>Last step here <span>${shown(p.step)} ms</span></h3>
${['pairs', 'collide', 'islands', 'solve', 'continuous', 'finalize', 'events', 'sleep'].map((k) => this.#number(k, p[k], 'ms')).join('')}
<h3>State</h3>${this.#value('hash', world.hash)}<div class="actions">${TEST_BUTTON}</div>`;
    }
    #body(b) {
        const { app } = this, at = b.transform, v = b.linearVelocity, w = b.angularVelocity, isStatic = b.type === 'static', parts = [];
        const say = (...html) => parts.push(...html);
        say(`<h2><i style="background:${app.cssOf(b.id)}"></i>${escape(app.nameOf(b.id))}</h2>`,
            `<div class="under">${b.type}${b.enabled ? '' : ', disabled'}${isStatic ? '' : b.awake ? ', awake' : ', asleep'}${b.bullet ? ', bullet' : ''}</div>`);
        say('<h3>Pose</h3>', this.#vector('position', at.position, 'm', 'position.y'), this.#vector('angles', eulerOf(at.rotation), '°'), this.#value('quaternion', xyz(at.rotation), '', '', raw(at.rotation)));
        if (!isStatic) {
            say('<h3>Motion</h3>', this.#number('speed', length(v), 'm/s', 'speed'), this.#vector('velocity', v, 'm/s', 'linearVelocity.y'), this.#vector('spin', w, 'rad/s', 'angularVelocity'));
            const m = b.massData, d = b.getDamping(), locks = b.getLocks();
            say('<h3>Mass</h3>', this.#number('mass', b.mass, 'kg'), this.#vector('inertia', m.inertia, 'kg m²'), this.#vector('centre', b.centre, 'm'));
            say('<h3>Settings</h3>', this.#number('gravity scale', b.gravityScale, '', ''), this.#number('damping', d.linear, '1/s'), this.#number('angular damping', d.angular, '1/s'),
                this.#value('locks', `${axes(locks.linearAxes)} / ${axes(locks.angularAxes)}`), this.#number('sleeps below', b.sleepThreshold, 'm/s'));
        }
        const f = b.getFilter();
        say(this.#value('layer, mask, group', `${f.layer} ${hex(f.mask)} ${f.group}`), this.#value('user data', escape(b.userData)));
        for (const id of b.shapes) say(this.#shape(app.world.shape(id)));
        const contacts = b.contacts, joints = b.joints;
        if (joints.length) say(`<h3>Joints <span>${joints.length}</span></h3>`, ...joints.map((j) => `<div class="value"><label>${app.world.joint(j).type}</label><output>${this.#go(j, 'joint')}</output></div>`));
        if (contacts.length) say(`<h3>Contacts <span>${contacts.length}</span></h3>`, ...contacts.slice(0, 40).map((c) => this.#contact(c, b.id)));
        say(`<div class="actions"><button data-do="focus">Show</button><button data-do="follow" aria-pressed="${app.following === b.id}">Follow</button>
<button data-do="c">Copy as C</button><button data-do="python">Copy as Python</button>${TEST_BUTTON}</div>`);
        return parts.join('');
    }
    #shape(s) {
        const g = s.geometry, m = s.material, size = {
            sphere: () => this.#number('radius', g.radius, 'm'), box: () => this.#vector('half extents', g.halfExtents, 'm'), plane: () => this.#vector('normal', g.normal),
            capsule: () => this.#value('half height, radius', `${shown(g.halfHeight)} ${shown(g.radius)}`, 'm'), hull: () => this.#vector('scale', g.scale), mesh: () => this.#vector('scale', g.scale),
        };
        size.cylinder = size.cone = size.capsule;
        return `<h3>${g.type}${s.trigger ? ', trigger' : ''}</h3>${size[g.type]?.() ?? ''}${this.#number('density', s.density, 'kg/m³')}
${this.#value('friction', `${shown(m.staticFriction)} ${shown(m.dynamicFriction)}`, '', '', `${m.staticFriction} sticking, ${m.dynamicFriction} sliding`)}${this.#number('restitution', m.restitution)}
${m.rollingResistance ? this.#number('rolling resistance', m.rollingResistance) : ''}${length(s.surfaceVelocity) ? this.#vector('surface velocity', s.surfaceVelocity, 'm/s') : ''}`;
    }
    #contact(c, self) {
        const other = c.bodyA === self ? c.bodyB : c.bodyA;
        return `<div class="value"><label>${this.#go(other)}</label><output title="the normal, from A to B">${xyz(c.normal)}</output></div><table>
<tr><th>gap <small>mm</small></th><th>impulse <small>N s, substep</small></th><th>of the step <small>N s</small></th></tr>
${c.points.slice(0, c.pointCount).map((p) => `<tr><td>${shown(p.separation * 1e3)}</td><td>${shown(p.normalImpulse)}</td><td>${shown(p.totalImpulse)}</td></tr>`).join('')}</table>`;
    }
    #joint(j) {
        const { app } = this, type = j.type, s = j.state, r = j.getReaction(), { bodyA, bodyB } = j.getBodies(), def = j[type];
        const gauge = (now, low, high) => (def.limitEnabled && high > low && Math.abs(high) < 1e6 ? `<div class="gauge" title="${low} to ${high}"><i style="left:${Math.min(Math.max((now - low) / (high - low), 0), 1) * 100}%"></i></div>` : '');
        const rows = {
            hinge: () => this.#number('angle', s.angle * DEGREES, '°', 'state.angle') + gauge(s.angle, def.lower, def.upper), distance: () => this.#number('length', s.length, 'm', 'state.length') + gauge(s.length, def.lower, def.upper) + this.#number('speed', s.speed, 'm/s', 'state.speed'),
            ball: () => this.#number('twist', s.angle * DEGREES, '°', 'state.angle') + this.#number('swing y', s.swingY * DEGREES, '°', 'state.swingY') + this.#number('swing z', s.swingZ * DEGREES, '°', 'state.swingZ'),
        };
        const settings = Object.entries(def).filter(([k, v]) => typeof v === 'number' && !/^(body|userData)/.test(k) || typeof v === 'boolean');
        return `<h2><i style="background:#56b4e9"></i>${escape(app.nameOf(j.id, type))}</h2><div class="under">${type} joint${j.enabled ? '' : ', disabled'}</div>
<div class="value"><label>from</label><output>${this.#go(bodyA)}</output></div><div class="value"><label>to</label><output>${this.#go(bodyB)}</output></div>
<h3>State</h3>${rows[type]?.() ?? this.#vector('translation', s.translation, 'm', 'state.translation.x') + this.#vector('angles', { x: s.angle * DEGREES, y: s.swingY * DEGREES, z: s.swingZ * DEGREES }, '°', 'state.angle')}
${this.#vector('spin of B against A', s.angularVelocity, 'rad/s')}${this.#number('gap', s.linearError * 1e3, 'mm', 'state.linearError')}${this.#number('angle off', s.angularError * DEGREES, '°', 'state.angularError')}
<h3>Reaction</h3>${this.#vector('force', r.force, 'N', 'reaction.force')}${this.#vector('torque', r.torque, 'N m', 'reaction.torque')}
<h3>Settings</h3>${settings.map(([k, v]) => this.#number(k.replace(/[A-Z]/g, (l) => ' ' + l.toLowerCase()), typeof v === 'boolean' ? (v ? 'yes' : 'no') : v)).join('')}`;
    }
    #copyTest(button) {
        const { app } = this, id = app.picked?.body, body = id && app.world.body(id);
        if (app.live) return app.say('A test plays a recording: save what you did as one, open it, and copy the test there.');
        const name = body?.isValid ? app.nameOf(id) : '';
        app.copy(testOf(app.world, app.fileName ?? 'run.feather', app.step, name && body, name), button);
    }
    #act(what, button) {
        const { app } = this;
        if (what === 'focus') app.focus();
        else if (what === 'follow') app.follow();
        else if (what === 'test') this.#copyTest(button);
        else app.copy(codeOf(what, app.world, app.picked.body, app.step), button);
    }
}
