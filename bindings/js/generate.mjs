#!/usr/bin/env node
// Makes the calls of the JavaScript layer from the public header: api.js, its types api.d.ts, and exports, the functions
// that the module gives. What the layer wraps by hand is named in HAND, what it leaves out in LEFT_OUT, with a reason.
//   generate.mjs header folder | generate.mjs header --missing | generate.mjs header --layout | generate.mjs header --types
import { readFileSync, writeFileSync } from 'node:fs';

const header = readFileSync(process.argv[2], 'utf8').split('// ---- sugar')[0];

// Wrapped in src/hand.js, where arrays and objects of the language meet the library
export const HAND = `fe_world_create fe_world_destroy fe_world_save fe_world_restore fe_world_load fe_world_get_store
fe_body_create fe_body_create_many fe_body_destroy fe_body_destroy_many fe_shape_create fe_joint_get_type
fe_store_create fe_store_destroy fe_asset_save fe_asset_load fe_asset_get_type fe_snapshot_check fe_snapshot_get_assets
fe_asset_get_key fe_heightfield_create fe_hull_create fe_mesh_create fe_compound_create fe_heightfield_set_heights
fe_heightfield_get_heights fe_mesh_set_materials fe_world_raycast_many fe_world_sweep_many fe_world_get_moved
fe_world_get_transforms fe_world_set_transforms fe_world_get_transforms_f32 fe_world_get_velocities fe_world_set_velocities
fe_world_add_forces fe_world_hash fe_world_draw_lines fe_world_draw_triangles fe_world_draw_points
fe_world_draw_instances fe_history_create fe_history_destroy fe_history_keep fe_history_restore fe_history_get_frames
fe_recorder_create fe_recorder_read fe_recorder_note fe_recorder_destroy fe_player_create fe_player_feed fe_player_step
fe_player_seek fe_player_get_world fe_player_release fe_player_get_info fe_player_get_notes fe_player_get_divergence
fe_player_destroy fe_snapshot_compare fe_world_clone fe_state_create fe_state_destroy fe_world_set_state fe_batch_create
fe_batch_destroy fe_batch_get_world fe_batch_bind fe_batch_step fe_batch_reset fe_batch_read fe_batch_write fe_batch_hash
fe_version fe_last_error fe_result_name`.split(/\s+/);
export const LEFT_OUT = {
    fe_pool_create: 'feather-physics/threads has one for all worlds', fe_pool_destroy: 'feather-physics/threads has one for all worlds',
    fe_allocator_init: 'memory is the module\'s own', fe_task_system_init: 'workers have no callbacks of the page',
    fe_world_get_joint_coordinates: 'joints are read and driven one by one',
    fe_world_get_joint_reactions: 'joints are read and driven one by one',
    fe_world_set_joint_targets: 'joints are read and driven one by one',
    fe_world_set_joint_motor_speeds: 'joints are read and driven one by one',
    fe_world_add_joint_forces: 'joints are read and driven one by one',
    fe_world_set_pair_filter: 'calls back into JavaScript in a step; layers, groups and ignored pairs decide there',
};

// ---- the header -----------------------------------------------------------------------------------------------------

