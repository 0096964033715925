// materials.js - what surfaces look like. The shaders of three, with a few lines more: edges of boxes, quarters of what is
// round (so that one sees it turn), caps of capsules, and the grid of planes.
import * as THREE from 'three';

const VERTEX = {
    head: 'varying vec3 vOwn; varying vec3 vHalf; varying vec3 vFrom;\n#ifdef CAPSULE\nattribute float side; attribute float ratio;\n#endif\n',
    body: `#include <begin_vertex>
vOwn = position;
#ifdef CAPSULE
transformed.y += side * ratio;
vOwn = transformed;
#endif
#ifdef USE_INSTANCING
vHalf = vec3(length(instanceMatrix[0].xyz), length(instanceMatrix[1].xyz), length(instanceMatrix[2].xyz));
vFrom = (instanceMatrix * vec4(transformed, 1.0)).xyz;
#endif`,
};
const FRAGMENT = {
    box: `vec3 gap = (1.0 - abs(vOwn)) * vHalf;
float near = max(min(gap.x, gap.y), min(max(gap.x, gap.y), gap.z)), px = fwidth(near);
float seen = smoothstep(0.25, 0.02, px / max(1e-6, min(vHalf.x, min(vHalf.y, vHalf.z))));
diffuseColor.rgb *= 1.0 - 0.38 * seen * (1.0 - smoothstep(px * 0.4, px * 1.7, near));`,
    round: `vec2 q = vOwn.xz * vOwn.y; vec2 f = fwidth(vOwn.xz) * 1.2;
float quarter = clamp(vOwn.x / f.x, -1.0, 1.0) * clamp(vOwn.z / f.y, -1.0, 1.0);
diffuseColor.rgb *= 0.93 + 0.07 * quarter;`,
    ball: `vec3 f = fwidth(vOwn) * 1.2; vec3 q = clamp(vOwn / f, -1.0, 1.0);
diffuseColor.rgb *= 0.93 + 0.07 * q.x * q.y * q.z;`,
    plane: `vec2 at = vOwn.xz * vHalf.xz;
vec2 w1 = fwidth(at), a1 = abs(fract(at - 0.5) - 0.5) / w1, a10 = abs(fract(at / 10.0 - 0.5) - 0.5) / (w1 / 10.0);
float far = smoothstep(0.9, 0.12, max(w1.x, w1.y)), far10 = smoothstep(9.0, 1.2, max(w1.x, w1.y));
float lines = max((1.0 - min(min(a1.x, a1.y), 1.0)) * 0.35 * far, (1.0 - min(min(a10.x, a10.y), 1.0)) * 0.75 * far10);
diffuseColor.rgb = mix(uGround, uGrid, lines);
float away = length(vFrom - uEye) / uFar;
diffuseColor.a = 1.0 - smoothstep(0.25, 1.0, away);`,
    faces: '',
};
const WHICH = { box: 'box', sphere: 'ball', capsule: 'round', cylinder: 'round', cone: 'round', plane: 'plane' };

// Shared by all planes: colours, the camera, how far the ground is seen
export const ground = { uGround: { value: new THREE.Color() }, uGrid: { value: new THREE.Color() }, uEye: { value: new THREE.Vector3() },
    uFar: { value: 200 } };

function extend(material, kind) {
    material.onBeforeCompile = (shader) => {
        const front = kind === 'capsule' ? '#define CAPSULE\n' : '';
        shader.vertexShader = front + VERTEX.head + shader.vertexShader.replace('#include <begin_vertex>', VERTEX.body);
        if (!material.isMeshDepthMaterial) {
            if (kind === 'plane') Object.assign(shader.uniforms, ground);
            const head = 'varying vec3 vOwn; varying vec3 vHalf; varying vec3 vFrom; uniform vec3 uGround, uGrid, uEye; uniform float uFar;\n';
            shader.fragmentShader = head + shader.fragmentShader.replace('#include <color_fragment>', `#include <color_fragment>\n{ ${FRAGMENT[WHICH[kind] ?? 'faces']} }`);
        }
    };
    material.customProgramCacheKey = () => kind + material.type;
    return material;
}
const made = new Map();
export function materialOf(kind, see) {
    const key = kind + see;
    if (!made.has(key)) {
        const flat = !WHICH[kind], plane = kind === 'plane';
        made.set(key, extend(new THREE.MeshStandardMaterial({
            roughness: plane ? 0.95 : 0.62, metalness: 0, flatShading: flat, side: flat ? THREE.DoubleSide : THREE.FrontSide,
            transparent: see || plane, opacity: see ? 0.28 : 1, depthWrite: !see,
        }), kind));
    }
    return made.get(key);
}
export const depthOf = (kind) => {
    const key = kind + ' depth';
    if (!made.has(key)) made.set(key, extend(new THREE.MeshDepthMaterial({ depthPacking: THREE.RGBADepthPacking }), kind));
    return made.get(key);
};
