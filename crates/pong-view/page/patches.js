// Patches of solids: a disc of the effective area at the place of the cells of one face, coloured by their pressure.

import { Color, CylinderGeometry, DynamicDrawUsage, Group, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, Vector3 } from "three";

/** Colours of no pressure to the largest pressure of the scale. */
const RAMP = ["#3b2fa0", "#8f2fa3", "#d8576b", "#fca636", "#f3f27a"].map((color) => new Color(color));
/** Cosine of the largest angle between the normals of cells of one patch. */
const ALIKE = 0.985;
/** Thickness of a disc over its radius. */
const THIN = 0.02;
/** Share of the cells of a run whose pressure the scale covers, and most cells that are read for it. */
const COVERED = 0.98, SAMPLES = 20000;
const UP = new Vector3(0, 1, 0);

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Radius of a disc of an area, m. */
const radiusOf = (area) => Math.sqrt(area / Math.PI);

/** Tests whether a cell belongs to a patch: the same pair, normals alike, places nearer than the radii. */
function isOf(patch, cell) {
    if (patch.pair !== cell.pair || dot(patch.normal, cell.normal) < ALIKE) return false;
    const away = Math.hypot(...patch.point.map((x, axis) => x - cell.point[axis]));
    return away <= radiusOf(patch.area) + radiusOf(cell.weight);
}

/** Patches of the contacts of a frame. Both solids have cells at one face if both have a field: these are one patch. */
export function patchesOf(contacts) {
    const patches = [];
    for (const cell of contacts) {
        if (!cell.isCell || !(cell.weight > 0)) continue;
        const patch = patches.find((patch) => isOf(patch, cell));
        if (patch) join(patch, cell);
        else patches.push({ ...cell, area: cell.weight, cells: 1 });
    }
    for (const patch of patches) patch.pressure = patch.normalForce / patch.area;
    return patches;
}

// The place is the centre of the normal forces, as far as there are any.
function join(patch, cell) {
    const [own, other] = patch.normalForce + cell.normalForce > 0 ? [patch.normalForce, cell.normalForce] : [1, 1];
    patch.point = patch.point.map((x, axis) => (own * x + other * cell.point[axis]) / (own + other));
    patch.area += cell.weight;
    patch.normalForce += cell.normalForce;
    patch.cells++;
}

/** Pressure at the upper end of the scale of a run, Pa; 0 for a run without solids. */
export function typicalPressure(run) {
    const { end, weight, normal_force: force } = run.contacts;
    const step = Math.max(1, Math.ceil(end.length / SAMPLES));
    const some = [];
    for (let row = 0; row < end.length; row += step) if (run.isCell(row) && weight[row] > 0) some.push(force[row] / weight[row]);
    some.sort((a, b) => a - b);
    return some[Math.floor(COVERED * (some.length - 1))] ?? 0;
}

/** Colour of a pressure as a share of the scale. */
export function pressureColor(share, color = new Color()) {
    const place = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1);
    const low = Math.min(Math.floor(place), RAMP.length - 2);
    return color.lerpColors(RAMP[low], RAMP[low + 1], place - low);
}

/** The ramp as a background of the legend. */
export const rampGradient = () => `linear-gradient(to right, ${RAMP.map((color) => `#${color.getHexString()}`).join(", ")})`;

/** Discs: seen through bodies, but paler there. */
export class Patches extends Group {
    constructor() {
        super();
        this.geometry = new CylinderGeometry(1, 1, THIN, 48);
        const hidden = { transparent: true, opacity: 0.5, depthTest: false, depthWrite: false };
        const nearer = { polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 };
        this.materials = [new MeshBasicMaterial(hidden), new MeshBasicMaterial({ transparent: true, opacity: 0.9, ...nearer })];
        this.meshes = [];
        this.capacity = 0;
    }

    /** Shows patches; `scale` is the pressure of the last colour, Pa. */
    show(patches, scale) {
        if (patches.length > this.capacity) this.#grow(patches.length);
        const matrix = new Matrix4(), turn = new Quaternion(), size = new Vector3(), color = new Color();
        patches.forEach(({ point, normal, area, pressure }, index) => {
            turn.setFromUnitVectors(UP, new Vector3().fromArray(normal).normalize());
            matrix.compose(new Vector3().fromArray(point), turn, size.setScalar(radiusOf(area)));
            pressureColor(scale > 0 ? pressure / scale : 0, color);
            for (const mesh of this.meshes) {
                mesh.setMatrixAt(index, matrix);
                mesh.setColorAt(index, color);
            }
        });
        for (const mesh of this.meshes) {
            mesh.count = patches.length;
            mesh.instanceMatrix.needsUpdate = true;
            if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
        }
    }

    #grow(count) {
        this.meshes.forEach((mesh) => mesh.dispose());
        this.clear();
        this.capacity = Math.max(16, 2 * count);
        this.meshes = this.materials.map((material, depth) => {
            const mesh = new InstancedMesh(this.geometry, material, this.capacity);
            mesh.instanceMatrix.setUsage(DynamicDrawUsage);
            mesh.frustumCulled = false;
            mesh.renderOrder = 8 + depth;
            return mesh;
        });
        this.add(...this.meshes);
    }
}