const camel = (s) => s.replace(/_([a-z0-9])/g, (_, c) => c.toUpperCase());
const pascal = (s) => camel('_' + s.replace(/^fe_/, ''));
const docOf = (at) => {
    const lines = header.slice(0, at).split('\n');
    const doc = [];
    lines.pop();
    while (lines.length && /^\/\/\//.test(lines.at(-1))) doc.unshift(lines.pop().replace(/^\/\/\/ ?/, ''));
    return doc.join('\n');
};

const enums = {}, enumOf = {}; // type -> { word: number }; enumerator -> type
for (const [, name, body] of header.matchAll(/typedef enum (fe_\w+) \{([\s\S]*?)\n\} \1;/g)) {
    const front = name.replace(/_(type|kind|flags)$/, '').toUpperCase() + '_';
    enums[name] = {};
    for (const [, value, number] of body.matchAll(/^\s*(FE_\w+) = (-?\w+)/gm)) {
        if (value.endsWith('FORCE32')) continue;
        const short = name === 'fe_result' ? value.slice(3) : value.startsWith(front) ? value.slice(front.length) : value.slice(3);
        enums[name][camel(short.toLowerCase())] = Number(number);
        enumOf[value] = name;
    }
}
const BITS = new Set(['fe_axis', 'fe_shape_events', 'fe_mesh_flags', 'fe_draw_flags', 'fe_query_flags', 'fe_hit_flags', 'fe_mesh_edge_flags', 'fe_save', 'fe_record_flags']);
const handles = new Set(['fe_handle', 'fe_body', 'fe_shape', 'fe_joint', 'fe_asset']);
const numbers = { float: [4, 'f'], double: [8, 'd'], int32_t: [4, 'i'], uint32_t: [4, 'u'], uint64_t: [8, 'q'], int64_t: [8, 'q'], uint8_t: [1, 'b'], uint16_t: [2, 's'] };
const vectors = { fe_vec3: 'vec3', fe_dvec3: 'dvec3', fe_quat: 'quat' };
// switches, which are true and false here
const SWITCH = /^(out_)?(enabled|awake|trigger|bullet|one_way|pair_filter|own_material|collide_connected|kept|foreign|filter|new_number|ignore|ignored|allowed|is_trigger|has_diverged|sleep_allowed|spread|\w+_enabled)$/;
const enumIn = (text) => {
    for (const [w] of text.matchAll(/\b(fe_\w+|FE_\w+)\b/g)) {
        if (enums[w]) return w;
        const front = Object.keys(enums).find((e) => enumOf[w] === e);
        if (front) return front;
        if (w === 'FE_AXIS_') return 'fe_axis';
    }
    return undefined;
};

const records = {}, opaque = new Set();
for (const [, name] of header.matchAll(/^typedef struct (fe_\w+) \1;/gm)) opaque.add(name);
const layout = (type) => {
    if (handles.has(type)) return [8, 8];
    if (type === 'char') return [1, 1];
    if (numbers[type]) return [numbers[type][0], numbers[type][0]];
    if (records[type]) return [records[type].size, records[type].align];
    return [4, 4]; // enumerations, pointers
};
for (const m of header.matchAll(/typedef struct (fe_\w+) \{([\s\S]*?)\n\} \1;/g)) {
    const r = { name: m[1], fields: [], size: 0, align: 1, doc: docOf(m.index) };
    let pending = '';
    for (const line of m[2].split('\n')) {
        const before = line.match(/^\s*\/\/\/(?!<) ?(.*)/);
        if (before) { pending += (pending ? ' ' : '') + before[1]; continue; }
        const more = line.match(/^\s*\/\/\/< ?(.*)/);
        if (more && r.fields.length) { for (const f of r.last) f.doc += ' ' + more[1]; continue; }
        const d = line.match(/^\s*(const )?(\w+) ([^;]*);\s*(?:\/\/\/< ?(.*))?/);
        if (!d) continue;
        const doc = d[4] ?? pending;
        pending = '';
        r.last = [];
        const declare = (type, text) => {
            const pointer = text.includes('*'), f = { type, pointer, doc, name: text.match(/\w+/)[0], count: Number(text.match(/\[(\d+)\]/)?.[1] ?? 1) };
            f.array = text.includes('[');
            const [size, align] = pointer ? [4, 4] : layout(type);
            r.size = Math.ceil(r.size / align) * align;
            f.offset = r.size;
            r.size += size * f.count;
            r.align = Math.max(r.align, align);
            r.fields.push(f);
            r.last.push(f);
        };
        const callback = d[0].match(/\(\*(\w+)\)/);
        if (callback) { declare('callback', '*' + callback[1]); continue; }
        if (['fe_pair_filter', 'fe_task'].includes(d[2])) { declare('callback', '*' + d[3]); continue; }
        for (const text of d[3].split(',')) declare(d[2], text.trim());
    }
    delete r.last;
    r.size = Math.ceil(r.size / r.align) * r.align;
    records[r.name] = r;
}
const functions = [];
for (const m of header.matchAll(/^FE_API ([\w ]+?[ *]+)(fe_\w+)\(([^)]*)\);/gm)) {
    const params = m[3] === 'void' ? [] : m[3].split(',').map((p) => {
        const [, isConst, type, star, name] = p.trim().replace(/\s+/g, ' ').replace('*const *', '**').match(/^(const )?(\w+) ?(\*{0,2}) ?(\w+)$/);
        return { const: !!isConst, type, pointer: star.length, name };
    });
    functions.push({ name: m[2], result: m[1].trim(), params, doc: docOf(m.index) });
}

if (process.argv[3] === '--layout') {
    for (const r of Object.values(records)) {
        console.log(`FE_SIZE(${r.name}, ${r.size})`);
        for (const f of r.fields) console.log(`FE_OFFSET(${r.name}, ${f.name}, ${f.offset})`);
    }
    process.exit();
}

// ---- records --------------------------------------------------------------------------------------------------------

