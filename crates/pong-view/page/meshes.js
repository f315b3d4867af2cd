// Geometry of shapes. Bodies of the same shape share all of it.

import {
    Box3, BufferAttribute, BufferGeometry, CanvasTexture, InstancedBufferAttribute, LineSegmentsGeometry, Matrix4,
    Quaternion, SphereGeometry, Vector3,
} from "three";

const BALL_NUMBERS = 10;
/** Most points of one kind used to fit a shape into the picture. */
const MARKS = 400;
/** Steps of the great circles on balls, which make their rotation visible. */
const CIRCLE_STEPS = 48;

let ball;
/** A ball of radius 1. */
export const unitBall = () => (ball ??= new SphereGeometry(1, 40, 24));

/** A round or ring-shaped dot for points of fixed size on the screen. */
export function dotTexture(isRing) {
    const size = 64;
    const canvas = Object.assign(document.createElement("canvas"), { width: size, height: size });
    const context = canvas.getContext("2d");
    context.strokeStyle = context.fillStyle = "#fff";
    context.lineWidth = 14;
    context.beginPath();
    context.arc(size / 2, size / 2, isRing ? size / 2 - 9 : size / 2 - 2, 0, 2 * Math.PI);
    if (isRing) context.stroke();
    else context.fill();
    return new CanvasTexture(canvas);
}

/** Geometries of a shape. Empty kinds are null. */
export class ShapeMeshes {
    constructor(shape) {
        this.shape = shape;
        this.position = new BufferAttribute(shape.vertices, 3);
        this.surface = shape.triangles.length ? this.indexed(shape.triangles) : null;
        this.edges = shape.edges.length ? this.indexed(shape.edges) : null;
        this.points = shape.points.length ? placed(shape.points) : null;
        this.lines = lines([...shape.segments, ...shape.rays]);
        this.tips = shape.rays.length ? placed(tips(shape.rays)) : null;
        this.ballMatrices = ballMatrices(shape.balls);
        this.circles = shape.balls.length ? placed(circles(this.ballMatrices)) : null;
        this.box = this.#box();
        this.marks = this.#marks();
    }

    /** A geometry with the vertices of the shape and corners of its own. */
    indexed(corners) {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", this.position);
        geometry.setIndex(new BufferAttribute(corners, 1));
        return geometry;
    }

    get ballCount() {
        return this.shape.balls.length / BALL_NUMBERS;
    }

    /** Matrices of the balls, to be shared by all that draw them. */
    sharedBallMatrices() {
        return (this.shared ??= new InstancedBufferAttribute(this.ballMatrices, 16));
    }

    /** Points on the outside, in the body's frame, for the extent of the shape. */
    #marks() {
        const { shape } = this, places = [], unit = [-1, 1];
        for (const numbers of [shape.vertices, shape.points, shape.segments, shape.rays]) {
            const step = 3 * Math.max(1, Math.ceil(numbers.length / 3 / MARKS));
            for (let i = 0; i + 2 < numbers.length; i += step) places.push(new Vector3().fromArray(numbers, i));
        }
        const matrix = new Matrix4(), some = Math.max(1, Math.ceil(this.ballCount / MARKS));
        for (let i = 0; i < this.ballCount; i += some) {
            matrix.fromArray(this.ballMatrices, 16 * i);
            for (const x of unit) for (const y of unit) for (const z of unit) places.push(new Vector3(x, y, z).multiplyScalar(0.7).applyMatrix4(matrix));
        }
        return places;
    }

    // Box around everything bounded, in the body's frame.
    #box() {
        const { shape } = this, box = new Box3(), place = new Vector3();
        for (const numbers of [shape.vertices, shape.points, shape.segments, shape.rays]) {
            for (let i = 0; i + 2 < numbers.length; i += 3) box.expandByPoint(place.fromArray(numbers, i));
        }
        const unit = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1)), matrix = new Matrix4();
        for (let i = 0; i < this.ballCount; i++) {
            box.union(unit.clone().applyMatrix4(matrix.fromArray(this.ballMatrices, 16 * i)));
        }
        return box;
    }
}

function placed(numbers) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(numbers), 3));
    return geometry;
}

/** Lines with a width in pixels; null without any. */
export function lines(numbers) {
    if (!numbers.length) return null;
    return new LineSegmentsGeometry().setPositions(numbers);
}

function tips(rays) {
    const places = [];
    for (let i = 0; i < rays.length; i += 6) places.push(rays[i + 3], rays[i + 4], rays[i + 5]);
    return places;
}

function ballMatrices(balls) {
    const matrices = new Float32Array((balls.length / BALL_NUMBERS) * 16);
    const [center, axes, turn, matrix] = [new Vector3(), new Vector3(), new Quaternion(), new Matrix4()];
    for (let i = 0; i * BALL_NUMBERS < balls.length; i++) {
        const at = i * BALL_NUMBERS;
        center.fromArray(balls, at);
        axes.fromArray(balls, at + 3);
        turn.set(balls[at + 7], balls[at + 8], balls[at + 9], balls[at + 6]);
        matrix.compose(center, turn, axes).toArray(matrices, 16 * i);
    }
    return matrices;
}

/** Three great circles on each ball. */
function circles(matrices) {
    const places = [], matrix = new Matrix4(), place = new Vector3();
    const steps = matrices.length > 16 * 200 ? CIRCLE_STEPS / 4 : CIRCLE_STEPS;
    for (let i = 0; i < matrices.length; i += 16) {
        matrix.fromArray(matrices, i);
        for (let axis = 0; axis < 3; axis++) {
            for (let end = 0; end < 2 * steps; end++) {
                const angle = (2 * Math.PI * ((end + 1) >> 1)) / steps;
                place.setScalar(0);
                place.setComponent((axis + 1) % 3, 1.002 * Math.cos(angle));
                place.setComponent((axis + 2) % 3, 1.002 * Math.sin(angle));
                place.applyMatrix4(matrix).toArray(places, places.length);
            }
        }
    }
    return places;
}
