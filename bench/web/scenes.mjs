// Scenes as calls of an engine { fixed, body, ball }, SI units, density 1000 and friction 0.6 unless told. Those of the
// same names in bench/scenes, and the cube of cubes that every demo in a page shows.
//
// engine.box(position, half, options), engine.sphere(position, radius, options), engine.capsule(position, half height,
// radius, options) return a body; options: fixed, density, friction, ghost (touches nothing). engine.joint(a, b, point)
const FIXED = { fixed: true };
const ground = (e, x, z, friction = 0.6) => e.box([0, -1, 0], [x, 1, z], { ...FIXED, friction });

function pyramid(e, rows) {
    ground(e, 400, 400);
    for (let i = 0; i < rows; ++i) {
        for (let j = i; j < rows; ++j) e.box([(i + 1) / 2 + (j - i) - rows / 2, i + 0.5, 0], [0.5, 0.5, 0.5], { density: 100 });
    }
}
function many(e, n) {
    ground(e, 5.5 * n, 5.5 * n);
    for (let r = 0; r < n; ++r) {
        for (let c = 0; c < n; ++c) {
            const z = -5.5 * n + 1 + (2 * r * (5.5 * n - 1)) / (n - 1), centre = -5.5 * n + 11 * c + 1;
            for (let i = 0; i < 10; ++i) for (let j = i; j < 10; ++j) e.box([(i + 1) / 2 + (j - i) + centre - 0.5, i + 0.5, z], [0.5, 0.5, 0.5], { density: 100 });
        }
    }
}
function wide(e, n) {
    ground(e, 50, 50, 0.5);
    for (let i = 0; i < n; ++i) {
        const from = Math.floor(i / 2), to = n - Math.floor((i + 1) / 2), odd = i % 2;
        for (let j = from; j < to; ++j) for (let k = from; k < to; ++k) e.box([-n + 2 * j + odd, 1 + 2 * i, -n + 2 * k + odd], [1, 1, 1], { friction: 0.5 });
    }
}
function joints(e, n) {
    const at = [];
    for (let i = 0; i < n; ++i) {
        for (let k = 0; k < n; ++k) {
            const p = [k, -i, 0];
            at.push(e.sphere(p, 0.4, { fixed: i === 0, ghost: true }));
            if (i > 0) e.joint(at[(i - 1) * n + k], at[i * n + k], [k, -i + 0.5, 0], [k, -i + 1, 0], p);
            if (k > 0) e.joint(at[i * n + k - 1], at[i * n + k], [k - 0.5, -i, 0], [k - 1, -i, 0], p);
        }
    }
}
function bowl(e, n) {
    ground(e, 20, 20);
    for (const x of [-7, 7]) e.box([x, 10, 0], [1, 11, 8], { ...FIXED, friction: 0.3 });
    for (const z of [-7, 7]) e.box([0, 10, z], [8, 11, 1], { ...FIXED, friction: 0.3 });
    let state = 0x9e3779b97f4a7c15n;
    const u = () => {
        state ^= (state << 13n) & 0xffffffffffffffffn, state ^= state >> 7n, state ^= (state << 17n) & 0xffffffffffffffffn;
        return Number(state >> 11n) / 2 ** 53;
    };
    for (let b = 0; b < n; ++b) {
        const l = Math.floor(b / 81), c = b % 81, x = 1.2 * ((c % 9) - 4) + 0.3 * (u() - 0.5), z = 1.2 * (Math.floor(c / 9) - 4) + 0.3 * (u() - 0.5), p = [x, 1 + 1.5 * l, z], o = { friction: 0.4 };
        if (b % 3 === 0) e.box(p, [0.4, 0.3, 0.5], o);
        else if (b % 3 === 1) e.sphere(p, 0.45, o);
        else e.capsule(p, 0.3, 0.3, o);
    }
}
function rest(e, n) {
    ground(e, 500, 500);
    const side = Math.ceil(Math.sqrt(n));
    for (let b = 0; b < n; ++b) {
        const p = [(b % side) * 1.5, 0.5, Math.floor(b / side) * 1.5];
        if (b % 2 === 0) e.box(p, [0.5, 0.5, 0.5]);
        else e.sphere(p, 0.5);
    }
}
function grid(e, n) {
    ground(e, 100, 100);
    for (let x = 0; x < n; ++x) for (let y = 0; y < n; ++y) for (let z = 0; z < n; ++z) e.box([(x - n / 2) * 1.01, 0.5 + y * 1.01, (z - n / 2) * 1.01], [0.5, 0.5, 0.5]);
}
// name: what makes it, steps before those that are timed, timed steps
export const scenes = {
    'pyramid-50': [(e) => pyramid(e, 50), 1, 200], 'pyramid-100': [(e) => pyramid(e, 100), 1, 60], 'many-8': [(e) => many(e, 8), 1, 100],
    'wide-15': [(e) => wide(e, 15), 1, 120], 'joints-50': [(e) => joints(e, 50), 1, 100], 'bowl-1500': [(e) => bowl(e, 1500), 240, 120],
    'rest-500': [(e) => rest(e, 500), 60, 180], 'grid-10': [(e) => grid(e, 10), 60, 120],
};
