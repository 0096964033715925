// series.js - what is plotted: the columns that the scan fills, and values of bodies and joints that somebody pinned.
// A column has a name, a unit and a colour. `scale` names another column, in whose scale it is drawn.
export const SLOT = 2097152; // handles count bodies in their lowest 21 bits
const STEP_TIME = 'time of a step';
export const COLUMNS = [
    { name: 'kinetic energy', unit: 'J', colour: '#e69f00' },
    { name: 'potential energy', unit: 'J', colour: '#56b4e9' },
    { name: 'deepest overlap', unit: 'mm', colour: '#d55e00' },
    { name: 'widest joint gap', unit: 'mm', colour: '#cc79a7' },
    { name: 'awake bodies', unit: '', colour: '#009e73' },
    { name: 'contacts', unit: '', colour: '#88ccee' },
    { name: 'momentum', unit: 'kg m/s', colour: '#aa4499' },
    { name: STEP_TIME, unit: 'ms', colour: '#999933' },
    { name: 'hits', unit: '', colour: '#f0e442' },
    // parts of the time of a step, drawn by its scale
    ...[
        ['pairs', '#77aadd'], ['collide', '#ee8866'], ['islands', '#eedd88'], ['solve', '#ffaabb'],
        ['continuous', '#99ddff'], ['finalize', '#44bb99'], ['events', '#bbcc33'], ['sleep', '#aaaa00'],
    ].map(([phase, colour]) => ({ name: `in ${phase}`, phase, unit: 'ms', colour, scale: STEP_TIME })),
];
const PINNED = ['#4477aa', '#ee6677', '#228833', '#ccbb44', '#66ccee', '#aa3377'];
export const colourOf = (k) => COLUMNS[k]?.colour ?? PINNED[(k - COLUMNS.length) % PINNED.length];

// A pin: { body or joint, path }. The path is that of a property: 'position.y', 'state.angle', 'speed'
export function readPin(world, { body, joint, path }) {
    try {
        let value = body ? world.body(body) : world.joint(joint);
        const parts = path.split('.');
        if (path === 'speed' && body) {
            const v = value.linearVelocity;
            return Math.hypot(v.x, v.y, v.z);
        }
        for (const part of parts) value = part === 'reaction' ? value.getReaction() : value[part];
        return typeof value === 'object' ? Math.hypot(value.x, value.y, value.z) : Number(value);
    } catch {
        return NaN; // it is not there at this step
    }
}

// Numbers by step, with room that grows
export class Series {
    constructor(first = 0) {
        this.first = first, this.count = 0, this.width = COLUMNS.length, this.data = new Float64Array(0);
    }
    put(step, rows, at, width) {
        if (this.width !== width || !this.data.length) {
            this.width = width, this.data = new Float64Array(width * 4096), this.count = 0;
        }
        const k = step - this.first;
        if (k < 0) return;
        if ((k + 1) * width > this.data.length) {
            const more = new Float64Array(Math.max(2 * this.data.length, (k + 1) * width));
            more.set(this.data), this.data = more;
        }
        for (let j = this.count; j < k; ++j) this.data.fill(NaN, j * width, (j + 1) * width);
        for (let j = 0; j < width; ++j) this.data[k * width + j] = rows[at + j];
        this.count = Math.max(this.count, k + 1);
    }
    at(step, column) {
        const k = step - this.first;
        return k >= 0 && k < this.count && column < this.width ? this.data[k * this.width + column] : NaN;
    }
}