const hidden = (f) => f.name === 'struct_size' || f.name.startsWith('reserved') || f.type === 'callback' || opaque.has(f.type) || ['fe_allocator', 'fe_task_system'].includes(f.type);
const short = (type) => type.replace(/^fe_/, '').replace(/^dvec3$/, 'dvec3');
const fieldEnum = (f) => {
    if (!['int32_t', 'uint32_t'].includes(f.type) || f.pointer) return undefined;
    if (/^(linear|angular)_locks$/.test(f.name)) return 'fe_axis';
    return enumIn(f.doc);
};
// Lists behind pointers: [kind, field that counts them, numbers an element]
const LISTS = {
    'fe_query_filter.excluded': ['h', 'excluded_count', 1], 'fe_heightfield_def.heights': ['f', null, 1],
    'fe_heightfield_def.holes': ['b', null, 1], 'fe_heightfield_def.cell_materials': ['b', null, 1],
    'fe_heightfield_def.materials': ['fe_material', 'material_count', 1], 'fe_hull_def.points': ['f', 'point_count', 3],
    'fe_mesh_def.vertices': ['f', 'vertex_count', 3], 'fe_mesh_def.indices': ['u', 'triangle_count', 3],
    'fe_mesh_def.triangle_materials': ['b', null, 1], 'fe_mesh_def.materials': ['fe_material', 'material_count', 1],
    'fe_mesh_def.triangle_data': ['u', null, 1],
};
const counted = new Set(Object.entries(LISTS).filter(([, l]) => l[1]).map(([k, l]) => k.split('.')[0] + '.' + l[1]));
counted.add('fe_restore_options.asset_count');
for (const r of ['fe_save_options', 'fe_restore_options']) counted.add(`${r}.base_size`); // hand.js sets it with the base
const laidOut = (r, f) => /_stride$|^index_type$/.test(f.name) || counted.has(r.name + '.' + f.name);
// What lies deeper, by a shorter name
const ALIASES = {
    fe_body_def: { position: 'transform.position', rotation: 'transform.rotation' },
    fe_shape_def: { position: 'frame.position', rotation: 'frame.rotation', friction: 'material.static_friction', restitution: 'material.restitution' },
    fe_compound_part: { position: 'frame.position', rotation: 'frame.rotation' },
    fe_material: { friction: 'static_friction' },
};
const tableName = (type) => '$' + short(type);
const writer = (r, f) => {
    const e = fieldEnum(f);
    const one = e ? (BITS.has(e) ? ['W.bits', pascal(e)] : ['W.word', pascal(e)])
        : handles.has(f.type) ? ['W.h'] : vectors[f.type] ? ['W.' + vectors[f.type]] : records[f.type] ? ['W.record', tableName(f.type)] : f.type === 'int32_t' && SWITCH.test(f.name) ? ['W.flag'] : ['W.' + numbers[f.type][1]];
    return f.array ? ['W.array', `[${one[0]}, ${layout(f.type)[0]}, ${f.count}, ${one[1] ?? 0}]`] : one;
};
const find = (r, path) => path.split('.').reduce(({ r: at, offset }, name) => {
    const f = at.fields.find((g) => g.name === name);
    return { r: records[f.type], f, offset: offset + f.offset };
}, { r, offset: 0 });
// Only the library writes these, unless a table of their fields is asked for, too
const sized = new Set(['fe_snapshot_info', 'fe_player_info', 'fe_divergence', 'fe_difference']);
const emittedTables = new Set(), tables = [];
function table(type) {
    if (emittedTables.has(type)) return;
    emittedTables.add(type);
    const r = records[type], fields = [], aliases = [];
    for (const f of r.fields) {
        if (hidden(f) || laidOut(r, f)) continue;
        const list = LISTS[`${type}.${f.name}`];
        if (f.pointer && !list) continue;
        if (list) {
            const kind = records[list[0]] ? tableName(list[0]) : `'${list[0]}'`;
            if (records[list[0]]) table(list[0]);
            const counter = list[1] ? r.fields.find((g) => g.name === list[1]).offset : -1;
            fields.push(`${camel(f.name)}: [${f.offset}, W.list, [${kind}, ${counter}, ${list[2]}]]`);
            continue;
        }
        if (records[f.type] && !vectors[f.type]) table(f.type);
        const [w, more] = writer(r, f);
        fields.push(`${camel(f.name)}: [${f.offset}, ${w}${more ? ', ' + more : ''}]`);
    }
    for (const [name, path] of Object.entries(ALIASES[type] ?? {})) {
        const { r: to, f, offset } = find(r, path);
        aliases.push(`${name}: [${offset}, ${name === 'friction' ? 'W.frictions' : writer(to ?? r, f)[0]}]`);
    }
    tables.push(`export const ${tableName(type)} = [${r.size}, ${starter(type)}, { ${fields.join(', ')} }${aliases.length ? `, { ${aliases.join(', ')} }` : ''}];`);
}
function starter(type) {
    if (functions.some((g) => g.name === `${type}_init`)) return `(a, n) => x.${type}_init(a, n)`;
    const ones = { fe_transform: 36, fe_path: 36, fe_frame: 24 }[type]; // where the rotation's w lies
    return ones ? `(a) => { f32[(a + ${ones}) >> 2] = 1; }` : '0';
}
// A reader of its own is fast; records that have a table, and are read once in a while, are read by that
const emittedReaders = new Set(), OFTEN = new Set(['fe_transform', 'fe_bounds']);
const isRare = (type) => emittedTables.has(type) && !OFTEN.has(type) && !records[type].fields.some((f) => f.type === 'int64_t' || f.type === 'char');
const readOne = (f, at) => {
    if (f.type === 'char') return f.pointer ? `text(u32[(${at}) >> 2])` : `text(${at})`;
    const e = fieldEnum(f);
    if (e && !BITS.has(e)) return `nameOf(${pascal(e)}, i32[(${at}) >> 2])`;
    if (handles.has(f.type)) return `id(${at})`;
    if (vectors[f.type]) return `get${pascal(f.type)}(${at})`;
    if (records[f.type]) { reader(f.type); return `read${pascal(f.type)}(${at})`; }
    if (f.type === 'int64_t') return `Number(i64of(${at}))`;
    if (f.type === 'int32_t' && SWITCH.test(f.name)) return `i32[(${at}) >> 2] !== 0`;
    return { f: `f32[(${at}) >> 2]`, d: `f64[(${at}) >> 3]`, i: `i32[(${at}) >> 2]`, u: `u32[(${at}) >> 2]`, q: `wide(${at})` }[numbers[f.type][1]];
};
const reader = (type) => {
    if (emittedReaders.has(type)) return;
    emittedReaders.add(type);
    readerOf(type); // finds those of the records in it
};
function readerOf(type) {
    const r = records[type], parts = [];
    for (const f of r.fields) {
        if (hidden(f) || (f.pointer && f.type !== 'char') || laidOut(r, f)) continue;
        const at = (k) => (f.offset + k ? `a + ${f.offset + k}` : 'a');
        const [size] = layout(f.type);
        parts.push(`${camel(f.name)}: ${f.array && f.type !== 'char' ? `[${Array.from({ length: f.count }, (_, k) => readOne(f, at(k * size))).join(', ')}]` : readOne(f, at(0))}`);
    }
    return `(a) => ({ ${parts.join(', ')} })`;
}

