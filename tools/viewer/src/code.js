// code.js - a body as the calls that make it, to be pasted into a test. What has its default is left out.
const f = (v) => `${Object.is(v, -0) ? 0 : v}`;
const cf = (v) => (/[.e]/.test(f(v)) ? `${f(v)}f` : `${f(v)}.0f`);
const list = (v) => [v.x, v.y, v.z, ...('w' in v ? [v.w] : [])];


const C_FORMS = {
    box: (g) => `box(&form, ${list(g.halfExtents).map(cf).join(', ')})`,
    sphere: (g) => `sphere(&form, ${cf(g.radius)})`,
    capsule: (g) => `capsule(&form, ${cf(g.halfHeight)}, ${cf(g.radius)})`,
    cylinder: (g) => `cylinder(&form, ${cf(g.halfHeight)}, ${cf(g.radius)})`,
    cone: (g) => `cone(&form, ${cf(g.halfHeight)}, ${cf(g.radius)})`,
    plane: (g) => `plane(&form, ${list(g.normal).map(cf).join(', ')}, ${cf(g.distance)})`,
};
const PYTHON_FORMS = {
    box: (g) => `box(${list(g.halfExtents).map(f).join(', ')}`, sphere: (g) => `sphere(${f(g.radius)}`,
    capsule: (g) => `capsule(${f(g.halfHeight)}, ${f(g.radius)}`,
    cylinder: (g) => `cylinder(${f(g.halfHeight)}, ${f(g.radius)}`,
    cone: (g) => `cone(${f(g.halfHeight)}, ${f(g.radius)}`,
    plane: (g) => `plane((${list(g.normal).map(f).join(', ')}), ${f(g.distance)}`,
};
const COMBINES = ['default', 'average', 'minimum', 'multiply', 'maximum'], EVENTS = ['touch', 'stay', 'hit'];
const REST = { x: 0, y: 0, z: 0 }, UNTURNED = { ...REST, w: 1 };
const LEFT_OUT = 'joints, forces, a mass that was set, and tags above 2^53 are left out';

// Kinds of values, as they are written in C and in Python
const float = [cf, f], whole = [f, f], yes = [(v) => (v ? '1' : '0'), (v) => (v ? 'True' : 'False')];
const bits = [(v) => `0x${v.toString(16)}`, (v) => `0x${v.toString(16)}`];
const vector = [(v) => `(fe_vec3){${list(v).map(cf).join(', ')}}`, (v) => `(${list(v).map(f).join(', ')})`];
const turn = [(v) => `(fe_quat){${list(v).map(cf).join(', ')}}`, vector[1]];
const mode = [(v) => `FE_COMBINE_${v.toUpperCase()}`, (v) => `"${v}"`];
const same = (a, b) => (typeof a === 'object' ? list(a).every((v, k) => v === list(b)[k]) : a === b);
// Of rows of name, value, default, kind and the name in Python those that are not as they are by default
const others = (rows) => rows.filter(([, value, usual]) => !same(value, usual));

function ofMotion(body) {
    return [
        ['linear_velocity', body.linearVelocity, REST, vector],
        ['angular_velocity', body.angularVelocity, REST, vector],
    ];
}
function ofBody(body) {
    return [
        ['gravity_scale', body.gravityScale, 1, float],
        ['sleep_threshold', body.sleepThreshold, Math.fround(0.05), float],
        ['awake', body.type === 'static' || body.awake, true, yes], ['sleep_allowed', body.sleepAllowed, true, yes],
        ['enabled', body.enabled, true, yes], ['bullet', body.bullet, false, yes],
    ];
}
function ofShape(shape) {
    const { frame, surfaceVelocity } = shape, { layer, mask, group } = shape.getFilter();
    return [
        ['frame.position', frame.position, REST, vector, 'position'],
        ['frame.rotation', frame.rotation, UNTURNED, turn, 'rotation'],
        ['trigger', shape.trigger, false, yes], ['layer', layer, 1, bits], ['mask', mask >>> 0, 0xffffffff, bits],
        ['group', group, 0, whole], ['pair_filter', shape.pairFilter, false, yes],
        ['surface_velocity', surfaceVelocity, REST, vector], ['user_data', Number(shape.userData), 0, whole, 'tag'],
    ];
}
function ofMaterial(m) {
    return [
        ['static_friction', m.staticFriction, Math.fround(0.6), float],
        ['dynamic_friction', m.dynamicFriction, 0.5, float],
        ['restitution', m.restitution, 0, float], ['rolling_resistance', m.rollingResistance, 0, float],
        ['spinning_resistance', m.spinningResistance, 0, float],
        ['friction_combine', m.frictionCombine, COMBINES[0], mode],
        ['restitution_combine', m.restitutionCombine, COMBINES[0], mode], ['user_id', Number(m.userId), 0, whole],
    ];
}
const lines = (into, rows) => others(rows).map(([name, value, , [write]]) => `${into}.${name} = ${write(value)};\n`);
const words = (rows) => others(rows).map(([name, value, , [, write], own]) => `${own ?? name}=${write(value)}`);

