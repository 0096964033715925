import type { Body, Moved, Vec3, World } from './index.js';
/** What is used of an InstancedMesh. */
interface Instanced { count: number; readonly instanceMatrix: { readonly count: number; readonly array: ArrayLike<number>; needsUpdate: boolean } }

/** Bodies as the instances of an InstancedMesh, drawn between two steps. */
export class BodyInstances<Mesh extends Instanced = Instanced> {
    /** The instances of a mesh, one a body. @param scales  3 numbers a body, or 3 for all; default 1, 1, 1 */
    constructor(mesh: Mesh, world: World, bodies: readonly (Body | number)[], scales?: ArrayLike<number>);
    /** What it draws into. */
    readonly mesh: Mesh;
    /** The world that its bodies are of. */
    readonly world: World;
    /** Handles of the bodies, by instance. */
    readonly ids: readonly number[];
    /** The handle of an instance's body. */
    bodyOf(instance: number): number;
    /** Once after each step. */
    keep(moved: Moved): void;
    /** Once a frame. @param part  of a step since the last but one, 0..1 */
    draw(part?: number): void;
}
/** The ray under a place of the screen, x and y from -1 to 1: what World.raycast takes. */
export function rayOf(camera: unknown, x: number, y: number, length?: number): [Vec3, Vec3];