// ---- types ----------------------------------------------------------------------------------------------------------

const outTypes = new Set(), inTypes = new Set();
const scalarType = (f, input) => {
    if (f.type === 'char') return 'string';
    const e = fieldEnum(f);
    if (e) return BITS.has(e) ? (input ? `${pascal(e)} | readonly ${pascal(e)}[] | number` : 'number') : pascal(e);
    if (handles.has(f.type)) return input ? `Handle<${({ fe_body: 'Body', fe_shape: 'Shape', fe_joint: 'Joint', fe_asset: 'Asset' })[f.type] ?? 'Body'}> | null` : 'number';
    if (vectors[f.type]) return (f.type === 'fe_quat' ? 'Quat' : 'Vec3') + (input ? 'Like' : '');
    if (records[f.type]) { (input ? inTypes : outTypes).add(f.type); return pascal(f.type) + (input ? 'Options' : ''); }
    if (['uint64_t'].includes(f.type)) return 'number | bigint';
    if (f.type === 'int32_t' && SWITCH.test(f.name)) return input ? 'boolean | 0 | 1' : 'boolean';
    return 'number';
};
const doc = (text, pad = '') => (text ? `${pad}/** ${text.replace(/\*\//g, '').replace(/\n/g, `\n${pad} * `)} */\n` : '');
function interfaceOf(type, input) {
    const r = records[type];
    let out = doc(r.doc) + `export interface ${pascal(type)}${input ? 'Options' : ''} {\n`;
    for (const f of r.fields) {
        const list = LISTS[`${type}.${f.name}`];
        if (hidden(f) || laidOut(r, f) || (f.pointer && f.type !== 'char' && !(list && input))) continue;
        let t = list ? (records[list[0]] ? `readonly ${scalarType({ type: list[0], doc: '' }, true)}[]` : list[0] === 'h' ? 'ArrayLike<number | Body>' : 'ArrayLike<number>') : scalarType(f, input);
        if (f.array && f.type !== 'char') t = input ? `readonly (${t})[]` : `[${Array(f.count).fill(t).join(', ')}]`;
        out += doc(f.doc, '    ') + `    ${camel(f.name)}${input ? '?' : ''}: ${t};\n`;
    }
    if (input) for (const [name, path] of Object.entries(ALIASES[type] ?? {})) {
        const { f } = find(r, path);
        out += doc(`${path.split('.').map(camel).join('.')}${name === 'friction' ? ', and dynamicFriction' : ''}`, '    ') + `    ${name}?: ${scalarType(f, true)};\n`;
    }
    return out + '}\n';
}

