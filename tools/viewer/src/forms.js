// forms.js - a mesh for each form: round ones and boxes of half extents 1, assets by their own triangles.
import * as THREE from 'three';

// Its caps are moved apart by the shader, by as much as `ratio` says: half height over radius of the instance.
function capsule(around) {
    const g = new THREE.CapsuleGeometry(1, 2, around / 4, around), p = g.attributes.position, side = new Float32Array(p.count);
    for (let k = 0; k < p.count; ++k) side[k] = Math.sign(p.getY(k)), p.setY(k, p.getY(k) - side[k]);
    g.setAttribute('side', new THREE.BufferAttribute(side, 1));
    return g;
}
const AROUND = 36, AROUND_MANY = 16, MANY = 1500; // edges of a circle; of one of many shapes
const BUILT = {
    box: () => new THREE.BoxGeometry(2, 2, 2),
    sphere: (around) => new THREE.SphereGeometry(1, around, around / 2),
    capsule,
    cylinder: (around) => new THREE.CylinderGeometry(1, 1, 2, around),
    cone: (around) => new THREE.ConeGeometry(1, 2, around),
    plane: () => new THREE.PlaneGeometry(2, 2).rotateX(-Math.PI / 2),
};
export const isBuilt = (type) => type in BUILT;

function ofTriangles(corners) {
    const g = new THREE.BufferGeometry();
    g.setAttribute('position', new THREE.BufferAttribute(corners, 3));
    g.computeVertexNormals(); // corners are not shared: the faces' own
    return g;
}
function ofHull(hull) {
    const { vertices, faces, corners } = hull, out = [];
    for (const { first, count } of faces) {
        for (let k = 1; k + 1 < count; ++k) {
            for (const c of [0, k, k + 1]) {
                const v = vertices[corners[first + c]];
                out.push(v.x, v.y, v.z);
            }
        }
    }
    return ofTriangles(new Float32Array(out));
}
// Of a heightfield or a mesh the world draws the triangles; here they are taken back into the shape's own space.
function ofDrawn(world, shape, body, place) {
    const { count, stride, floats, words } = world.drawTriangles({ only: body, parts: ['shapes'], origin: place.origin });
    const low = shape % 4294967296, high = Math.floor(shape / 4294967296), out = [], v = new THREE.Vector3();
    const back = place.rotation.clone().invert();
    for (let k = 0; k < count; ++k) {
        const at = k * stride;
        if (words[at + 4] !== low || words[at + 5] !== high) continue;
        v.set(floats[at], floats[at + 1], floats[at + 2]).sub(place.position).applyQuaternion(back).divide(place.scale);
        out.push(v.x, v.y, v.z);
    }
    return ofTriangles(new Float32Array(out));
}

// The mesh of an instance, one of `count`. `place`: { origin, position, rotation, scale }
export function formOf(world, { type, asset, shape, body, count }, place) {
    if (isBuilt(type)) return BUILT[type](count > MANY ? AROUND_MANY : AROUND);
    if (type === 'hull') return ofHull(world.store.asset(asset));
    return ofDrawn(world, shape, body, place);
}
