// Primitives in contact, drawn once more in yellow. Of a mesh only the triangles that are touched.

import {
    BufferAttribute, BufferGeometry, DoubleSide, InstancedMesh, LineMaterial, LineSegments2, Matrix4, Mesh,
    MeshBasicMaterial, Points, PointsMaterial,
} from "three";
import { dotTexture, lines, unitBall } from "#view/meshes.js";
import { HIGHLIGHT } from "#view/theme.js";

const POINT_PIXELS = 10, LINE_PIXELS = 5;
const LARGER = 1.004;
const NEARER = { polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 };

/** Highlighted primitives of one body. */
class BodyHighlight {
    constructor(view, dot) {
        this.view = view;
        this.meshes = view.meshes;
        this.dot = dot;
        this.layers = {};
        this.clear();
    }

    clear() {
        this.parts = { triangles: new Set(), points: new Set(), segments: new Set(), rays: new Set(), balls: new Set() };
        this.planes = new Set();
    }

    /** Adds a primitive in contact, or the element of a mesh. */
    add({ kind, first, count }, element) {
        const { triangles, points, segments, rays, balls } = this.parts;
        if (kind === "Triangle") triangles.add(first + (element % Math.max(1, count)));
        else if (kind === "Polyhedron" || kind === "Custom") for (let i = 0; i < count; i++) triangles.add(first + i);
        else if (kind === "Point") points.add(first);
        else if (kind === "LineSegment") segments.add(first);
        else if (kind === "Ray") rays.add(first);
        else if (kind === "Plane") this.planes.add(first);
        else balls.add(first);
    }

    /** Draws the added primitives; rebuilds only when they have changed. */
    show() {
        this.view.planes.forEach((plane, index) => {
            const { material } = plane.userData.square;
            const isTouched = this.planes.has(index);
            material.color.set(isTouched ? HIGHLIGHT : this.view.color);
            material.opacity = isTouched ? 0.12 : 0.18;
        });
        this.#layer("triangles", () => this.#surface());
        this.#layer("points", () => this.#points());
        this.#layer("lines", () => this.#lines());
        this.#layer("balls", () => this.#balls());
    }

    #layer(name, build) {
        const sets = name === "lines" ? [this.parts.segments, this.parts.rays] : [this.parts[name]];
        const signature = sets.map((set) => [...set].sort((a, b) => a - b).join(",")).join("|");
        const layer = this.layers[name];
        if (layer?.signature === signature) return;
        if (layer?.object) {
            this.view.remove(layer.object);
            layer.object.geometry.dispose();
            layer.object.material.dispose();
        }
        const object = sets.some((set) => set.size) ? build() : null;
        if (object) {
            object.renderOrder = 2;
            object.raycast = () => {};
            this.view.add(object);
        }
        this.layers[name] = { signature, object };
    }

    #surface() {
        const all = this.meshes.shape.triangles;
        const corners = Uint32Array.from([...this.parts.triangles].flatMap((t) => [all[3 * t], all[3 * t + 1], all[3 * t + 2]]));
        return new Mesh(this.#sharing(corners), veil());
    }

    // The vertices stay on the graphics card when this is disposed of: they belong to the shape.
    #sharing(corners) {
        const geometry = new BufferGeometry();
        const used = Float32Array.from([...corners].flatMap((v) => [...this.meshes.shape.vertices.subarray(3 * v, 3 * v + 3)]));
        return geometry.setAttribute("position", new BufferAttribute(used, 3));
    }

    #points() {
        const { points } = this.meshes.shape;
        const places = Float32Array.from([...this.parts.points].flatMap((p) => [...points.subarray(3 * p, 3 * p + 3)]));
        const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(places, 3));
        const material = { color: HIGHLIGHT, size: POINT_PIXELS, sizeAttenuation: false, map: this.dot, alphaTest: 0.5 };
        return new Points(geometry, new PointsMaterial(material));
    }

    #lines() {
        const { segments, rays } = this.meshes.shape;
        const of = (column, set) => [...set].flatMap((index) => [...column.subarray(6 * index, 6 * index + 6)]);
        const geometry = lines([...of(segments, this.parts.segments), ...of(rays, this.parts.rays)]);
        return new LineSegments2(geometry, new LineMaterial({ color: HIGHLIGHT, linewidth: LINE_PIXELS, ...NEARER }));
    }

    #balls() {
        const chosen = [...this.parts.balls];
        const object = new InstancedMesh(unitBall().clone(), veil(), chosen.length);
        const matrix = new Matrix4(), larger = new Matrix4().makeScale(LARGER, LARGER, LARGER);
        chosen.forEach((ball, index) => {
            object.setMatrixAt(index, matrix.fromArray(this.meshes.ballMatrices, 16 * ball).multiply(larger));
        });
        return object;
    }
}

const veil = () =>
    new MeshBasicMaterial({
        color: HIGHLIGHT, transparent: true, opacity: 0.45, side: DoubleSide, depthWrite: false,
        ...NEARER,
    });

export class Highlights {
    constructor(bodies) {
        const dot = dotTexture(false);
        this.bodies = bodies.views.map((view) => new BodyHighlight(view, dot));
        this.isOn = true;
    }

    show(contacts) {
        for (const body of this.bodies) body.clear();
        if (this.isOn) {
            for (const { a, b, elementA, elementB } of contacts) {
                this.bodies[a.body].add(a.info, elementA);
                this.bodies[b.body].add(b.info, elementB);
            }
        }
        for (const body of this.bodies) body.show();
    }

    /** Number of highlighted primitives and triangles. */
    get count() {
        const sizes = this.bodies.flatMap((body) => [...Object.values(body.parts), body.planes].map((set) => set.size));
        return sizes.reduce((sum, size) => sum + size, 0);
    }
}
