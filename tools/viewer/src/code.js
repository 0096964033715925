// code.js - a body as the calls that make it, to be pasted into a test.
const f = (v) => `${Object.is(v, -0) ? 0 : v}`;
const cf = (v) => (/[.e]/.test(f(v)) ? `${f(v)}f` : `${f(v)}.0f`);
const list = (v) => [v.x, v.y, v.z, ...('w' in v ? [v.w] : [])];

const C_FORMS = {
    box: (g) => `fe_geometry_box(&form, ${list(g.halfExtents).map(cf).join(', ')});`, sphere: (g) => `fe_geometry_sphere(&form, ${cf(g.radius)});`,
    capsule: (g) => `fe_geometry_capsule(&form, ${cf(g.halfHeight)}, ${cf(g.radius)});`, cylinder: (g) => `fe_geometry_cylinder(&form, ${cf(g.halfHeight)}, ${cf(g.radius)});`,
    cone: (g) => `fe_geometry_cone(&form, ${cf(g.halfHeight)}, ${cf(g.radius)});`, plane: (g) => `fe_geometry_plane(&form, ${list(g.normal).map(cf).join(', ')}, ${cf(g.distance)});`,
};
const PYTHON_FORMS = {
    box: (g) => `add_box(${list(g.halfExtents).map(f).join(', ')}`, sphere: (g) => `add_sphere(${f(g.radius)}`, capsule: (g) => `add_capsule(${f(g.halfHeight)}, ${f(g.radius)}`,
    cylinder: (g) => `add_cylinder(${f(g.halfHeight)}, ${f(g.radius)}`, cone: (g) => `add_cone(${f(g.halfHeight)}, ${f(g.radius)}`, plane: (g) => `add_plane((${list(g.normal).map(f).join(', ')}), ${f(g.distance)}`,
};

function inC(body, shapes, step) {
    const { position: p, rotation: q } = body.transform, v = body.linearVelocity, w = body.angularVelocity;
    return `// as it is after step ${step}
fe_body_def def;
fe_body_def_init(&def, sizeof def);
def.type = FE_BODY_${body.type.toUpperCase()};
def.transform.position = (fe_dvec3){${list(p).map(f).join(', ')}};
def.transform.rotation = (fe_quat){${list(q).map(cf).join(', ')}};
def.linear_velocity = (fe_vec3){${list(v).map(cf).join(', ')}};
def.angular_velocity = (fe_vec3){${list(w).map(cf).join(', ')}};
fe_body body;
fe_body_create(world, &def, &body);
${shapes.map(({ geometry: g, density, material: m }, k) => `{
    fe_shape_def surface;
    fe_shape_def_init(&surface, sizeof surface);
    surface.density = ${cf(density)};
    surface.material.static_friction = ${cf(m.staticFriction)};
    surface.material.dynamic_friction = ${cf(m.dynamicFriction)};
    surface.material.restitution = ${cf(m.restitution)};
    fe_geometry form;
    ${C_FORMS[g.type]?.(g) ?? `// a ${g.type}: shape ${k} has an asset of its own`}
    fe_shape shape;
    fe_shape_create(world, body, &surface, &form, &shape);
}`).join('\n')}
`;
}
function inPython(body, shapes, step) {
    const { position: p, rotation: q } = body.transform, tuple = (v) => `(${list(v).map(f).join(', ')})`;
    return `# as it is after step ${step}
body = world.create_body("${body.type}", position=${tuple(p)}, rotation=${tuple(q)},
                         linear_velocity=${tuple(body.linearVelocity)}, angular_velocity=${tuple(body.angularVelocity)})
${shapes.map(({ geometry: g, density, material: m }) => (PYTHON_FORMS[g.type] ? `body.${PYTHON_FORMS[g.type](g)}, density=${f(density)}, friction=${f(m.staticFriction)}, restitution=${f(m.restitution)})` : `# a ${g.type}: it has an asset of its own`)).join('\n')}
`;
}
export function codeOf(language, world, id, step) {
    const body = world.body(id), shapes = body.shapes.map((s) => world.shape(s));
    return (language === 'c' ? inC : inPython)(body, shapes, step);
}