// ---- calls ----------------------------------------------------------------------------------------------------------

const PARAM_ENUM = {
    'fe_body_set_type.type': 'fe_body_type', 'fe_body_get_type.out_type': 'fe_body_type', 'fe_body_set_locks.linear_axes': 'fe_axis',
    'fe_body_set_locks.angular_axes': 'fe_axis', 'fe_shape_set_events.events': 'fe_shape_events',
    'fe_joint_set_motor_speed.dof': 'fe_dof', 'fe_joint_set_target.dof': 'fe_dof',
};
// In a set_ of another record, what is not given stays as it is; a form, a frame and a pose are given whole
const KEEPS_NOTHING = new Set(['fe_geometry', 'fe_frame', 'fe_transform']);
const classes = { World: [], Body: [], Shape: [], Joint: [], Store: [], Asset: [], Hull: [], Heightfield: [], Mesh: [], Compound: [] };
const missing = [];
// [class, method] of a function, by its name and first parameters
function place(f) {
    const n = f.name.slice(3);
    let m;
    if ((m = n.match(/^(\w+)_joint_def_at$/))) return ['World', `add_${m[1]}_joint`];
    if ((m = n.match(/^(distance|ball|hinge|fixed|configurable)_joint_create$/))) return ['World', `create_${m[1]}_joint`];
    if ((m = n.match(/^(distance|ball|hinge|fixed|configurable)_joint_(set|get)(_target)?$/))) return ['Joint', `${m[2]}_${m[1]}${m[3] ?? ''}`];
    if ((m = n.match(/^(world|body|shape|joint|store|asset|hull|heightfield|mesh|compound)_(\w+)$/))) return [pascal('fe_' + m[1]), m[2]];
    return undefined;
}
const selfHandle = { Body: 'body', Shape: 'shape', Joint: 'joint', Asset: 'asset', Hull: 'hull', Heightfield: 'asset', Mesh: 'mesh', Compound: 'compound' };