function shapeInC(shape, k) {
    const g = shape.geometry, { enabled, direction } = shape.getOneWay();
    if (!C_FORMS[g.type]) return `// shape ${k} is left out: a ${g.type} has an asset of its own\n`;
    const settings = [
        `surface.density = ${cf(shape.density)};\n`, ...lines('surface', ofShape(shape)),
        ...lines('surface.material', ofMaterial(shape.material)),
        ...(shape.events === 1 ? [] : [`surface.events = ${shape.events};\n`]),
        ...(enabled ? ['surface.one_way = 1;\n', `surface.one_way_direction = ${vector[0](direction)};\n`] : []),
    ];
    return `{
    fe_shape_def surface;
    fe_shape_def_init(&surface, sizeof surface);
${settings.map((line) => `    ${line}`).join('')}    fe_geometry form;
    fe_geometry_${C_FORMS[g.type](g)};
    fe_shape shape;
    fe_shape_create(world, body, &surface, &form, &shape);
}
`;
}
function inC(body, shapes, step) {
    const { position: p, rotation: q } = body.transform, damping = body.getDamping(), locks = body.getLocks();
    const settings = [
        ...ofMotion(body),
        ['linear_damping', damping.linear, 0, float], ['angular_damping', damping.angular, 0, float],
        ['linear_locks', locks.linearAxes, 0, whole], ['angular_locks', locks.angularAxes, 0, whole],
        ...ofBody(body), ['user_data', Number(body.userData), 0, whole],
    ];
    return `// as it is after step ${step}; ${LEFT_OUT}
fe_body_def def;
fe_body_def_init(&def, sizeof def);
def.type = FE_BODY_${body.type.toUpperCase()};
def.transform.position = (fe_dvec3){${list(p).map(f).join(', ')}};
def.transform.rotation = ${turn[0](q)};
${lines('def', settings).join('')}fe_body body;
fe_body_create(world, &def, &body);
${shapes.map(shapeInC).join('')}`;
}
function shapeInPython(shape, k) {
    const g = shape.geometry, { enabled, direction } = shape.getOneWay(), material = words(ofMaterial(shape.material));
    if (!PYTHON_FORMS[g.type]) return `# shape ${k} is left out: a ${g.type} has an asset of its own\n`;
    const events = EVENTS.filter((_, bit) => shape.events & (1 << bit)).map((name) => `"${name}"`);
    const settings = [
        `density=${f(shape.density)}`, ...words(ofShape(shape)),
        ...(material.length ? [`material=Material(${material.join(', ')})`] : []),
        ...(shape.events === 1 ? [] : [`events=[${events.join(', ')}]`]),
        ...(enabled ? [`one_way=${vector[1](direction)}`] : []),
    ];
    return `body.add_${PYTHON_FORMS[g.type](g)}, ${settings.join(', ')})\n`;
}
function inPython(body, shapes, step) {
    const { position, rotation } = body.transform, damping = body.getDamping();
    const { linearAxes, angularAxes } = body.getLocks();
    const axes = (set) => `"${[...'xyz'].filter((_, k) => set & (1 << k)).join('')}"`;
    const settings = [
        `position=${vector[1](position)}`, `rotation=${vector[1](rotation)}`,
        ...words(ofMotion(body)),
        ...(damping.linear || damping.angular ? [`damping=(${f(damping.linear)}, ${f(damping.angular)})`] : []),
        ...(linearAxes || angularAxes ? [`locks=(${axes(linearAxes)}, ${axes(angularAxes)})`] : []),
        ...words([...ofBody(body), ['tag', Number(body.userData), 0, whole]]),
    ];
    return `# as it is after step ${step}; ${LEFT_OUT}
body = world.create_body("${body.type}", ${settings.join(', ')})
${shapes.map(shapeInPython).join('')}`;
}
export function codeOf(language, world, id, step) {
    const body = world.body(id), shapes = body.shapes.map((s) => world.shape(s));
    return (language === 'c' ? inC : inPython)(body, shapes, step);
}