function call(f) {
    const at = place(f);
    if (!at) return false;
    const [cls, base] = at, params = [...f.params], args = [], before = [], after = [], types = [], names = [];
    let scratch = 0, list;
    const room = (size) => { const o = scratch; scratch += Math.ceil(size / 16) * 16; return o ? `scratch + ${o}` : 'scratch'; };
    const first = params.shift();
    if (!first || !first.pointer || !['fe_world', 'fe_store'].includes(first.type)) return false;
    args.push(first.type === 'fe_store' ? 'this._s()' : first.const ? 'this._w()' : 'this._w(1)');
    if (selfHandle[cls] && params[0] && handles.has(params[0].type) && !params[0].pointer) params.shift(), args.push('this._h');
    const isAt = base.startsWith('add_') && f.name.endsWith('_def_at');
    let definition;
    const outs = [];
    for (let i = 0; i < params.length; ++i) {
        const p = params[i], name = camel(p.name), out = p.name.startsWith('out_'), next = params[i + 1], last = params[i + 2];
        const optional = new RegExp(`@param ${p.name}\\s+[^@]*NULL`).test(f.doc) || ['def', 'filter', 'options', 'direction'].includes(p.name);
        if (isAt && p.name === 'def') { definition = p.type; args.push('d'); continue; }
        if (out && p.pointer === 1 && (next?.name === 'capacity' || (next?.name === 'stride' && last?.name === 'capacity'))) {
            list = p;
            const stride = next.name === 'stride';
            const bytes = layout(p.type)[0];
            args.push('a', ...(stride ? [String(bytes)] : []), 'n');
            i += stride ? 2 : 1;
            continue;
        }
        if (out && p.pointer === 1) {
            const size = layout(p.type)[0], o = room(size);
            outs.push({ p, o });
            const r = records[p.type];
            if (r && r.fields[0].name === 'struct_size') { sized.add(p.type); before.push(`init(${tableName(p.type)}, ${o})`); }
            args.push(o);
            continue;
        }
        if (p.pointer === 1 && records[p.type] && (p.const || /triangle/.test(p.name))) {
            const o = room(records[p.type].size);
            if (vectors[p.type]) {
                args.push(optional ? `${name} === undefined || ${name} === null ? 0 : ${vectors[p.type]}(${o}, ${name}, '${name}')` : `${vectors[p.type]}(${o}, ${name}, '${name}')`);
            } else {
                table(p.type);
                inTypes.add(p.type);
                const getter = f.name.replace('_set', '_get');
                const kept = /(^|_)set($|_)/.test(base) && !KEEPS_NOTHING.has(p.type) && functions.some((g) => g.name === getter && g.params.length === f.params.length);
                args.push(kept ? `over(${tableName(p.type)}, ok(x.${getter}(${args.join(', ')}, init(${tableName(p.type)}, ${o}))), ${o}, ${name}, '${name}')`
                    : `${optional ? 'maybe' : 'make'}(${tableName(p.type)}, ${o}, ${name}, '${name}')`);
            }
            names.push(name);
            types.push(`${name}${optional ? '?' : ''}: ${vectors[p.type] ? (p.type === 'fe_quat' ? 'QuatLike' : 'Vec3Like') : pascal(p.type) + 'Options'}${optional ? ' | null' : ''}`);
            continue;
        }
        if (p.pointer) return false;
        const e = PARAM_ENUM[`${f.name}.${p.name}`];
        names.push(name);
        if (handles.has(p.type)) args.push(`handle(${name}, '${name}')`), types.push(`${name}: Handle<${pascal(p.type)}> | null`);
        else if (e) args.push(`${BITS.has(e) ? 'bits' : 'word'}(${pascal(e)}, ${name}, '${name}')`), types.push(`${name}: ${BITS.has(e) ? `${pascal(e)} | readonly ${pascal(e)}[] | number` : pascal(e)}`);
        else if (numbers[p.type]) {
            const isSwitch = p.type === 'int32_t' && SWITCH.test(p.name);
            args.push(`${{ f: 'num', d: 'num', i: 'int', u: 'uint', q: 'big' }[numbers[p.type][1]]}(${name}, '${name}')`);
            types.push(`${name}: ${p.type === 'uint64_t' ? 'number | bigint' : isSwitch ? 'boolean | 0 | 1' : 'number'}`);
        } else return false;
    }
    const invoke = `x.${f.name}(${args.join(', ')})`, text = f.doc;
    const outValue = ({ p, o }) => readOne({ ...p, pointer: 0, array: false, doc: PARAM_ENUM[`${f.name}.${p.name}`] ?? '' }, o);
    const outType = ({ p }) => scalarType({ ...p, pointer: 0, doc: PARAM_ENUM[`${f.name}.${p.name}`] ?? '' }, false);
    const method = (name, js, ts) => classes[cls].push({ name: camel(name), js, ts, doc: text });
    const lines = [...before];
    if (isAt) {
        table(definition);
        inTypes.add(definition);
        const type = definition.match(/^fe_(\w+)_joint_def$/)[1];
        const js = `${camel(base)}(${[...names, 'options'].join(', ')}) {
        reset();
        const d = init(${tableName(definition)}, temp(${records[definition].size}));
        ok(${invoke});
        if (options !== undefined && options !== null) put(${tableName(definition)}, d, options, 'options');
        return made.joint(this, x.fe_${type}_joint_create(this._w(1), d, scratch));
    }`;
        classes[cls].push({ name: camel(base), js, ts: `${camel(base)}(${[...types, `options?: ${pascal(definition)}Options | null`].join(', ')}): Joint;`, doc: text });
        return true;
    }
    lines.unshift('reset()');
    if (list) {
        const isHandle = handles.has(list.type), one = { ...list, pointer: 0, array: false, doc: '' };
        const read = isHandle ? 'id' : list.type === 'int32_t' ? '(a) => i32[a >> 2]' : vectors[list.type] ? `get${pascal(list.type)}` : (reader(list.type), `read${pascal(list.type)}`);
        const t = scalarType(one, false);
        lines.push(`return listOut(${layout(list.type)[0]}, ${read}, (a, n) => ${invoke})`);
        const isGetter = base.startsWith('get_') && names.length === 0;
        if (isGetter) method(base.slice(4), `get ${camel(base.slice(4))}() { ${lines.join('; ')}; }`, `get ${camel(base.slice(4))}(): ${t}[];`);
        else method(base, `${camel(base)}(${names.join(', ')}) { ${lines.join('; ')}; }`, `${camel(base)}(${types.join(', ')}): ${t}[];`);
        return true;
    }
    if (base === 'is_valid') { method('is_valid', `get isValid() { return yes(${invoke}); }`, 'get isValid(): boolean;'); return true; }
    if (f.result === 'int32_t') {
        if (outs.length === 1) {
            lines.push(`return yes(${invoke}) ? ${outValue(outs[0])} : null`);
            method(base, `${camel(base)}(${names.join(', ')}) { ${lines.join('; ')}; }`, `${camel(base)}(${types.join(', ')}): ${outType(outs[0])} | null;`);
        } else if (outs.length === 0) {
            lines.push(`return yes(${invoke})`);
            method(base, `${camel(base)}(${names.join(', ')}) { ${lines.join('; ')}; }`, `${camel(base)}(${types.join(', ')}): boolean;`);
        } else return false;
        return true;
    }
    if (f.result !== 'fe_result') return false;
    if (outs.length === 1 && outs[0].p.type === 'fe_joint' && base.startsWith('create_')) {
        lines.push(`return made.joint(this, ${invoke})`);
        method(base, `${camel(base)}(${names.join(', ')}) { ${lines.join('; ')}; }`, `${camel(base)}(${types.join(', ')}): Joint;`);
        return true;
    }
    lines.push(`ok(${invoke})`);
    if (outs.length === 1) lines.push(`return ${outValue(outs[0])}`);
    else if (outs.length > 1) lines.push(`return { ${outs.map((o) => `${camel(o.p.name.replace(/^out_/, ''))}: ${outValue(o)}`).join(', ')} }`);
    const result = outs.length === 0 ? 'void' : outs.length === 1 ? outType(outs[0]) : `{ ${outs.map((o) => `${camel(o.p.name.replace(/^out_/, ''))}: ${outType(o)}`).join('; ')} }`;
    if (base.startsWith('get_') && names.length === 0 && outs.length === 1) {
        method(base.slice(4), `get ${camel(base.slice(4))}() { ${lines.join('; ')}; }`, `get ${camel(base.slice(4))}(): ${result};`);
    } else if (base.startsWith('set_') && names.length === 1 && functions.some((g) => g.name === f.name.replace('_set_', '_get_') && g.params.length === f.params.length)) {
        const type = types[0].slice(types[0].indexOf(':') + 2);
        method(base.slice(4), `set ${camel(base.slice(4))}(${names[0]}) { ${lines.join('; ')}; }`, `set ${camel(base.slice(4))}(${names[0]}: ${type});`);
    } else method(base, `${camel(base)}(${names.join(', ')}) { ${lines.join('; ')}; }`, `${camel(base)}(${types.join(', ')}): ${result};`);
    return true;
}

for (const f of functions) {
    if (HAND.includes(f.name) || LEFT_OUT[f.name] || f.name.endsWith('_init')) continue;
    if (!call(f)) missing.push(f.name);
}
if (process.argv[3] === '--missing') {
    const hand = ['batch', 'hand', 'player', 'recorder', 'runtime'].map((name) => readFileSync(new URL(`src/${name}.js`, import.meta.url), 'utf8')).join('');
    for (const name of HAND) if (!hand.includes(`x.${name}(`)) missing.push(name);
    const known = new Set(functions.map((f) => f.name));
    for (const name of [...HAND, ...Object.keys(LEFT_OUT)]) if (!known.has(name)) missing.push(`${name}, which the header lacks`);
    for (const name of missing) console.log(name);
    process.exit(missing.length ? 1 : 0);
}

for (const t of ['fe_world_def', 'fe_body_def', 'fe_shape_def', 'fe_geometry', 'fe_store_def', 'fe_heightfield_def', 'fe_hull_def', 'fe_mesh_def', 'fe_compound_part', 'fe_material', 'fe_transform', 'fe_query_filter', 'fe_save_options', 'fe_restore_options', 'fe_draw_options', 'fe_ray', 'fe_path', 'fe_history_def', 'fe_recorder_def', 'fe_player_def', 'fe_batch_def']) { table(t); inTypes.add(t); }
for (const t of sized) if (!emittedTables.has(t)) tables.push(`export const ${tableName(t)} = [${records[t].size}, ${starter(t)}, {}];`);
for (const t of ['fe_hit', 'fe_snapshot_info', 'fe_transform', 'fe_draw_vertex', 'fe_draw_instance', 'fe_history_frame', 'fe_player_info', 'fe_note', 'fe_divergence', 'fe_difference']) { reader(t); outTypes.add(t); }
const readers = [...emittedReaders].map((type) => `export const read${pascal(type)} = ${isRare(type) ? `(a) => get(${tableName(type)}, a)` : readerOf(type)};`);
let classesTs = '';
for (const [name, methods] of Object.entries(classes)) {
    // a property's getter and setter stand together, else the types are wrong
    const properties = new Map();
    for (const m of methods) properties.set(m.name, [...(properties.get(m.name) ?? []), m]);
    classesTs += `export class ${name}Calls {\n`;
    for (const group of properties.values()) for (const m of group) classesTs += doc(m.doc, '    ') + `    ${m.ts}\n`;
    classesTs += '}\n';
}
let interfaces = '';
for (let done = 0; done < 2; ++done) { // records inside records are found on the way
    interfaces = '';
    for (const t of outTypes) interfaces += interfaceOf(t, false);
    for (const t of inTypes) interfaces += interfaceOf(t, true);
}
const constants = Object.entries(enums).map(([name, words]) => `export const ${pascal(name)} = { ${Object.entries(words).map(([k, v]) => `${k}: ${v}`).join(', ')} };`);
const offsetOf = (type, name) => records[type].fields.find((f) => f.name === name).offset;
const hitLayout = records.fe_hit.fields.filter((f) => !hidden(f)).map((f) => `${camel(f.name)}: ${f.offset / (f.type === 'double' || f.type === 'fe_dvec3' ? 8 : 4)}`);
const js = `// Made from include/feather.h by bindings/js/generate.mjs
import { x, f32, f64, i32, u32, u64, scratch, ok, yes, reset, temp, num, int, uint, big, handle, id, wide, word, bits, nameOf, vec3, dvec3, quat, getVec3, getDvec3, getQuat, put, init, make, maybe, over, get, W, text, listOut } from './runtime.js';
const i64of = (a) => BigInt.asIntN(64, u64[a >> 3]);
export const made = {};
export const HIT_BYTES = ${records.fe_hit.size}, VERTEX_BYTES = ${records.fe_draw_vertex.size}, INSTANCE_BYTES = ${records.fe_draw_instance.size};
export const AT = { store: ${offsetOf('fe_world_def', 'store')}, pool: ${offsetOf('fe_world_def', 'pool')}, playerPool: ${offsetOf('fe_player_def', 'pool')}, batchPool: ${offsetOf('fe_batch_def', 'pool')}, array: { bytes: ${records.fe_array.size}, ${['field', 'item_count', 'is_double', 'relative_to', 'origin', 'items', 'data', 'bytes'].map((n) => `${n === 'bytes' ? 'size' : camel(n)}: ${offsetOf('fe_array', n)}`).join(', ')} }, assetCount: ${offsetOf('fe_restore_options', 'asset_count')}, keys: ${offsetOf('fe_restore_options', 'keys')}, assets: ${offsetOf('fe_restore_options', 'assets')}, saveBase: [${offsetOf('fe_save_options', 'base')}, ${offsetOf('fe_save_options', 'base_size')}], restoreBase: [${offsetOf('fe_restore_options', 'base')}, ${offsetOf('fe_restore_options', 'base_size')}], playerStore: ${offsetOf('fe_player_def', 'store')} };
export const NOTE_BYTES = ${records.fe_note.size};
export const HitLayout = { ${hitLayout.join(', ')} };
${constants.join('\n')}
${tables.join('\n')}
${readers.join('\n')}
${Object.entries(classes).map(([name, methods]) => `export class ${name}Calls {\n${methods.map((m) => '    ' + m.js).join('\n')}\n}`).join('\n')}
`;
const ts = `// Made from include/feather.h by bindings/js/generate.mjs
import type { Body, Shape, Joint, Asset } from './index.js';
/** Read. */
export interface Vec3 { x: number; y: number; z: number }
/** A rotation, read: of length 1. */
export interface Quat { x: number; y: number; z: number; w: number }
/** Given: an object with x, y, z or an array of 3. */
export type Vec3Like = Readonly<Vec3> | readonly [number, number, number] | Float32Array | Float64Array;
/** Given: an object with x, y, z, w or an array of 4. */
export type QuatLike = Readonly<Quat> | readonly [number, number, number, number] | Float32Array | Float64Array;
/** A handle, or the object that has it. */
export type Handle<T> = number | T;
/** Where what lies in a record of World.raycastRaw: indices of \`doubles\` for point and fraction, else of \`words\` and \`floats\`. */
export const HitLayout: { ${hitLayout.map((l) => 'readonly ' + l).join('; ')} };
${Object.entries(enums).map(([name, words]) => `export type ${pascal(name)} = ${Object.keys(words).map((k) => `'${k}'`).join(' | ')};` + (!BITS.has(name) && name !== 'fe_dof' ? '' : `\nexport const ${pascal(name)}: { ${Object.entries(words).map(([k, v]) => `readonly ${k}: ${v}`).join('; ')} };`)).join('\n')}
${interfaces}${classesTs}`;
if (process.argv[3] === '--types') process.stdout.write(ts); // no exit: a pipe takes its time
else {
    const folder = process.argv[3];
    writeFileSync(`${folder}/api.js`, js);
    writeFileSync(`${folder}/api.d.ts`, ts);
    const exported = [...functions.map((f) => f.name).filter((n) => !LEFT_OUT[n]), 'fe_pool_create', 'malloc', 'free'];
    writeFileSync(`${folder}/exports`, exported.map((n) => `-Wl,--export=${n}\n`).join(''));
}
